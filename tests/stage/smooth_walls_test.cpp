// Water rubs along a smooth wall as the law of the wall says: the stress of a known layer, and a sheet of water that
// runs down a slope or is taken along by its floor.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "case_text.hpp"
#include "polder/stage/simulation.hpp"
#include "polder/step/smooth_walls.hpp"

namespace polder {
namespace {

const WaterProperties water{};  // 1000 kg/m³, 1e-3 Pa s

/// Mean over 0 … y⁺ of the logarithmic law ln(y⁺)/0.41 + 5.2.
double mean_of_logarithmic_law(double y) { return (std::log(y) - 1) / 0.41 + 5.2; }

TEST(StressOnSmoothWall, IsViscousInAThinLayerAndFollowsTheLogarithmicLawInAThickOne) {
  EXPECT_DOUBLE_EQ(stress_on_smooth_wall(0.01, 1e-3, water), 2 * 1e-3 * 0.01 / 1e-3);
  const double edge = 0.5 * 1e-3 * std::pow(8.3, 7.0 / 3);  // m/s, where the layer ends at y⁺ = 11.81
  EXPECT_NEAR(stress_on_smooth_wall(edge * (1 + 1e-9), 1e-3, water) / stress_on_smooth_wall(edge, 1e-3, water), 1,
              1e-6);
  for (const double speed : {1.0, 3.0, 6.0}) {
    const double u = std::sqrt(stress_on_smooth_wall(speed, 2e-3, water) / water.density);
    const double thickness = u * 2e-3 * water.density / water.viscosity;  // y⁺
    EXPECT_GT(thickness, 100);
    EXPECT_NEAR(speed / u, mean_of_logarithmic_law(thickness), 0.05 * speed / u) << "y+ = " << thickness;
  }
}

constexpr double depth = 0.01, gravity = 9.81;  // SI

/// Mean speed of a sheet of water one cell deep, after a time.
double speed_of_sheet(const std::string& model, const std::string& side, double time) {
  Simulation<PlaneStrain> run(read_text(fmt::format(R"(
[model]
size = ["0.2 m", "0.04 m"]
cell = "{} m"
points_per_axis = 4
periodic = true
{}
[[free_water]]
box = [["0 m", "0 m"], ["0.2 m", "{} m"]]
[[boundary]]
side = "base"
water = "no-slip"
{}
[[stage]]
name = "run"
duration = "{} s"
)",
                                                    depth, model, depth, side, time)),
                              1);
  while (!run.finished()) run.advance();
  double momentum = 0, volume = 0;
  const auto& points = run.state().water;
  for (std::size_t p = 0; p < points.size(); ++p) {
    momentum += points.volume[p] * points.velocity[0][p];
    volume += points.volume[p];
  }
  return momentum / volume;
}

/// Of a sheet that moves as one: dv/dt = pull + τ(wall − v)/(ρ depth), from rest.
double exact_speed(double pull, double wall, double time) {
  double v = 0;
  constexpr int steps = 20000;
  for (int i = 0; i < steps; ++i) {
    const double past = wall - v;
    v += time / steps *
         (pull + std::copysign(stress_on_smooth_wall(std::abs(past), depth, water), past) / (water.density * depth));
  }
  return v;
}

TEST(SmoothWall, HoldsASheetOfWaterOnASlopeAtItsTerminalSpeed) {
  const double terminal = exact_speed(gravity * std::sin(2 * std::numbers::pi / 180), 0, 20);
  EXPECT_LT(terminal, 0.2 * gravity * std::sin(2 * std::numbers::pi / 180) * 20);  // else there is no friction to see
  EXPECT_NEAR(speed_of_sheet("tilt = \"2 deg\"", "", 20), terminal, 0.02 * terminal);
}

TEST(SmoothWall, TakesASheetOfWaterAlong) {
  const double exact = exact_speed(0, 1, 1);
  EXPECT_GT(exact, 0.1);
  EXPECT_NEAR(speed_of_sheet("", "slide = \"1 m/s\"", 1), exact, 0.02 * exact);
}

}  // namespace
}  // namespace polder
