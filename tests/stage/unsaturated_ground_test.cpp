// Walls, bodies, loads and changes of the ground in the unsaturated formulation.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "case_text.hpp"
#include "largest_displacement.hpp"
#include "polder/stage/checkpoint.hpp"
#include "polder/stage/simulation.hpp"
#include "silt.hpp"
#include "wall_in_silt.hpp"

namespace polder {
namespace {

constexpr double water_weight = 9810;                              // N/m³
constexpr double dry_weight = 0.6 * 2650 * 9.81, pores = 0.4;      // N/m³ of bulk; –
constexpr double full_weight = dry_weight + pores * water_weight;  // N/m³

/// A model of so many metres with cells of 0.25 m, what is in it, and its stages.
std::string model_of(double width, double height, const std::string& content, const std::string& stages) {
  return fmt::format(R"(
[model]
formulation = "unsaturated"
size = [{}, {}]
cell = "0.25 m"
[numerics]
step_stretch = 1000
{}
{}
)",
                     width, height, content, stages);
}

const std::string until_rest = R"(
[[stage]]
name = "rest"
duration = "60 s"
initial = true
local_damping = 0.7
until_rest = true
)";

std::string event(const std::string& duration, const std::string& name = "event") {
  return fmt::format("[[stage]]\nname = \"{}\"\nduration = \"{}\"\nlocal_damping = 0.8\n", name, duration);
}

std::unique_ptr<Simulation<PlaneStrain>> after(const std::string& text) {
  auto run = std::make_unique<Simulation<PlaneStrain>>(read_text(text), 1);
  while (!run->finished()) run->advance();
  EXPECT_LT(run->audit().water_balance_error(run->state()), 1e-12);
  EXPECT_LT(run->audit().solid_mass_error(run->state()), 1e-12);
  return run;
}

/// Mean effective vertical stress of the soil points between two heights, and their mean height.
std::array<double, 2> vertical_stress(const Stepper<PlaneStrain>& state, double low, double high, double left = 0,
                                      double right = 1e9) {
  double sum = 0, height = 0;
  int count = 0;
  for (std::size_t p = 0; p < state.soil.size(); ++p) {
    const double x = state.soil.position[0][p], y = state.soil.position[1][p];
    if (y < low || y > high || x < left || x > right) continue;
    sum += state.soil.stress[1][p];
    height += y;
    ++count;
  }
  return {sum / count, height / count};
}

TEST(UnsaturatedStage, EndsWhenTheGroundIsAtRest) {
  const auto run = after(model_of(1, 5, silt() + R"([initial]
stress = "gravity"
water_table = [[0, 1], [1, 1]]
[[soil]]
material = "silt"
polygon = [[0, 0], [1, 0], [1, 4], [0, 4]]
)",
                                  until_rest + event("2 s")));
  EXPECT_LT(run->stage_ends()[0].seconds, 30);
  EXPECT_EQ(run->stage_ends()[0].restless, 0);
  const auto [stress, y] = vertical_stress(run->state(), 0, 0.25);
  const double p = run->pressure_at({0.5, y, 0});
  double above = 0;  // by what the points hold
  for (std::size_t i = 0; i < run->state().soil.size(); ++i)
    if (run->state().soil.position[1][i] > y)
      above += 9.81 * (run->state().soil.mass[i] + 1000 * run->state().soil.water[i]);
  EXPECT_NEAR(stress, -above + p, 0.02 * above);
  EXPECT_LT(largest_displacement(run->state().soil), 1e-4);
}

TEST(UnsaturatedThinWall, KeepsWaterOfDifferentLevelsApart) {
  const auto run = after(model_of(4, 6, silt() + R"([initial]
water_table = [[0, 4], [2, 4], [2.001, 1.5], [4, 1.5]]
[[soil]]
material = "silt"
polygon = [[0, 0], [4, 0], [4, 4], [0, 4]]
[[wall]]
line = [[2, 5], [2, 0]]
)",
                                  until_rest + event("100 s")));
  double worst = 0;
  for (const double x : {0.125, 1.0, 1.9, 2.1, 3.0, 3.875})
    for (const double y : {0.125, 1.125, 2.125, 3.125})
      worst = std::max(worst, std::abs(run->pressure_at({x, y, 0}) - water_weight * ((x < 2 ? 4 : 1.5) - y)));
  EXPECT_LT(worst, 1e-3 * water_weight * 4);
  for (std::size_t p = 0; p < run->state().soil.size(); ++p)
    ASSERT_EQ(run->state().soil.position[0][p] < 2, run->state().soil.reference[0][p] < 2);
  EXPECT_LT(largest_displacement(run->state().soil), 1e-4);
}

