// Steady seepage as the state at the start, and that ways to begin a slope agree.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "case_text.hpp"
#include "largest_displacement.hpp"
#include "level_sand.hpp"
#include "polder/stage/seepage_start.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {
namespace {

/// A block of soil, 4 m wide, between water 2 m and 1 m deep.
std::string block(const std::string& formulation, const std::string& sides, const std::string& initial) {
  return fmt::format(R"(
[model]
formulation = "{}"
size = ["4 m", "2.5 m"]
cell = "0.125 m"
[[material]]
name = "sand"
law = "linear-elastic"
young_modulus = "50 MPa"
poisson_ratio = 0.3
grain_density = "2650 kg/m3"
porosity = 0.4
permeability = "1e-3 m/s"
drag = "darcy"
[[retention]]
material = "sand"
model = "van-genuchten"
g_a = "4 1/m"
g_n = 2
residual = 0.1
[[soil]]
material = "sand"
box = [["0 m", "0 m"], ["4 m", "2.5 m"]]
[initial]
{}
[[boundary]]
side = "base"
soil = "rough"
{}
[numerics]
step_stretch = 1000
[[stage]]
name = "rest"
duration = "5 s"
initial = true
local_damping = 0.7
hold_water = true
[[stage]]
name = "event"
duration = "120 s"
local_damping = 0.7
)",
                     formulation, initial, sides);
}

const std::string ends = R"(
[[seepage_boundary]]
name = "left"
line = [["0 m", "0 m"], ["0 m", "2.5 m"]]
head = "2 m"
[[seepage_boundary]]
name = "right"
line = [["4 m", "0 m"], ["4 m", "2.5 m"]]
head = "1 m"
)";

/// How far pressures at the middle go from where they begin in two minutes, of a metre of water.
double furthest(const std::string& initial) {
  Simulation<PlaneStrain> run(read_text(block("unsaturated", ends, initial)), 1);
  const auto pressures = [&] {
    std::array<double, 6> p{};
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = run.pressure_at({2, 0.2 + 0.4 * static_cast<double>(i), 0});
    return p;
  };
  while (run.time() < 0) run.advance();
  const auto before = pressures();
  while (!run.finished()) run.advance();
  const auto after = pressures();
  double most = 0;
  for (std::size_t i = 0; i < before.size(); ++i) most = std::max(most, std::abs(after[i] - before[i]) / 9810);
  EXPECT_LT(run.audit().water_balance_error(run.state()), 1e-12);
  return most;
}

TEST(SeepageStart, IsSteady) {
  const double computed = furthest("seepage = true"), level = furthest("water_table = [[0, 1.5], [4, 1.5]]");
  std::printf("pressures go %.4f m from steady seepage, %.4f m from a level water table\n", computed, level);
  EXPECT_LT(computed, 0.02);
  EXPECT_GT(level, 4 * computed);
}

// Dupuit: h² falls evenly
TEST(SeepageStart, GivesTheWaterTableOfADam) {
  const Model model = with_steady_seepage(read_text(block("unsaturated", ends, "seepage = true")));
  ASSERT_EQ(model.water_table.size(), 32u);
  EXPECT_NEAR(height_at(model.water_table, 2), std::sqrt(2.5), 0.06);
  EXPECT_NEAR(height_at(model.water_table, 0.5), std::sqrt(4 - 3 * 0.125), 0.06);
}

/// A slope of 27°, 1.5 m high, with its water table at its toe, begun in one of three ways.
std::unique_ptr<Simulation<PlaneStrain>> slope(const std::string& initial, const std::string& ramp) {
  auto run = std::make_unique<Simulation<PlaneStrain>>(read_text(fmt::format(R"(
[model]
formulation = "unsaturated"
size = ["10 m", "3 m"]
cell = "0.125 m"
[[material]]
name = "silt"
law = "mohr-coulomb"
young_modulus = "20 MPa"
poisson_ratio = 0.3
friction_angle = "35 deg"
cohesion = "10 kPa"
grain_density = "2650 kg/m3"
porosity = 0.4
permeability = "1e-4 m/s"
[[retention]]
material = "silt"
model = "van-genuchten"
g_a = "1 1/m"
g_n = 2
residual = 0.1
[[soil]]
material = "silt"
polygon = [["0 m", "0 m"], ["10 m", "0 m"], ["10 m", "2.5 m"], ["6.47 m", "2.5 m"], ["3.53 m", "1 m"], ["0 m", "1 m"]]
[initial]
{0}
[[boundary]]
side = "base"
soil = "rough"
[[seepage_boundary]]
name = "left"
line = [["0 m", "0 m"], ["0 m", "1 m"]]
head = "1 m"
[[seepage_boundary]]
name = "right"
line = [["10 m", "0 m"], ["10 m", "2.5 m"]]
head = "1 m"
[numerics]
step_stretch = 1000
[[stage]]
name = "rest"
duration = "60 s"
initial = true
local_damping = 0.7
hold_water = true
until_rest = true
{1}
[[stage]]
name = "release"
duration = "10 s"
local_damping = 0.05
)",
                                                                             initial, ramp)),
                                                       1);
  while (!run->finished()) run->advance();
  return run;
}

