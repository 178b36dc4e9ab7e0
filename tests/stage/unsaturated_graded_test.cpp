// The unsaturated formulation on lattices whose cells are not all alike.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "case_text.hpp"
#include "largest_displacement.hpp"
#include "polder/stage/simulation.hpp"
#include "silt.hpp"
#include "wall_in_silt.hpp"

namespace polder {
namespace {

constexpr double water_weight = 9810;  // N/m³
constexpr double full_weight = 0.6 * 2650 * 9.81 + 0.4 * water_weight;

std::unique_ptr<Simulation<PlaneStrain>> after(const std::string& text) {
  auto run = std::make_unique<Simulation<PlaneStrain>>(read_text(text), 1);
  EXPECT_TRUE(run->state().setup.lattice.graded);
  while (!run->finished()) run->advance();
  EXPECT_LT(run->audit().water_balance_error(run->state()), 1e-12);
  EXPECT_LT(run->audit().solid_mass_error(run->state()), 1e-12);
  return run;
}

std::string finer(const std::string& along, const std::string& span, const std::string& cell) {
  return fmt::format("[[refine]]\nalong = \"{}\"\nspan = {}\ncell = \"{}\"\n", along, span, cell);
}

std::string stage(const std::string& name, const std::string& duration, const std::string& more) {
  return fmt::format("[[stage]]\nname = \"{}\"\nduration = \"{}\"\n{}\n", name, duration, more);
}

const std::string rest = stage("rest", "60 s", "initial = true\nlocal_damping = 0.7\nuntil_rest = true") +
                         "[numerics]\nstep_stretch = 1000\n";

/// A column of 4 m whose cells are 12 cm in its middle and at its surface, 25 cm elsewhere.
std::string column(const std::string& level, const std::string& content, const std::string& stages,
                   const std::string& permeability = "5e-4 m/s") {
  std::string material = silt();
  material.replace(material.find("5e-4 m/s"), 8, permeability);
  return R"(
[model]
formulation = "unsaturated"
size = ["0.5 m", "6 m"]
cell = "0.25 m"
)" + finer("height", "[1.5, 2]", "12.5 cm") +
         finer("height", "[3.5, 4.5]", "12.5 cm") + material +
         fmt::format("[initial]\nwater_table = [[0, {0}], [0.5, {0}]]\n", level) + R"([[soil]]
material = "silt"
polygon = [[0, 0], [0.5, 0], [0.5, 4], [0, 4]]
)" + content +
         stages;
}

/// Largest of |σ'v| less what it should be, by height, Pa.
template <class Expected>
double stress_error(const Stepper<PlaneStrain>& state, Expected&& expected) {
  double worst = 0;
  for (std::size_t p = 0; p < state.soil.size(); ++p)
    worst = std::max(worst, std::abs(state.soil.stress[1][p] - expected(state.soil.position[1][p])));
  return worst;
}

TEST(GradedUnsaturatedColumn, StaysAtRestUnderItsOwnWeight) {
  const auto run = after(column("4", R"([[seepage_boundary]]
name = "ground"
line = [[0, 4], [0.5, 4]]
head = "4 m"
)",
                                rest + stage("event", "20 s", "local_damping = 0.7")));
  double way = 0;
  const auto& soil = run->state().soil;
  for (std::size_t p = 0; p < soil.size(); ++p)
    way = std::max(way, std::abs(soil.position[1][p] - soil.reference[1][p]));
  EXPECT_LT(way, 1e-6);
  for (const double y : {0.1, 1.0, 1.6, 1.9, 2.5, 3.5, 3.95})
    EXPECT_NEAR(run->pressure_at({0.25, y, 0}), water_weight * (4 - y), 1e-3 * water_weight) << y;
  EXPECT_LT(stress_error(run->state(), [](double y) { return -(full_weight - water_weight) * (4 - y); }),
            0.01 * (full_weight - water_weight) * 4);
}

