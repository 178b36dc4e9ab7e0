// Friction between soil and thin walls: Coulomb's, on one face to round-off; in a silo what holds the grain up.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "case_text.hpp"
#include "polder/stage/simulation.hpp"
#include "polder/step/wall_friction.hpp"

namespace polder {
namespace {

std::string silo(const std::string& friction) {
  return fmt::format(R"(
[model]
size = [1.2, 2.4]
cell = 0.1
[[material]]
name = "grain"
law = "mohr-coulomb"
young_modulus = "2 MPa"
poisson_ratio = 0.3
friction_angle = "30 deg"
grain_density = "2500 kg/m3"
porosity = 0.4
permeability = "1e-2 m/s"
[[soil]]
material = "grain"
box = [[0.4, 0], [0.8, 2]]
[initial]
stress = "none"
[[wall]]
line = [[0.4, 0], [0.4, 2.4]]
{0}
[[wall]]
line = [[0.8, 0], [0.8, 2.4]]
{0}
[[stage]]
name = "gravity"
initial = true
duration = "1 s"
ramp = "0.6 s"
damping = "20 1/s"
[[stage]]
name = "rest"
duration = "0.2 s"
damping = "20 1/s"
)",
                     friction);
}

/// Pa, mean of −σyy of the lowest row of cells.
double base_stress(const Simulation<PlaneStrain>& run) {
  const auto& soil = run.state().soil;
  double sum = 0;
  int number = 0;
  for (std::size_t p = 0; p < soil.size(); ++p)
    if (soil.position[1][p] < 0.1) sum -= soil.stress[1][p], ++number;
  return sum / number;
}

TEST(WallFriction, IsCoulombsOnEachFace) {
  Simulation<PlaneStrain> run(read_text(silo("friction_angle = \"20 deg\"")), 1);
  run.advance();
  auto& state = run.state();
  const auto& lattice = state.setup.lattice;
  ASSERT_EQ(state.setup.friction.size(), 48u);
  for (auto& s : state.soil.stress) std::fill(s.begin(), s.end(), -1000.0);
  auto& v = state.grid.soil_velocity[1];
  std::fill(v.begin(), v.end(), -1.0);
  const double dt = 1e-3;
  rub_along_walls(state.setup, dt, state.soil, state.grid);
  const std::ptrdiff_t beside = lattice.index(4, 10), inside = lattice.index(5, 10);
  // the halves of two faces of 0.1 m meet at each node
  const double change = dt * std::tan(20 * M_PI / 180) * 1000 * 0.1 / state.grid.soil_mass[1][beside];
  EXPECT_NEAR(v[beside], -1 + change, 1e-12);
  EXPECT_EQ(v[inside], -1);
  std::fill(v.begin(), v.end(), 1e-9);  // and it never pushes
  rub_along_walls(state.setup, dt, state.soil, state.grid);
  EXPECT_EQ(v[beside], 0);
}

TEST(WallFriction, CarriesPartOfASilo) {
  const double weight = 0.6 * 2500 * 9.81 * 1.95;  // Pa at the middle of the lowest row
  Simulation<PlaneStrain> smooth(read_text(silo("")), 1), rough(read_text(silo("friction_angle = \"25 deg\"")), 1);
  while (!smooth.finished()) smooth.advance();
  while (!rough.finished()) rough.advance();
  EXPECT_NEAR(base_stress(smooth), weight, 0.05 * weight);
  // Janssen with the earth pressure ratios between K_a = 1/3 and K = 1: γB/(2μK) (1 − exp(−2μKz/B))
  const auto janssen = [](double k) {
    const double mu = std::tan(25 * M_PI / 180), b = 0.4, gamma = 0.6 * 2500 * 9.81;
    return gamma * b / (2 * mu * k) * (1 - std::exp(-2 * mu * k * 1.95 / b));
  };
  EXPECT_LT(base_stress(rough), janssen(1.0 / 3) * 1.1);
  EXPECT_GT(base_stress(rough), janssen(1) * 0.9);
  RecordProperty("base_stress_kPa", std::to_string(base_stress(rough) / 1e3));
}

}  // namespace
}  // namespace polder
