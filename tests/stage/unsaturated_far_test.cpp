// Absorbing sides in the unsaturated formulation.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "case_text.hpp"
#include "largest_displacement.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {
namespace {

constexpr double young = 100e6, poisson = 0.3;
constexpr double modulus = young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson));

/// Soil of E = 100 MPa. By `g_a` it is all but dry a few centimetres over the water table, or full of water.
std::string ground(const std::string& size, const std::string& cell, const std::string& table, const std::string& g_a,
                   const std::string& sides, const std::string& more) {
  std::string text = fmt::format(R"(
[model]
formulation = "unsaturated"
size = {0}
cell = "{1}"
[[material]]
name = "soil"
law = "linear-elastic"
grain_density = "2650 kg/m3"
porosity = 0.4
permeability = "1e-4 m/s"
young_modulus = "100 MPa"
poisson_ratio = 0.3
[[retention]]
material = "soil"
model = "van-genuchten"
g_a = "{3} 1/m"
g_n = 2
residual = 0.05
[initial]
water_table = {2}
)",
                                 size, cell, table, g_a);
  const bool all = more.find("# all sides") != std::string::npos;
  for (const char* side : {"left", "right", "base", "top"})
    if (all || *side == 'l' || *side == 'r')
      text += fmt::format("[[boundary]]\nside = \"{}\"\nsoil = \"{}\"\n", side, sides);
  return text + more;
}

/// The share of a pulse's energy that is left when a wave of `speed` has crossed the model: along a bar, or in the
/// middle of a square, upwards.
double left_of_pulse(bool square, const std::string& sides, const std::string& table, const std::string& g_a,
                     double speed, const std::string& step) {
  const double length = square ? 8 : 20, height = square ? 8 : 0.2, width = square ? 0.8 : 1.5;
  Simulation<PlaneStrain> run(read_text(ground(fmt::format("[{}, {}]", length, height), "0.2 m", table, g_a, sides,
                                               fmt::format(R"(
[[soil]]
material = "soil"
box = [[0, 0], [{0}, {1}]]
[[seepage_boundary]]
name = "top"
line = [[0, {1}], [{0}, {1}]]
condition = "closed"
[[stage]]
name = "wave"
duration = "1 s"
[numerics]
max_step = "{2}"
{3}
)",
                                                           length, height, step, square ? "# all sides" : ""))),
                              1);
  auto& state = run.state();
  auto& soil = state.soil;
  std::map<std::uint64_t, std::array<double, 4>> rest;
  for (std::size_t p = 0; p < soil.size(); ++p) {
    for (std::size_t s = 0; s < 4; ++s) rest[soil.id[p]][s] = soil.stress[s][p];
    const double x = soil.position[0][p] - 0.5 * length, y = square ? soil.position[1][p] - 0.5 * height : 0;
    soil.velocity[square][p] = (square ? 0.1 : 1e-4) * std::exp(-(x * x + y * y) / (width * width));
  }
  const Array pressure = state.grid.pressure;
  const auto energy = [&] {  // J/m: of motion, of the change of the grains' stress, of that of the water's pressure
    double sum = 0;
    for (std::size_t p = 0; p < soil.size(); ++p) {
      double squares = 0, trace = 0;
      for (std::size_t s = 0; s < 4; ++s) {
        const double change = soil.stress[s][p] - rest.at(soil.id[p])[s];
        squares += (s < 3 ? 1 : 2) * change * change;
        if (s < 3) trace += change;
      }
      const double volume = soil.mass[p] / (2650 * (1 - soil.porosity[p]));
      sum += 0.5 * (soil.mass[p] + 1000 * soil.water[p]) * speed_squared(soil, p) +
             0.5 * volume / young * ((1 + poisson) * squares - poisson * trace * trace);
    }
    const auto& pores = state.unsaturated->pores;
    over_all_cells(state.setup.lattice, [&](std::ptrdiff_t cell, const std::array<int, 3>&) {
      sum += 0.5 * pores.storage[cell] * std::pow(state.grid.pressure[cell] - pressure[cell], 2);
    });
    return sum;
  };
  const double start = energy(), end = length / speed;
  StepControl control;
  while (control.time < end * (1 - 1e-9)) {
    const double dt = std::min(state.natural_step(), end - control.time);
    control.time += dt;
    state.advance(control, dt);
  }
  return energy() / start;
}

TEST(UnsaturatedAbsorbingSides, LetAPulseOutOfMoistAndOfSaturatedSoil) {
  const double grains = 0.6 * 2650, shear = young / (2 * (1 + poisson));
  struct Ground {
    bool square;
    std::string table, g_a, step;
    double speed, kept;  // by sides that are closed
  };
  for (const Ground& g : {Ground{false, "[[0, 0], [20, 0]]", "200", "1 s", std::sqrt(modulus / (grains + 40)), 0.9},
                          Ground{false, "[[0, 0.2], [20, 0.2]]", "0.3", "10 us",
                                 std::sqrt((modulus + 2.2e9 / 0.4) / (grains + 400)), 0.7},
                          Ground{true, "[[0, 0], [8, 0]]", "200", "1 s", std::sqrt(shear / (grains + 40)), 0.5}}) {
    const double open = left_of_pulse(g.square, "absorbing", g.table, g.g_a, g.speed, g.step),
                 shut = left_of_pulse(g.square, "roller", g.table, g.g_a, g.speed, g.step);
    EXPECT_LT(open, g.square ? 0.05 : 0.01);
    EXPECT_GT(shut, g.kept);
  }
}

TEST(UnsaturatedAbsorbingSides, HoldTheGroundAtRest) {
  Simulation<PlaneStrain> run(
      read_text(ground(R"(["4 m", "5 m"])", "0.25 m", "[[0, 2], [4, 2]]", "0.3", "absorbing", R"(
[[soil]]
material = "soil"
polygon = [[0, 0], [4, 0], [4, 4], [0, 4]]
[[boundary]]
side = "base"
soil = "absorbing"
[[stage]]
name = "rest"
duration = "10 s"
initial = true
local_damping = 0.7
until_rest = true
[[stage]]
name = "event"
duration = "2 s"
)")),
      1);
  while (!run.finished()) run.advance();
  EXPECT_LT(largest_displacement(run.state().soil), 1e-5);
  EXPECT_LT(run.audit().water_balance_error(run.state()), 1e-12);
}

}  // namespace
}  // namespace polder
