// Gates and moving loads in the unsaturated formulation.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "case_text.hpp"
#include "polder/stage/simulation.hpp"
#include "silt.hpp"

namespace polder {
namespace {

constexpr double water_weight = 9810;  // N/m³

double balance(const Simulation<PlaneStrain>& run) {
  return std::max(run.audit().water_balance_error(run.state()), run.audit().solid_mass_error(run.state()));
}

TEST(UnsaturatedGate, PartsPoreWaterUntilItsTime) {
  std::string conductive = silt();
  conductive.replace(conductive.find("5e-4 m/s"), 8, "1e-2 m/s");
  Simulation<PlaneStrain> run(read_text(R"(
[model]
formulation = "unsaturated"
size = ["4 m", "5 m"]
cell = "0.25 m"
[numerics]
step_stretch = 1000
[initial]
water_table = [[0, 3], [2, 3], [2.001, 1], [4, 1]]
)" + conductive + R"([[soil]]
material = "silt"
polygon = [[0, 0], [4, 0], [4, 4], [0, 4]]
[[wall]]
line = [[2, 5], [2, 0]]
until = "20 s"
[[stage]]
name = "rest"
duration = "20 s"
initial = true
local_damping = 0.7
until_rest = true
[[stage]]
name = "event"
duration = "900 s"
local_damping = 0.7
)"),
                              1);
  const auto difference = [&] { return run.pressure_at({0.5, 0.375, 0}) - run.pressure_at({3.5, 0.375, 0}); };
  while (run.time() < 20 - 1e-9) run.advance();
  EXPECT_NEAR(run.time(), 20, 1e-9);  // a step ends there
  EXPECT_NEAR(difference(), 2 * water_weight, 0.01 * water_weight);
  double before = difference();
  while (!run.finished()) {
    run.advance();
    EXPECT_LT(difference(), before + 0.02 * water_weight);
    before = difference();
  }
  EXPECT_NEAR(difference(), 0, 0.01 * water_weight);
  // where the water of both comes to rest
  const auto held = [](double level) {  // m of water in a column of 4 m
    double sum = 0;
    for (int i = 0; i < 4000; ++i) {
      const double suction = std::max(0.0, (i + 0.5) * 1e-3 - level);
      sum += 1e-3 * 0.4 * (0.05 + 0.95 / std::sqrt(1 + std::pow(0.3 * suction, 2)));
    }
    return sum;
  };
  double low = 1, high = 3;
  for (int i = 0; i < 40; ++i) (held(0.5 * (low + high)) < 0.5 * (held(1) + held(3)) ? low : high) = 0.5 * (low + high);
  EXPECT_NEAR(run.pressure_at({2, 0.375, 0}), water_weight * (low - 0.375), 0.02 * water_weight);
  EXPECT_LT(balance(run), 1e-12);
}

TEST(UnsaturatedGate, OfABodyLetsSoilGo) {
  Simulation<PlaneStrain> run(read_text(R"(
[model]
formulation = "unsaturated"
size = ["4 m", "2 m"]
cell = "0.1 m"
[[material]]
name = "sand"
law = "mohr-coulomb"
grain_density = "2650 kg/m3"
porosity = 0.4
permeability = "1e-3 m/s"
young_modulus = "2 MPa"
poisson_ratio = 0.3
friction_angle = "30 deg"
[[retention]]
material = "sand"
model = "van-genuchten"
g_a = "20 1/m"
g_n = 2
residual = 0.05
[initial]
water_table = [[0, 0], [4, 0]]
[[soil]]
material = "sand"
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[wall]]
name = "gate"
box = [[1, 0], [1.4, 1.5]]
until = "0.3 s"
[[boundary]]
side = "base"
soil = "rough"
[[stage]]
name = "event"
duration = "1.3 s"
)"),
                              1);
  const auto front = [&] {
    const auto& x = run.state().soil.position[0];
    return *std::max_element(x.begin(), x.end());
  };
  while (run.time() < 0.3 - 1e-9) run.advance();
  EXPECT_LT(front(), 1);
  while (!run.finished()) run.advance();
  EXPECT_GT(front(), 1.5);
  EXPECT_LT(balance(run), 1e-12);
}

TEST(UnsaturatedTraffic, IsCarriedWhereItIsAndLeavesNothingBehind) {
  Simulation<PlaneStrain> run(read_text(R"(
[model]
formulation = "unsaturated"
size = ["12 m", "2 m"]
cell = "0.25 m"
[numerics]
step_stretch = 20
[initial]
water_table = [[0, 0.75], [12, 0.75]]
)" + silt() + R"([[soil]]
material = "silt"
polygon = [[0, 0], [12, 0], [12, 1.5], [0, 1.5]]
[[load]]
span = [-3, -1]
pressure = "50 kPa"
speed = "4 m/s"
[[stage]]
name = "rest"
duration = "20 s"
initial = true
local_damping = 0.7
until_rest = true
[[stage]]
name = "event"
duration = "7 s"
local_damping = 0.5
)"),
                              1);
  const auto& soil = run.state().soil;
  const auto on_base = [&](double from, double to) {  // N, of total stress in the lowest row of cells
    double sum = 0;
    for (std::size_t p = 0; p < soil.size(); ++p)
      if (soil.position[1][p] < 0.25 && soil.position[0][p] > from && soil.position[0][p] < to)
        sum += (run.pressure_at({soil.position[0][p], soil.position[1][p], 0}) - soil.stress[1][p]) * 0.125 / 2;
    return sum;
  };
  while (run.time() < 0) run.advance();
  const double all = on_base(0, 12), middle = on_base(4, 8);
  bool seen = false;
  while (!run.finished()) {
    run.advance();
    if (seen || run.time() < 2) continue;  // it stands between 5 m and 7 m
    seen = true;
    EXPECT_NEAR(on_base(0, 12) - all, 100e3, 0.03 * 100e3);
    EXPECT_NEAR(on_base(4, 8) - middle, 100e3, 0.1 * 100e3);
  }
  EXPECT_TRUE(seen);
  EXPECT_NEAR(on_base(0, 12), all, 0.02 * 100e3);
  double way = 0;
  for (std::size_t p = 0; p < soil.size(); ++p)
    way = std::max(way, std::abs(soil.position[1][p] - soil.reference[1][p]));
  EXPECT_LT(way, 5e-5);  // under it: some 3 mm
  EXPECT_LT(balance(run), 1e-12);
}

}  // namespace
}  // namespace polder
