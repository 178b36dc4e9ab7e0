// A graded grid against what is known exactly: water at rest stays so, a column settles under its weight as theory
// says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "case_text.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {
namespace {

const std::string grid = R"(
[model]
size = ["1 m", "1.5 m"]
cell = "0.1 m"
[[refine]]
along = "x"
span = ["0.48 m", "0.52 m"]
cell = "10 mm"
[[refine]]
along = "height"
span = ["0.4 m", "0.5 m"]
cell = "20 mm"
[[refine]]
along = "height"
span = ["0.8 m", "1.2 m"]
cell = "0.1 m"
)";

TEST(GradedSpacing, KeepsWaterAndSoilAtRest) {
  Simulation<PlaneStrain> run(read_text(grid + R"(
[[material]]
name = "sand"
law = "mohr-coulomb"
grain_density = "2650 kg/m3"
porosity = 0.4
permeability = "1e-3 m/s"
young_modulus = "10 MPa"
poisson_ratio = 0.3
cohesion = "1 kPa"
friction_angle = "35 deg"
[[soil]]
material = "sand"
box = [["0 m", "0 m"], ["1 m", "0.8 m"]]
[[free_water]]
box = [["0 m", "0.8 m"], ["1 m", "1.2 m"]]
[initial]
water_table = [["0 m", "1.2 m"], ["1 m", "1.2 m"]]
stress = "k0"
[[stage]]
name = "rest"
duration = "0.1 s"
)"),
                              1);
  while (!run.finished()) run.advance();
  const auto& state = run.state();
  const auto& lattice = state.setup.lattice;
  ASSERT_TRUE(lattice.graded);
  const double gamma = 1000 * 9.81;
  over_all_cells(lattice, [&](std::ptrdiff_t cell, const std::array<int, 3>& at) {
    if (!state.grid.wet[cell]) return;
    EXPECT_NEAR(state.grid.fill[cell], 1, 1e-6);
    EXPECT_NEAR(state.grid.pressure[cell], gamma * (1.2 - lattice.centre(at)[1]), 2e-3 * gamma);
  });
  for (std::size_t p = 0; p < state.soil.size(); ++p)
    for (int a = 0; a < 2; ++a) EXPECT_NEAR(state.soil.position[a][p], state.soil.reference[a][p], 1e-5);
}

TEST(GradedSpacing, LetsAnElasticColumnSettleUnderItsWeight) {
  Simulation<PlaneStrain> run(read_text(grid + R"(
[[material]]
name = "body"
law = "linear-elastic"
grain_density = "2650 kg/m3"
porosity = 0.4
grain_diameter = "1 mm"
young_modulus = "1 MPa"
poisson_ratio = 0
[[soil]]
material = "body"
box = [["0 m", "0 m"], ["1 m", "1.2 m"]]
[initial]
stress = "none"
[[stage]]
name = "settle"
duration = "1.5 s"
damping = 15
)"),
                              1);
  while (!run.finished()) run.advance();
  const auto& soil = run.state().soil;
  const double weight = 0.6 * 2650 * 9.81, height = 1.2, modulus = 1e6;
  const double at_top = weight * height * height / (2 * modulus);
  for (std::size_t p = 0; p < soil.size(); ++p) {
    const double y = soil.reference[1][p], exact = weight * (height * y - 0.5 * y * y) / modulus;
    EXPECT_NEAR(soil.reference[1][p] - soil.position[1][p], exact, 0.02 * at_top) << y;
    EXPECT_NEAR(soil.stress[1][p], -weight * (height - y), 0.05 * weight * height) << soil.reference[0][p] << ", " << y;
  }
}

}  // namespace
}  // namespace polder