TEST(UnsaturatedThinWall, LetsWaterPassUnderItsToe) {
  // half way down a layer: q = k H / 2 between banks that go on for ever
  Simulation<PlaneStrain> run(wall_in_silt("cell = \"0.1 m\"\n"), 1);
  EXPECT_NEAR(discharge_at_the_end(run), 0.5, 0.02);
}

std::string column(const std::string& more, const std::string& stages) {
  return model_of(0.5, 6, silt() + R"([initial]
water_table = [[0, 1], [0.5, 1]]
[[soil]]
material = "silt"
polygon = [[0, 0], [0.5, 0], [0.5, 4], [0, 4]]
[[seepage_boundary]]
name = "edge"
line = [[0, 0], [0.5, 0]]
head = "1 m"
)" + more,
                  stages);
}

/// What a metre of width of the column carries at the height, kPa: −σ' − the weight above + p, which a load adds to.
double carried(const Simulation<PlaneStrain>& run, double low, double high) {
  const auto [stress, y] = vertical_stress(run.state(), low, high);
  const auto& soil = run.state().soil;
  double above = 0;
  for (std::size_t i = 0; i < soil.size(); ++i)
    if (soil.position[1][i] > y) above += 9.81 * (soil.mass[i] + 1000 * soil.water[i]) / 0.5;
  const double p = run.pressure_at({0.25, y, 0});
  const double s = p >= 0 ? 1 : 0.05 + 0.95 / std::sqrt(1 + std::pow(0.3 * -p / water_weight, 2));
  return -stress + s * p - above;
}

TEST(UnsaturatedLoad, IsCarriedByTheGrainsOnceTheWaterHasLeft) {
  const auto run = after(column("[[load]]\nspan = [0, 0.5]\npressure = [[\"0 s\", \"0 kPa\"], [\"5 s\", \"50 kPa\"]]\n",
                                until_rest + event("200 s")));
  const double below = carried(*run, 0, 0.25), middle = carried(*run, 2, 2.25);
  std::printf("load: %.1f below, %.1f in the middle; p %.1f\n", below, middle, run->pressure_at({0.25, 0.125, 0}));
  EXPECT_NEAR(run->pressure_at({0.25, 0.125, 0}), 0.875 * water_weight, 100);
  EXPECT_NEAR(below, 50e3, 0.01 * 50e3);
  EXPECT_NEAR(middle, 50e3, 0.01 * 50e3);
}

TEST(UnsaturatedLoad, IsCarriedByTheWaterAtFirst) {
  const auto run = after(model_of(0.5, 6, silt() + R"([initial]
water_table = [[0, 4], [0.5, 4]]
[[soil]]
material = "silt"
polygon = [[0, 0], [0.5, 0], [0.5, 4], [0, 4]]
[[seepage_boundary]]
name = "edge"
line = [[0, 4], [0.5, 4]]
condition = "closed"
[[load]]
span = [0, 0.5]
pressure = [["0 s", "0 kPa"], ["1 s", "50 kPa"]]
)",
                                  until_rest + event("5 s")));
  const double excess = run->pressure_at({0.25, 1.125, 0}) - water_weight * (4 - 1.125);
  EXPECT_NEAR(excess, 50e3, 0.02 * 50e3);
}

TEST(UnsaturatedGround, IsExcavatedAndPlacedWithItsWater) {
  const auto dug = after(column(R"([[change]]
stage = "dig"
action = "excavate"
box = [[0, 3], [0.5, 4]]
)",
                                until_rest + event("20 s", "before") + event("100 s", "dig")));
  EXPECT_NEAR(carried(*dug, 0, 0.25), 0, 0.01 * 3 * full_weight);
  EXPECT_NEAR(dug->audit().solid_out, 0.5 * 1 * 0.6 * 2650, 1e-9);
  EXPECT_GT(dug->audit().water_out, 0.5 * 0.4 * 0.5);
  double highest = 0;
  for (const double y : dug->state().soil.position[1]) highest = std::max(highest, y);
  EXPECT_NEAR(highest, 3 - 0.0625, 4e-3);

  const auto raised = after(column(R"([[change]]
stage = "raise"
action = "place"
material = "silt"
box = [[0, 4], [0.5, 5]]
)",
                                   until_rest + event("20 s", "before") + event("200 s", "raise")));
  EXPECT_NEAR(raised->audit().solid_in, 0.5 * 1 * 0.6 * 2650, 1e-9);
  EXPECT_NEAR(carried(*raised, 0, 0.25), 0, 0.02 * 5 * full_weight);
  EXPECT_NEAR(carried(*raised, 2, 2.25), 0, 0.02 * 5 * full_weight);
}

