// A side that is open in a part of it only, against what a bed of fixed sand must do above it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "case_text.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {
namespace {

/// Sand that does not move; its permeability follows.
const std::string sand = R"(
[[material]]
name = "sand"
law = "linear-elastic"
young_modulus = "1 MPa"
fixed = true
grain_density = "2660 kg/m3"
porosity = 0.34
drag = "darcy"
permeability = )";

const std::string bed = R"(
[model]
size = ["0.6 m", "0.4 m"]
cell = "0.025 m"
)" + sand + R"("5e-3 m/s"
[[soil]]
material = "sand"
box = [["0 m", "0 m"], ["0.6 m", "0.2 m"]]
[[free_water]]
box = [["0 m", "0.2 m"], ["0.6 m", "0.3 m"]]
[initial]
water_table = [["0 m", "0.3 m"], ["0.6 m", "0.3 m"]]
[numerics]
pressure_tolerance = 1e-10
[[stage]]
name = "leak"
duration = "0.5 s"
[[boundary]]
side = "base"
)";

double volume_of(const Simulation<PlaneStrain>& run) {
  double sum = 0;
  for (const double v : run.state().water.volume) sum += v;
  return sum;
}

TEST(Orifice, LetsInWhatItsWidthTakes) {
  Simulation<PlaneStrain> run(
      read_text(bed + "water = \"inflow\"\ninflow = \"10 mm/s\"\nspan = [\"0.25 m\", \"0.35 m\"]\n"), 1);
  const double before = volume_of(run);
  while (!run.finished()) run.advance();
  // 10 mm/s over 0.1 m for 0.5 s; what is owed and not yet in points is less than a layer of a cell for each of 4 cells
  const double layer = 0.34 * 0.025 * 0.025 / 2;
  EXPECT_NEAR(volume_of(run) - before, 0.01 * 0.1 * 0.5, 4 * layer);
}

TEST(Orifice, UnderAHeadIsSymmetricAndTightBesideIt) {
  Simulation<PlaneStrain> run(read_text(bed + "water = \"head\"\nhead = \"1.3 m\"\nspan = [\"0.25 m\", \"0.35 m\"]\n"),
                              1);
  while (!run.finished()) run.advance();
  const auto& grid = run.state().grid;
  const auto& lattice = run.state().setup.lattice;
  const double given = 1000 * 9.81 * 1.0;  // over the water at rest
  const auto excess = [&](int i, int j) {
    return grid.pressure[lattice.index(i, j)] - 1000 * 9.81 * (0.3 - (j + 0.5) * 0.025);
  };
  for (int i = 0; i < 12; ++i) EXPECT_NEAR(excess(i, 0), excess(23 - i, 0), 1e-3 * given) << i;
  EXPECT_GT(excess(11, 0), 0.75 * given);
  EXPECT_LT(excess(11, 0), given);
  for (int i = 0; i < 24; ++i) {
    const double v = grid.water_velocity[1][lattice.index(i, 0)];
    if (i >= 10 && i < 14)
      EXPECT_GT(v, 0) << i;
    else
      EXPECT_EQ(v, 0) << i;
  }
  for (const double y : run.state().water.position[1]) EXPECT_GE(y, 0);
}

/// m²/s through the orifice of a bed of fixed sand under a head, 4 mm wide, on a given grid.
double flow_through_4_mm(const std::string& grid, double width, double height) {
  const std::string text = fmt::format(R"(
[model]
size = [{0}, {1}]
{2}{3}"5e-4 m/s"
[[soil]]
material = "sand"
box = [[0, 0], [{0}, 0.1]]
[[free_water]]
box = [[0, 0.1], [{0}, 0.12]]
[initial]
water_table = [[0, 0.12], [{0}, 0.12]]
[[stage]]
name = "leak"
duration = "0.02 s"
[[boundary]]
side = "base"
water = "head"
head = "0.62 m"
span = [{4}, {5}]
)",
                                       width, height, grid, sand, 0.5 * width - 0.002, 0.5 * width + 0.002);
  Simulation<PlaneStrain> run(read_text(text), 1);
  while (!run.finished()) run.advance();
  const auto& lattice = run.state().setup.lattice;
  double flow = 0;
  for (int i = 0; i < lattice.cells[0]; ++i) {
    const std::ptrdiff_t f = lattice.index(i, 0);
    flow += run.state().grid.porosity[1][f] * run.state().grid.water_velocity[1][f] * lattice.axis[0].width(i);
  }
  return flow;
}

std::string refined_to(const std::string& cell, const std::string& from, const std::string& to,
                       const std::string& largest) {
  return "cell = \"" + largest + "\"\n[[refine]]\nalong = \"x\"\nspan = [\"" + from + "\", \"" + to + "\"]\ncell = \"" +
         cell + "\"\n[[refine]]\nalong = \"height\"\nspan = [\"0 m\", \"4 mm\"]\ncell = \"" + cell + "\"\n";
}

TEST(Orifice, OnGradedSpacingFlowsAsOnAUniformlyFineGrid) {
  const double fine = flow_through_4_mm("cell = \"2 mm\"", 0.2, 0.14);
  const double graded = flow_through_4_mm(refined_to("2 mm", "96 mm", "104 mm", "20 mm"), 0.2, 0.14);
  EXPECT_GT(fine, 0);
  EXPECT_NEAR(graded / fine, 1, 0.03);
  RecordProperty("graded_over_fine", std::to_string(graded / fine));
  std::printf("graded over fine: %.4f\n", graded / fine);
}

TEST(Orifice, ThrowsWaterNoFasterThanItsHead) {
  Simulation<PlaneStrain> run(read_text(R"(
[model]
size = ["0.4 m", "1 m"]
cell = "0.025 m"
[[free_water]]
box = [["0 m", "0 m"], ["0.4 m", "0.1 m"]]
[initial]
water_table = [["0 m", "0.1 m"], ["0.4 m", "0.1 m"]]
[[boundary]]
side = "base"
water = "head"
head = "0.6 m"
span = ["0.15 m", "0.25 m"]
[[stage]]
name = "jet"
duration = "0.5 s"
)"),
                              1);
  double fastest = 0;
  while (!run.finished()) {
    run.advance();
    const auto& lattice = run.state().setup.lattice;
    for (int i = 6; i < 10; ++i) fastest = std::max(fastest, run.state().grid.water_velocity[1][lattice.index(i, 0)]);
  }
  const double bernoulli = std::sqrt(2 * 9.81 * 0.6);
  EXPECT_GT(fastest, 0.5 * bernoulli);
  EXPECT_LT(fastest, 1.02 * bernoulli);
}

}  // namespace
}  // namespace polder
