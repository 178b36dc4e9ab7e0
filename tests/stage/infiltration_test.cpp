// Water that falls into dry crushed rock, against the equation of motion of the whole body of water: the jump of the
// porosity at the rock's face, the drag at high Reynolds numbers and the front in dry pores, all in one.
#include <gtest/gtest.h>

#include <algorithm>

#include "case_text.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {
namespace {

/// Water h deep over rock that it has wetted to a depth x, at the discharge q (per area):
///   ρ (h + x/n) dq/dt = ρ g (h + x) − (a q + b q²) x − ½ ρ q² (1/n² − 1),   dx/dt = q/n,   dh/dt = −q,
/// a = 150 μ (1 − n)²/(n³ D²), b = 1.75 ρ (1 − n)/(n³ D) after Ergun; the last term speeds water up to q/n as it
/// enters.
struct Front {
  static constexpr double n = 0.49, diameter = 0.0159, density = 1000, gravity = 9.81;
  static constexpr double a = 150 * 1e-3 * (1 - n) * (1 - n) / (n * n * n * diameter * diameter);
  static constexpr double b = 1.75 * density * (1 - n) / (n * n * n * diameter);
  double time = 0, h = 0.4, x = 1e-6, q = 0;

  void advance_to(double until) {
    const double dt = 1e-5;
    for (; time < until; time += dt) {
      q += dt * (density * gravity * (h + x) - (a * q + b * q * q) * x - 0.5 * density * q * q * (1 / (n * n) - 1)) /
           (density * (h + x / n));
      x += dt * q / n;
      h -= dt * q;
    }
  }
};

TEST(Infiltration, IntoDryRockFollowsTheBodyOfWater) {
  Simulation<PlaneStrain> run(read_text(R"(
[model]
size  = ["0.05 m", "1 m"]
cell  = "0.01 m"
[[material]]
name = "crushed rock"
law  = "linear-elastic"
young_modulus  = "1 GPa"
fixed          = true
grain_density  = "2700 kg/m3"
porosity       = 0.49
max_porosity   = 0.9
grain_diameter = "15.9 mm"
drag           = "ergun"
[[soil]]
material = "crushed rock"
box = [["0 m", "0 m"], ["0.05 m", "0.5 m"]]
[[free_water]]
box = [["0 m", "0.5 m"], ["0.05 m", "0.9 m"]]
[initial]
water_table = [["0 m", "0 m"], ["0.05 m", "0 m"]]
[[stage]]
name = "flow"
duration = "0.4 s"
)"),
                              1);
  Front exact;
  while (!run.finished()) {
    run.advance();
    exact.advance_to(run.time());
    const auto& heights = run.state().water.position[1];
    const double front = 0.5 - *std::min_element(heights.begin(), heights.end());
    if (run.time() < 0.05) continue;  // it is within the cell beside the face
    EXPECT_NEAR(front, exact.x, 0.003) << run.time();
  }
  EXPECT_GT(exact.x, 0.22);
}

}  // namespace
}  // namespace polder