TEST(UnsaturatedGround, BecomesAnotherMaterialUnderTheSameSuction) {
  const std::string grout = R"(
[[material]]
name = "grout"
law = "linear-elastic"
grain_density = "2650 kg/m3"
porosity = 0.4
permeability = "5e-4 m/s"
permeability_exponent = 0
young_modulus = "50 MPa"
poisson_ratio = 0.3
[[retention]]
material = "grout"
model = "van-genuchten"
g_a = "0.1 1/m"
g_n = 2
residual = 0.05
[[change]]
stage = "inject"
action = "convert"
material = "grout"
box = [[0, 2], [0.5, 3]]
)";
  const auto run = after(column(grout, until_rest + event("2 s", "before") + event("1 s", "inject")));
  double worst = 0;
  for (double y = 0.125; y < 4; y += 0.25)
    worst = std::max(worst, std::abs(run->pressure_at({0.25, y, 0}) - water_weight * (1 - y)));
  EXPECT_LT(worst, 0.01 * water_weight * 3);
  EXPECT_GT(run->audit().water_in, 0.01);
}

TEST(UnsaturatedGround, GoesOnAfterResuming) {
  const Model model = read_text(column(R"([[change]]
stage = "dig"
action = "excavate"
box = [[0, 3], [0.5, 4]]
[[load]]
span = [0, 0.5]
pressure = "5 kPa"
from_stage = "dig"
[[wall]]
line = [[0.25, 6], [0.25, 2]]
friction_angle = "20 deg"
)",
                                       until_rest + event("1 s", "before") + event("2 s", "dig")));
  Simulation<PlaneStrain> whole(model, 1), resumed(model, 1);
  while (whole.time() < 1.5) whole.advance();
  restore_checkpoint(checkpoint_bytes(whole, OutputState{}, "case"), resumed, "case");
  while (!whole.finished()) whole.advance();
  while (!resumed.finished()) resumed.advance();
  EXPECT_EQ(whole.state().soil.stress[1], resumed.state().soil.stress[1]);
  EXPECT_EQ(whole.state().soil.water, resumed.state().soil.water);
}

TEST(UnsaturatedBody, CarriesALevelBedThatTheGridDoesNotFollow) {
  for (const double bed : {0.5, 0.625, 0.7}) {
    const auto run = after(model_of(1, 6,
                                    silt() + fmt::format(R"([initial]
water_table = [[0, 3], [1, 3]]
[[soil]]
material = "silt"
polygon = [[0, 0], [1, 0], [1, 4], [0, 4]]
[[wall]]
box = [[0, 0], [1, {}]]
soil = "rough"
)",
                                                         bed),
                                    until_rest + event("20 s")));
    const auto [stress, y] = vertical_stress(run->state(), 1.25, 1.5);
    double above = 0;
    for (std::size_t i = 0; i < run->state().soil.size(); ++i)
      if (run->state().soil.position[1][i] > y)
        above += 9.81 * (run->state().soil.mass[i] + 1000 * run->state().soil.water[i]);
    const double p = run->pressure_at({0.5, y, 0});
    EXPECT_NEAR(stress, -above + p, 0.03 * (above - p));
    EXPECT_NEAR(p, water_weight * (3 - y), 4e-3 * water_weight * 3);
    EXPECT_LT(largest_displacement(run->state().soil), 1e-4);
  }
}

TEST(UnsaturatedBody, HoldsSoilOnASlopeAtRest) {
  for (const char* surface : {"soil = \"rough\"", "friction_angle = \"35 deg\""}) {
    const auto run = after(model_of(8, 5,
                                    silt() + fmt::format(R"([initial]
water_table = [[0, 2.5], [8, 2.5]]
[[soil]]
material = "silt"
polygon = [[0, 0], [8, 0], [8, 4], [0, 4]]
[[wall]]
polygon = [[2, 0], [8, 0], [8, 3]]
{}
)",
                                                         surface),
                                    until_rest + event("50 s")));
    double worst = 0;  // against still water, whose level rises as the ground settles under its weight
    const double head = run->pressure_at({0.625, 0.125, 0}) + water_weight * 0.125;
    for (const double x : {1.1, 3.1, 4.6, 5.6})
      for (const double y : {1.9, 2.1, 2.4})
        worst = std::max(worst, std::abs(run->pressure_at({x, y, 0}) - (head - water_weight * y)));
    EXPECT_EQ(run->stage_ends()[0].restless, 0);
    EXPECT_LT(worst, 2e-3 * water_weight * 2.5);
    EXPECT_LT(largest_displacement(run->state().soil), 1e-3);
    for (std::size_t p = 0; p < run->state().soil.size(); ++p)
      ASSERT_GE(run->state()
                    .setup.bodies.contact({run->state().soil.position[0][p], run->state().soil.position[1][p]})
                    .distance,
                0);
  }
}

}  // namespace
}  // namespace polder
