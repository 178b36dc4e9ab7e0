// Free water beside upright sides of unsaturated ground: it seeps through them and presses on them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "case_text.hpp"
#include "polder/material/retention.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {
namespace {

/// A block of soil, 1 m high, from x = 1 m on, with water beside it.
std::string block(double end, double length, double k, bool fixed, double duration, const std::string& rest) {
  return fmt::format(R"(
[model]
size = ["{1} m", "1.5 m"]
cell = "0.05 m"
formulation = "unsaturated"
[[material]]
name = "sand"
law = "linear-elastic"
young_modulus = "20 MPa"
poisson_ratio = 0.3
grain_density = "2650 kg/m3"
porosity = 0.4
permeability = "{2} m/s"
permeability_exponent = 0
fixed = {5}
drag = "darcy"
[[retention]]
material = "sand"
model = "van-genuchten"
g_a = "40 1/m"
g_n = 3
residual = 0
[[soil]]
material = "sand"
box = [["1 m", "0 m"], ["{0} m", "1 m"]]
[[free_water]]
box = [["0 m", "0 m"], ["1 m", "0.8 m"]]
[numerics]
step_stretch = 1000
{4}
[[stage]]
name = "event"
duration = "{3} s"
local_damping = 0.7
)",
                     end, length, k, duration, rest, fixed);
}

std::unique_ptr<Simulation<PlaneStrain>> start(const std::string& text) {
  return std::make_unique<Simulation<PlaneStrain>>(read_text(text), 1);
}

double water_beyond(const Simulation<PlaneStrain>& run, double x) {
  const auto& water = run.state().water;
  double sum = 0;
  for (std::size_t p = 0; p < water.size(); ++p)
    if (water.position[0][p] > x) sum += water.volume[p];
  return sum;
}

const std::string held_river = R"(
[initial]
seepage = true
[[boundary]]
side = "base"
soil = "rough"
[[boundary]]
name = "river"
water = "reservoir"
region = [["0 m", "0 m"], ["0.5 m", "0 m"], ["0.5 m", "1.5 m"], ["0 m", "1.5 m"]]
head = "0.8 m"
)";

// Charny: between upright sides q = k (H² − h²)/2L whatever the water table.
TEST(OpenWaterSides, ADamOfUprightSidesLetsThroughWhatDupuitSays) {
  const auto run = start(block(2, 3, 0.01, true, 30, held_river));
  while (run->time() < 10) run->advance();
  const double time = run->time(), level = water_beyond(*run, 2);  // in a basin of 1 m
  while (!run->finished()) run->advance();
  const double risen = water_beyond(*run, 2) - level, tail = level + risen / 2;
  const double rate = risen / (run->time() - time), expected = 0.01 * (0.8 * 0.8 - tail * tail) / 2;
  std::printf("%.3e m2/s, Dupuit %.3e\n", rate, expected);
  EXPECT_NEAR(rate, expected, 0.03 * expected);
  EXPECT_LT(run->audit().water_balance_error(run->state()), 1e-12);
}

// Whatever lies in the block, its sections carry ρ_w g H²/2.
TEST(OpenWaterSides, WaterPressesOnAnUprightSide) {
  const auto run = start(block(2, 2, 1e-9, false, 20, R"(
[initial]
water_table = [["0 m", "0 m"], ["2 m", "0 m"]]
stress = "k0"
k0 = 0.43
)"));
  while (!run->finished()) run->advance();
  const auto& state = run->state();
  const auto& soil = state.soil;
  double force = 0;  // of one section, N/m
  for (std::size_t p = 0; p < soil.size(); ++p) {
    const std::array<double, 3> x = position_of(soil, p);
    if (x[0] < 1.25 || x[0] > 1.75) continue;
    const double bulk = soil.mass[p] / (2650 * (1 - soil.porosity[p]));
    const double suction = -run->pressure_at(x);
    force -= bulk * (soil.stress[0][p] + saturation(state.setup.pores[0].retention, suction) * suction) / 0.5;
  }
  const double expected = 9810 * 0.8 * 0.8 / 2;
  std::printf("%.1f N/m, water %.1f\n", force, expected);
  EXPECT_NEAR(force, expected, 0.03 * expected);
  EXPECT_NEAR(water_beyond(*run, -1), 0.8, 0.01);
}

}  // namespace
}  // namespace polder