/// Sums over the points two cells and more under the surface: of |Δσ'| over those of |σ'|, vertical and horizontal.
std::array<double, 2> apart(const SoilPoints<PlaneStrain>& soil, const SoilPoints<PlaneStrain>& reference) {
  std::array<double, 2> difference{}, size{};
  EXPECT_EQ(soil.size(), reference.size());
  for (std::size_t p = 0; p < soil.size(); ++p) {
    EXPECT_EQ(soil.id[p], reference.id[p]);
    const double x = soil.position[0][p], top = x < 3.53 ? 1 : x > 6.47 ? 2.5 : 1 + (x - 3.53) * 1.5 / 2.94;
    if (top - soil.position[1][p] < 0.25) continue;
    for (std::size_t k = 0; k < 2; ++k) {
      difference[k] += std::abs(soil.stress[1 - k][p] - reference.stress[1 - k][p]);
      size[k] += std::abs(reference.stress[1 - k][p]);
    }
  }
  return {difference[0] / size[0], difference[1] / size[1]};
}

TEST(SlopeStart, AgreesByK0ByGravityAndBySeepage) {
  const std::string table = "water_table = [[0, 1], [10, 1]]\n", at_rest = "stress = \"k0-slope\"\n";  // K0 = ν/(1 − ν)
  const auto k0 = slope(table + at_rest + "k0 = 0.42857", "");
  const auto gravity = slope(table + "stress = \"gravity\"", "ramp = \"2 s\"");
  const auto seepage = slope("seepage = true\n" + at_rest + "k0 = 0.42857", "");
  const auto of_seepage = apart(seepage->state().soil, k0->state().soil);
  const auto of_gravity = apart(gravity->state().soil, k0->state().soil);
  std::printf("seepage: vertical %.4f, horizontal %.4f off K0's; gravity: %.4f, %.4f\n", of_seepage[0], of_seepage[1],
              of_gravity[0], of_gravity[1]);
  EXPECT_LT(of_seepage[0], 0.03);
  EXPECT_LT(of_seepage[1], 0.03);
  EXPECT_LT(of_gravity[0], 0.03);
  EXPECT_LT(of_gravity[1], 0.03);
  for (const auto* run : {&k0, &gravity, &seepage}) EXPECT_LT(largest_displacement((*run)->state().soil), 1e-4);
}

// The example of the guide, before its truck comes.
TEST(SlopeStart, MovesNothingWhereWaterHasPointsOfItsOwn) {
  for (const char* formulation : {"double-point", "single-point"}) {
    Simulation<PlaneStrain> run(
        read_text(fmt::format("base = \"{}/cases/examples/slope/case.toml\"\n[model]\nformulation "
                              "= \"{}\"\n",
                              POLDER_SOURCE_DIR, formulation)),
        1);
    while (run.time() < 0.1) run.advance();
    EXPECT_LT(largest_displacement(run.state().soil), 1e-4) << formulation;
  }
}

// Level ground has the stress of its columns: dry, with a water table in it, and under water, which the elements'
// outline carries by itself.
TEST(SlopeStart, OfLevelGroundIsThatOfColumns) {
  const auto stress = [](const std::string& formulation, const std::string& by, const std::string& table) {
    return Simulation<PlaneStrain>(read_text(level_sand(formulation, by, table)), 1).state().soil.stress;
  };
  for (const char* formulation : {"double-point", "single-point", "unsaturated"})
    for (const char* table : {"", "water_table = [[0, 1], [2, 1]]", "water_table = [[0, 3], [2, 3]]"}) {
      const auto columns = stress(formulation, "k0", table), elements = stress(formulation, "k0-slope", table);
      for (std::size_t s = 0; s < 3; ++s)
        for (std::size_t p = 0; p < columns[s].size(); ++p)
          ASSERT_NEAR(elements[s][p], columns[s][p], 0.01 * 0.6 * 2650 * 9.81 * 2)
              << formulation << ", " << table << ", component " << s << ", point " << p;
    }
}

}  // namespace
}  // namespace polder
