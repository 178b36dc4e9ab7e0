// Bodies that move, and the forces on bodies, in the unsaturated formulation.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "case_text.hpp"
#include "polder/case/wall_motion.hpp"
#include "polder/stage/checkpoint.hpp"
#include "polder/stage/simulation.hpp"
#include "pushed_footing.hpp"
#include "silt.hpp"
#include "sliding_block.hpp"

namespace polder {
namespace {

using Sim = Simulation<PlaneStrain>;

constexpr double water_weight = 9810;                   // N/m³
constexpr double modulus = 2e6 * 0.7 / (1.3 * 0.4);     // Pa, M of the soft silt
constexpr double width = 0.5, height = 4, pores = 0.4;  // m, m, –

std::string soft_silt(const std::string& permeability) {
  std::string text = silt();
  text.replace(text.find("20 MPa"), 6, "2 MPa");
  text.replace(text.find("5e-4 m/s"), 8, permeability);
  return text;
}

/// A column of 4 m with a plate on it that goes down by `way`, m, in `time`, s, and stays there.
std::string column(double level, double way, double time, double duration, const std::string& permeability,
                   const std::string& more) {
  return fmt::format(R"(
[model]
formulation = "unsaturated"
size = ["0.5 m", "6 m"]
cell = "0.25 m"
{}
[initial]
water_table = [[0, {}], [0.5, {}]]
[[soil]]
material = "silt"
polygon = [[0, 0], [0.5, 0], [0.5, 4], [0, 4]]
[[wall]]
name = "plate"
box = [[0, 4], [0.5, 5]]
velocity_upward = [["0 s", "0 m/s"], ["{} s", "{} m/s"], ["{} s", "{} m/s"], ["{} s", "0 m/s"]]
[[monitor]]
name = "plate"
kind = "wall"
wall = "plate"
quantity = "force"
{}
[numerics]
step_stretch = 1000
[[stage]]
name = "rest"
duration = "20 s"
initial = true
local_damping = 0.7
until_rest = true
[[stage]]
name = "press"
duration = "{} s"
local_damping = 0.5
)",
                     soft_silt(permeability), level, level, 0.25 * time, -way / (0.75 * time), 0.75 * time,
                     -way / (0.75 * time), time, more, duration);
}

std::string drained_base(double head) {
  return fmt::format("[[seepage_boundary]]\nname = \"base\"\nline = [[0, 0], [0.5, 0]]\nhead = \"{} m\"\n", head);
}

std::unique_ptr<Sim> after(const std::string& text) {
  auto run = std::make_unique<Sim>(read_text(text), 1);
  while (!run->finished()) run->advance();
  EXPECT_LT(run->audit().water_balance_error(run->state()), 1e-12);
  EXPECT_LT(run->audit().solid_mass_error(run->state()), 1e-12);
  return run;
}

Point2 force_on_plate(const Sim& run) {
  const BodyForce& force = run.state().body_force.at(0);
  return {force.soil[0] + force.water[0], force.soil[1] + force.water[1]};
}

TEST(UnsaturatedPlate, PressesADrainedColumnByItsModulus) {
  const double way = 0.05;
  for (const double level : {4.0, 2.0}) {  // saturated, and under suction at the plate
    const auto run = after(column(level, way, 20, 30, "5e-2 m/s", drained_base(level)));
    const double wet = level == 4 ? 1 : 0.05 + 0.95 / std::sqrt(1 + std::pow(0.3 * (height - level), 2));
    // the pressure of the water at the plate has risen by what it has sunk
    const double expected = modulus * std::log(height / (height - way)) + wet * water_weight * way;
    EXPECT_NEAR(force_on_plate(*run)[1], expected * width, 0.015 * expected * width) << level;
    EXPECT_NEAR(force_on_plate(*run)[0], 0, 1e-3 * expected * width);
    EXPECT_NEAR(run->audit().displaced, way * width, 1e-3 * way * width);
    if (level == 4) {
      EXPECT_NEAR(run->audit().water_out, way * width, 2e-3 * way * width);
      const double work = 0.5 * modulus * way * way / height * width;
      EXPECT_GT(run->audit().body_work, work);  // which drives the water out, too
      EXPECT_LT(run->audit().body_work, 1.15 * work);
    }
  }
}

TEST(UnsaturatedPlate, TakesMostOfACellAndDrivesOutWhatWasThere) {
  const double way = 0.2, expected = modulus * std::log(height / (height - way));
  const auto run = after(column(4, way, 20, 30, "5e-2 m/s", drained_base(4)));
  EXPECT_NEAR(run->audit().water_out, way * width, 0.015 * way * width);
  // softer: points cross from cell to cell, and the stress of a cell is the sum over those that are in it
  EXPECT_NEAR(run->state().body_force.at(0).soil[1], expected * width, 0.12 * expected * width);
  for (std::size_t p = 0; p < run->state().soil.size(); ++p) EXPECT_LT(run->state().soil.position[1][p], height - way);
}

TEST(UnsaturatedPlate, IsCarriedByWaterThatCannotLeave) {
  const double way = 1e-4;
  const auto run = after(column(4, way, 1, 2, "5e-4 m/s", ""));
  const double stiff = run->state().setup.water.bulk_modulus / pores;
  for (const double y : {0.125, 2.125, 3.625})
    EXPECT_NEAR(run->pressure_at({0.25, y, 0}) - water_weight * (height - y), stiff * way / height,
                0.02 * stiff * way / height)
        << y;
  const double expected = (stiff + modulus) * way / height * width;
  EXPECT_NEAR(force_on_plate(*run)[1], expected, 0.02 * expected);
  EXPECT_EQ(run->audit().water_out, 0);
}

TEST(UnsaturatedPlate, LetsGoOfTheGroundThatItLeaves) {
  std::string text = column(4, 0.02, 8, 20, "5e-2 m/s", drained_base(4));
  text.replace(text.find("[\"8 s\", \"0 m/s\"]"), 16,
               R"(["8 s", "0 m/s"], ["9 s", "0.05 m/s"], ["19 s", "0.05 m/s"], ["20 s", "0 m/s"])");
  const auto run = after(text);
  EXPECT_EQ(force_on_plate(*run)[1], 0);
  double highest = 0;
  for (const double y : run->state().soil.position[1]) highest = std::max(highest, y);
  EXPECT_NEAR(highest, height - 0.0625, 2e-3);  // the upper row of points is where it was
}

TEST(UnsaturatedPlate, GoesOnBitForBitAfterResuming) {
  const Model model = read_text(column(3, 0.05, 4, 5, "5e-2 m/s", drained_base(3)));
  Sim whole(model, 1), resumed(model, 1);
  while (whole.time() < 2) whole.advance();
  restore_checkpoint(checkpoint_bytes(whole, OutputState{}, "case"), resumed, "case");
  while (!whole.finished()) whole.advance();
  while (!resumed.finished()) resumed.advance();
  EXPECT_EQ(whole.state().soil.position[1], resumed.state().soil.position[1]);
  EXPECT_EQ(whole.state().soil.water, resumed.state().soil.water);
  EXPECT_EQ(whole.state().body_force[0].soil[1], resumed.state().body_force[0].soil[1]);
}

TEST(UnsaturatedBed, BearsTheWeightOfWhatLiesOnIt) {
  for (const double top : {0.5, 0.61}) {  // on a line of the grid and between two
    const auto run = after(fmt::format(R"(
[model]
formulation = "unsaturated"
size = ["2 m", "5 m"]
cell = "0.25 m"
{}
[initial]
water_table = [[0, 2], [2, 2]]
[[soil]]
material = "silt"
polygon = [[0, 0], [2, 0], [2, 4], [0, 4]]
[[wall]]
name = "bed"
box = [[0, 0], [2, {}]]
[[monitor]]
name = "bed"
kind = "wall"
wall = "bed"
quantity = "force"
[[stage]]
name = "rest"
duration = "20 s"
initial = true
local_damping = 0.7
until_rest = true
[[stage]]
name = "event"
duration = "5 s"
local_damping = 0.7
)",
                                       silt(), top));
    double weight = 0;
    const auto& soil = run->state().soil;
    for (std::size_t p = 0; p < soil.size(); ++p) weight += 9.81 * (soil.mass[p] + 1000 * soil.water[p]);
    EXPECT_NEAR(force_on_plate(*run)[1], -weight, 0.003 * weight);
    EXPECT_NEAR(run->state().body_force[0].water[1], -2 * water_weight * (2 - top), 0.01 * weight);
  }
}

