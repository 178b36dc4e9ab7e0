// Walls thinner than a cell: nothing crosses them, the two sides do not feel each other, and seepage goes around the
// toe as the exact solutions say (REFERENCES A13).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "case_text.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {
namespace {

TEST(ThinWall, KeepsAMetreOfHeadForTenSeconds) {
  const Model model = read_text(R"(
[model]
size = ["2 m", "1.6 m"]
cell = "0.1 m"
[[free_water]]
box = [["0 m", "0 m"], ["1 m", "1.2 m"]]
[[free_water]]
box = [["1 m", "0 m"], ["2 m", "0.2 m"]]
[[wall]]
line = [["1 m", "0 m"], ["1 m", "1.6 m"]]
[[stage]]
name = "rest"
duration = "10 s"
)");
  Simulation<PlaneStrain> run(model, 1);
  const auto left_of = [&] {
    std::vector<double> volume(2, 0.0);
    const auto& water = run.state().water;
    for (std::size_t p = 0; p < water.size(); ++p) volume[water.position[0][p] > 1] += water.volume[p];
    return volume;
  };
  const auto before = left_of();
  const auto& state = run.state();
  while (!run.finished()) {
    run.advance();
    for (int j = 0; j < 16; ++j) ASSERT_EQ(state.grid.water_velocity[0][state.setup.lattice.index(10, j)], 0);
  }
  EXPECT_EQ(left_of(), before);
  double speed = 0;
  for (const auto& v : state.water.velocity)
    for (const double u : v) speed = std::max(speed, std::abs(u));
  EXPECT_LT(speed, 1e-6);
  for (const auto& [x, level] : {std::pair{0.95, 1.2}, std::pair{1.05, 0.2}})
    EXPECT_NEAR(run.pressure_at({x, 0.05, 0}), 9810 * (level - 0.05), 1e-4 * 9810);
}

/// Seepage under a wall that ends s = 5 m below the lower ground, at y = 10 m, which stands on T = 10 m of soil; behind
/// the wall the ground is `excavated` higher. Heads differ by H = 4 m. The right side is far away or, of a cofferdam,
/// its axis at the distance b. Soil is rigid, and the water so stiff that the flow is steady within the run.
struct Seepage {
  double discharge;      // q/kH
  double exit_gradient;  // at the wall, I_E s/H
  double mean_excess;    // mean excess head at the toe's level over s/2 beside the wall, of H
};

Seepage around_wall(double cell, double left, double right, double excavated) {
  constexpr double s = 5, head = 4, conductivity = 1e-3;
  const double low = 10, high = low + excavated, outside = std::max(high + 1, low + 1 + head), inside = outside - head;
  const Model model =
      read_text(fmt::format(R"(
[model]
size = [{0}, {1}]
cell = {2}
points_per_axis = 1
[water]
bulk_modulus = "100 GPa"
[[material]]
name = "sand"
law = "linear-elastic"
young_modulus = "10 MPa"
poisson_ratio = 0.3
grain_density = "2650 kg/m3"
porosity = 0.4
permeability = "1e-3 m/s"
drag = "darcy"
fixed = true
[[soil]]
material = "sand"
box = [[0, 0], [{3}, {4}]]
[[soil]]
material = "sand"
box = [[{3}, 0], [{0}, {5}]]
[[free_water]]
box = [[0, {4}], [{3}, {6}]]
[[free_water]]
box = [[{3}, {5}], [{0}, {7}]]
[initial]
water_table = [[0, {4}], [{3}, {4}], [{8}, {5}]]
stress = "none"
[[wall]]
line = [[{3}, 5], [{3}, {1}]]
[[stage]]
name = "steady"
duration = "0.3 s"
)",
                            left + right, outside + 1, cell, left, high, low, outside, inside, left + 1e-6));
  Simulation<PlaneStrain> run(model, 1);
  while (!run.finished()) run.advance();
  const auto& lattice = run.state().setup.lattice;
  const auto& grid = run.state().grid;
  const int wall = static_cast<int>(std::lround(left / cell)), toe = static_cast<int>(std::lround(5 / cell)),
            ground = static_cast<int>(std::lround(low / cell)), width = static_cast<int>(std::lround(0.5 * s / cell));
  const auto flux = [&](int axis, int i, int j) {
    const std::ptrdiff_t f = lattice.index(i, j);
    return grid.porosity[axis][f] * grid.water_velocity[axis][f];
  };
  Seepage seepage{0, flux(1, wall, ground) / conductivity * s / head, 0};
  for (int j = 0; j < toe; ++j) seepage.discharge += flux(0, wall, j) * cell / (conductivity * head);
  for (int i = wall; i < wall + width; ++i)
    for (const int j : {toe - 1, toe})
      seepage.mean_excess +=
          (grid.pressure[lattice.index(i, j)] / 9810 + (j + 0.5) * cell - inside) / head / (2 * width);
  return seepage;
}

TEST(SheetPile, DischargeExitGradientAndHeave) {
  const Seepage seepage = around_wall(0.125, 30, 30, 0);
  EXPECT_NEAR(seepage.discharge, 0.5, 0.02 * 0.5);
  EXPECT_NEAR(seepage.exit_gradient, 0.29954, 0.02 * 0.29954);
  EXPECT_NEAR(seepage.mean_excess, 0.34136, 0.02 * 0.34136);
}

TEST(Cofferdam, DischargeExitGradientAndHeave) {
  const Seepage seepage = around_wall(0.125, 30, 5, 0);
  EXPECT_NEAR(seepage.discharge, 0.4041, 0.02 * 0.4041);
  EXPECT_NEAR(seepage.exit_gradient, 0.4228, 0.02 * 0.4228);
  EXPECT_NEAR(seepage.mean_excess, 0.4442, 0.02 * 0.4442);
}

TEST(Cofferdam, Excavated) {
  const Seepage seepage = around_wall(0.125, 30, 10, 5);
  EXPECT_NEAR(seepage.discharge, 0.4233, 0.02 * 0.4233);
  EXPECT_NEAR(seepage.exit_gradient, 0.2861, 0.02 * 0.2861);
  EXPECT_NEAR(seepage.mean_excess, 0.3191, 0.02 * 0.3191);
}

}  // namespace
}  // namespace polder
