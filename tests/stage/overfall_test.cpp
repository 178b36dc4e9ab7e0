// Water that falls over an edge: it passes through the critical depth y_c = (q²/g)^⅓ on its way there.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "case_text.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {
namespace {

constexpr double critical = 0.2;                                   // m, y_c
const double discharge = std::sqrt(9.81 * std::pow(critical, 3));  // m²/s

/// Mean over the last seconds of the depth in columns of cells, m, and of what leaves, m²/s.
struct Flow {
  double upstream = 0, brink = 0, out = 0;
};

Flow run_over(const std::string& text, int bed_cells, int brink_column, int upstream_column, double from) {
  Simulation<PlaneStrain> run(read_text(text), 1);
  const auto& lattice = run.state().setup.lattice;
  Flow flow;
  double since = 0, left = 0;
  while (!run.finished()) {
    const double before = run.time();
    run.advance();
    if (before < from) {
      left = run.audit().water_out;
      continue;
    }
    const double dt = run.time() - before;
    since += dt;
    const auto depth = [&](int column) {
      double sum = 0;
      for (int j = bed_cells; j < lattice.cells[1]; ++j) sum += run.state().grid.water_volume[lattice.index(column, j)];
      return sum / lattice.spacing[0];
    };
    flow.brink += dt * (1.5 * depth(brink_column) - 0.5 * depth(brink_column - 1));  // at the edge
    flow.upstream += dt * depth(upstream_column);
  }
  flow.brink /= since;
  flow.upstream /= since;
  flow.out = (run.audit().water_out - left) / since;
  EXPECT_LT(run.audit().water_balance_error(run.state()), 1e-11);  // of thousands of points that leave
  return flow;
}

/// A channel in a model of this size that is 0.2 m deep at first, from a height on and up to a place, and ends at the
/// open right side.
std::string channel(const std::string& size, double bed, double end, const std::string& more) {
  return fmt::format(R"(
[model]
size = {0}
cell = "0.02 m"
[[free_water]]
box = [[0, {1}], [{3}, {2}]]
[[boundary]]
side = "left"
water = "inflow"
inflow = "{4} m/s"
span = [{1}, {2}]
[[boundary]]
side = "right"
water = "open"
[[stage]]
name = "fall"
duration = "8 s"
)",
                     size, bed, bed + 0.2, end, discharge / 0.2) +
         more;
}

/// All that flows in leaves, and the depth at the edge is this part of y_c.
void expect_brink(const char* name, const Flow& flow, double depth, double tolerance) {
  std::printf("%s: brink %.4f y_c, upstream %.4f y_c, out %.4f of q\n", name, flow.brink / critical,
              flow.upstream / critical, flow.out / discharge);
  EXPECT_NEAR(flow.brink / critical, depth, tolerance);
  EXPECT_NEAR(flow.out / discharge, 1, 0.03);
}

TEST(FreeOverfall, HasItsDepthAtTheBrink) {
  const Flow flow = run_over(channel(R"(["2.6 m", "0.8 m"])", 0.4, 2, R"(
[[wall]]
box = [[0, 0], [2, 0.4]]
[[boundary]]
side = "base"
water = "open"
span = [2, 2.6]
)"),
                             20, 99, 50, 5);
  expect_brink("overfall", flow, 0.715, 0.03 * 0.715);
}

TEST(OpenSide, LetsAChannelFallOutAtTheDepthOfNoPressure) {
  // q²/y + 0 = q²/y_c + g y_c²/2: two thirds of y_c where the pressure is zero all the way down
  const Flow flow = run_over(channel(R"(["2 m", "0.4 m"])", 0, 2, ""), 0, 99, 50, 5);
  expect_brink("open side", flow, 2.0 / 3, 0.03);
}

}  // namespace
}  // namespace polder