TEST(UnsaturatedFooting, IsCarriedByItsBearingCapacity) {
  // the clay's water cannot leave
  Sim run(pushed_footing("formulation = \"unsaturated\"", "poisson_ratio = 0.4\npermeability = \"1e-9 m/s\""), 1);
  const double force = mean_at_the_end(run, [](const Sim& now) { return force_on_plate(now)[1]; });
  // measured: 1.20 of it, with ten cells across the footing
  EXPECT_NEAR(force, bearing_of_clay, 0.25 * bearing_of_clay);
}

// Only what the grains press rubs: a = g (sin β − γ'/γ cos β tan φ) of a block whose water stays in it.
TEST(UnsaturatedBody, LetsASaturatedBlockSlideByItsEffectiveWeight) {
  constexpr double tilt = 16, friction = 20, degree = 3.14159265358979 / 180;
  const SlidingBlock block{fmt::format(R"(formulation = "unsaturated"
size = ["5 m", "1.25 m"]
cell = "0.125 m"
tilt = "{} deg")",
                                       tilt),
                           R"(young_modulus = "20 MPa"
grain_density = "2600 kg/m3"
permeability = "1e-10 m/s")",
                           fmt::format(R"([[retention]]
material = "block"
model = "van-genuchten"
g_a = "0.1 1/m"
g_n = 2
residual = 0
[[soil]]
material = "block"
box = [[1, 0.25], [4, 0.75]]
[[wall]]
name = "bed"
box = [[0, 0], [5, 0.25]]
friction_angle = "{} deg"
)",
                                       friction),
                           0.3,
                           "water_table = [[0, 0.75], [5, 0.75]]",
                           "hold_water = true"};
  Simulation<PlaneStrain> run(read_text(block.text()), 1);
  while (!run.finished()) run.advance();
  const auto& soil = run.state().soil;
  double speed = 0, mass = 0;
  for (std::size_t p = 0; p < soil.size(); ++p) {
    speed += soil.mass[p] * soil.velocity[0][p];
    mass += soil.mass[p];
  }
  const double share = 0.6 * 1600 / (0.6 * 2600 + 0.4 * 1000);  // γ'/γ
  const double expected =
      9.81 * (std::sin(tilt * degree) - share * std::cos(tilt * degree) * std::tan(friction * degree));
  std::printf("%.4f m/s2, expected %.4f\n", speed / mass / 0.3, expected);
  EXPECT_NEAR(speed / mass / 0.3, expected, 0.05 * expected);
}

}  // namespace
}  // namespace polder