TEST(GradedUnsaturatedColumn, DrainsToStillWaterAndConductsAsDarcySays) {
  const std::string base = R"([[seepage_boundary]]
name = "base"
line = [[0, 0], [0.5, 0]]
head = {}
)";
  const std::string closed =
      "[[seepage_boundary]]\nname = \"ground\"\nline = [[0, 4], [0.5, 4]]\ncondition = \"closed\"\n";
  const auto drained =
      after(column("3.5", fmt::format(fmt::runtime(base), R"([["0 s", "3.5 m"], ["1 s", "1 m"]])") + closed,
                   rest + stage("event", "4000 s", "local_damping = 0.5")));
  double held = 0, expected = 0;
  for (const double w : drained->state().soil.water) held += w;
  for (int i = 0; i < 4000; ++i) {  // still water
    const double suction = std::max(0.0, (i + 0.5) * 1e-3 - 1);
    expected += 0.5 * 1e-3 * 0.4 * (0.05 + 0.95 / std::sqrt(1 + std::pow(0.3 * suction, 2)));
  }
  EXPECT_NEAR(held, expected, 0.01 * expected);
  for (const double y : {0.1, 1.0, 1.55, 1.9, 2.5, 3.5, 3.95})
    EXPECT_NEAR(drained->pressure_at({0.25, y, 0}), water_weight * (1 - y), 0.02 * water_weight * 3) << y;

  const auto seeps = after(column("4", fmt::format(fmt::runtime(base), R"([["0 s", "4 m"], ["1 s", "5 m"]])"),
                                  rest + stage("event", "2000 s", "local_damping = 0.5")));
  const auto& lattice = seeps->state().setup.lattice;
  for (const double y : {1.0, 1.75, 3.0})  // 1 m of head is lost over 4 m
    EXPECT_NEAR(seeps->state().grid.discharge[1][lattice.index(1, lattice.axis[1].nearest_edge(y))], 5e-4 / 4,
                0.01 * 5e-4 / 4)
        << y;
  for (const double y : {0.6, 1.7, 3.0})
    EXPECT_NEAR(seeps->pressure_at({0.25, y, 0}), water_weight * (5 - y - y / 4), 0.01 * water_weight) << y;
}

TEST(GradedUnsaturatedColumn, ConsolidatesAsTerzaghiSays) {
  constexpr double height = 4, modulus = 20e6 * 0.7 / (1.3 * 0.4), diffusivity = 5e-5 * modulus / water_weight;
  const auto run =
      after(column("4", R"([[load]]
span = [0, 0.5]
pressure = [["0 s", "0 kPa"], ["0.5 s", "50 kPa"]]
[[seepage_boundary]]
name = "ground"
line = [[0, 4], [0.5, 4]]
head = "4 m"
)",
                   rest + "max_step = \"0.1 s\"\n" + stage("event", "25 s", "local_damping = 0.7"), "5e-5 m/s"));
  const double T = diffusivity * 24.75 / (height * height);  // the load came in half a second
  for (const double y : {0.125, 1.0, 1.75, 3.0, 3.7}) {
    double share = 0;
    for (int m = 0; m < 50; ++m) {
      const double M = std::numbers::pi * (m + 0.5);
      share += 2 / M * std::sin(M * (1 - y / height)) * std::exp(-M * M * T);
    }
    EXPECT_NEAR(run->pressure_at({0.25, y, 0}) - water_weight * (4 - y), 50e3 * share, 0.01 * 50e3) << y;
  }
}

/// A level bed with fine cells across its middle along both axes.
TEST(GradedUnsaturatedGround, HoldsStillWhereBothAxesAreRefined) {
  const auto run =
      after(R"(
[model]
formulation = "unsaturated"
size = ["6 m", "5 m"]
cell = "0.5 m"
)" + finer("x", "[2.5, 3]", "0.1 m") +
            finer("height", "[1, 1.5]", "0.1 m") + finer("height", "[2.75, 3.25]", "0.25 m") + silt() + R"([initial]
water_table = [[0, 3], [6, 3]]
[[soil]]
material = "silt"
polygon = [[0, 0], [6, 0], [6, 3], [0, 3]]
)" + rest + stage("event", "10 s", "local_damping = 0.7"));
  EXPECT_LT(largest_displacement(run->state().soil), 1e-5);
  EXPECT_LT(stress_error(run->state(), [](double y) { return -(full_weight - water_weight) * (3 - y); }),
            0.02 * (full_weight - water_weight) * 3);
  for (const double x : {0.3, 2.2, 2.75, 4.5})
    for (const double y : {0.1, 1.2, 2.5})
      EXPECT_NEAR(run->pressure_at({x, y, 0}), water_weight * (3 - y), 2e-3 * water_weight * 3) << x << " " << y;
}

/// m²/s under a wall that reaches half way down a layer, 1 m of head, over the permeability: 0.5 between banks that go
/// on for ever.
double under_the_toe(const std::string& cells, std::ptrdiff_t& count) {
  Simulation<PlaneStrain> run(wall_in_silt(cells), 1);
  const double q = discharge_at_the_end(run);
  EXPECT_LT(run.audit().water_balance_error(run.state()), 1e-12);
  count = run.state().setup.lattice.cell_count();
  return q;
}

TEST(GradedUnsaturatedSeepage, PassesUnderTheToeOfAWallAsOnAFineGrid) {
  std::ptrdiff_t few = 0, many = 0;
  const double graded = under_the_toe("cell = [\"1 m\", \"0.2 m\"]\n" + finer("x", "[9.75, 10.25]", "0.05 m") +
                                          finer("height", "[0.8, 1.2]", "0.05 m"),
                                      few),
               fine = under_the_toe("cell = \"0.05 m\"\n", many);
  EXPECT_LT(10 * few, many);
  EXPECT_NEAR(graded, fine, 0.015 * fine);
  EXPECT_NEAR(graded, 0.5, 0.0125);
}

}  // namespace
}  // namespace polder
