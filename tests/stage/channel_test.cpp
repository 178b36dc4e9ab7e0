// A channel that is fed at one end and drained at the other keeps its discharge.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "case_text.hpp"
#include "polder/stage/simulation.hpp"
#include "polder/step/interior.hpp"

namespace polder {
namespace {

constexpr double depth = 0.3, discharge = 0.15;  // m, m²/s

/// What flows through the middle of the channel, m²/s.
double through_the_middle(const Stepper<PlaneStrain>& state) {
  const auto& lattice = state.setup.lattice;
  const auto& grid = state.grid;
  double flux = 0;
  for (int j = 0; j < lattice.cells[1]; ++j) {
    const std::ptrdiff_t f = lattice.index(lattice.cells[0] / 2, j);
    if (grid.reached[0][f])
      flux += flowing_share(state.setup, grid, 0, f) * grid.water_velocity[0][f] * lattice.spacing[1];
  }
  return flux;
}

/// The largest error of its mean over a second, of the discharge, from 20 s to 80 s: a minute after ten seconds of
/// rise.
void expect_steady(const std::string& outflow, double window, double flux_error) {
  Simulation<PlaneStrain> run(read_text(fmt::format(R"(
[model]
size = ["2 m", "0.6 m"]
cell = "0.025 m"
[[free_water]]
box = [["0 m", "0 m"], ["2 m", "{0} m"]]
[[boundary]]
side = "left"
water = "inflow"
inflow = [["0 s", "0 m/s"], ["10 s", "{1} m/s"]]
span = ["0 m", "{0} m"]
[[boundary]]
side = "right"
{2}
[[stage]]
name = "flow"
duration = "80 s"
)",
                                                    depth, discharge / depth, outflow)),
                              1);
  double worst = 0, passed = 0, since = 0;
  while (!run.finished()) {
    const double before = run.time();
    run.advance();
    if (before < 20) continue;
    const double dt = run.time() - before;
    passed += dt * through_the_middle(run.state());
    since += dt;
    if (since < window) continue;
    worst = std::max(worst, std::abs(passed / since / discharge - 1));
    passed = since = 0;
  }
  std::printf("%g s: %.4f of q off at worst, flux balance %.5f\n", window, worst, run.audit().worst_flux().error);
  EXPECT_LT(worst, 0.01);
  EXPECT_LT(run.audit().worst_flux().error, flux_error);
  EXPECT_LT(run.audit().water_balance_error(run.state()), 1e-11);  // of thousands of points that come and go
}

TEST(Channel, KeepsItsDischargeBetweenAnInflowAndAnOutflow) {
  expect_steady(
      fmt::format("water = \"inflow\"\ninflow = [[\"0 s\", \"0 m/s\"], [\"10 s\", \"{} m/s\"]]\nspan = [\"0 m\", "
                  "\"{} m\"]\n",
                  -discharge / depth, depth),
      5, 0.01);
}

// The level lies on a line of the grid, where cells are full and not by turns: the flux is known to 1.2 % there.
TEST(Channel, KeepsItsDischargeToAWaterLevel) {
  expect_steady(fmt::format("water = \"head\"\nhead = \"{} m\"\n", depth), 1, 0.015);
}

}  // namespace
}  // namespace polder
