// Stages that end when the ground has come to rest.
#include "polder/stage/rest.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "case_text.hpp"
#include "polder/stage/checkpoint.hpp"

namespace polder {
namespace {

/// A column of soil that takes up its weight from nothing.
std::string column(const std::string& stages) {
  return R"(
[model]
size = ["0.4 m", "2 m"]
cell = "0.1 m"
[[material]]
name = "sand"
law = "linear-elastic"
grain_density = "2650 kg/m3"
porosity = 0.4
young_modulus = "10 MPa"
poisson_ratio = 0.3
permeability = "1e-3 m/s"
[[soil]]
material = "sand"
box = [["0 m", "0 m"], ["0.4 m", "1.5 m"]]
[initial]
stress = "none"
)" + stages;
}

const std::string settling = R"(
[[stage]]
name = "gravity"
initial = true
ramp = "0.05 s"
local_damping = 0.7
until_rest = true
duration = "5 s"
[[stage]]
name = "event"
duration = "0.02 s"
)";

TEST(StageUntilRest, EndsWithTheStressOfTheWeight) {
  const Model model = read_text(column(settling));
  Simulation<PlaneStrain> run(model, 1);
  Unrest last;
  while (run.stage()->initial) {
    const StepReport report = run.advance();
    last = unrest(run.state(), report.dt);
  }
  EXPECT_LE(last.energy, 1e-8);
  EXPECT_LE(last.force, 0.01);
  ASSERT_EQ(run.stage_ends().size(), 1U);
  EXPECT_GT(run.stage_ends()[0].seconds, 0.05);
  EXPECT_LT(run.stage_ends()[0].seconds, 1);
  EXPECT_EQ(run.stage_ends()[0].restless, 0);
  EXPECT_EQ(run.time(), 0);
  const auto& soil = run.state().soil;
  const double weight = 9.81 * 2650 * 0.6;
  for (std::size_t p = 0; p < soil.size(); ++p) {
    const double depth = 1.5 - soil.position[1][p];
    if (depth > 0.2) {
      EXPECT_NEAR(soil.stress[1][p], -weight * depth, 0.02 * weight * 1.5) << "depth " << depth;
    }
  }
}

TEST(StageUntilRest, SaysSoWhenItsTimeDoesNotDo) {
  std::string text = settling;
  text.replace(text.find("\"5 s\""), 5, "\"0.06 s\"");
  text.replace(text.find("local_damping = 0.7"), 19, "local_damping = 0.0");
  Simulation<PlaneStrain> run(read_text(column(text)), 1);
  while (!run.finished()) run.advance();
  ASSERT_EQ(run.stage_ends().size(), 2U);
  EXPECT_NEAR(run.stage_ends()[0].seconds, 0.06, 1e-12);
  EXPECT_GT(run.stage_ends()[0].restless, 0.01);
  EXPECT_EQ(run.stage_ends()[1].restless, 0);
}

TEST(StageUntilRest, EndsAtTheSameStepAfterResuming) {
  const Model model = read_text(column(settling));
  Simulation<PlaneStrain> whole(model, 1), first(model, 1), second(model, 1);
  while (!whole.finished()) whole.advance();
  const double half = whole.stage_ends()[0].seconds;
  const std::uint64_t all = whole.state().step;
  while (first.stage()->initial && first.state().step < all / 2) first.advance();
  ASSERT_GT(half, 0);
  restore_checkpoint(checkpoint_bytes(first, OutputState{}, "case"), second, "case");
  while (!second.finished()) second.advance();
  EXPECT_EQ(second.state().step, all);
  EXPECT_EQ(second.stage_ends()[0].seconds, half);
  EXPECT_EQ(second.state().soil.position[1], whole.state().soil.position[1]);
}

TEST(Unrest, IsTheWeightWhereNothingHoldsTheGround) {
  std::string text = settling;
  text.replace(text.find("ramp = \"0.05 s\""), 15, "ramp = \"0 s\"   ");
  text.replace(text.find("local_damping = 0.7"), 19, "local_damping = 0.0");
  Simulation<PlaneStrain> run(read_text(column(text)), 1);
  const StepReport report = run.advance();
  const Unrest now = unrest(run.state(), report.dt);
  // all faces but those on the base fall freely
  EXPECT_NEAR(now.force, 1, 0.05);
  EXPECT_NEAR(now.energy, 0.5 * 9.81 * report.dt * report.dt / 0.1, 0.06 * 0.5 * 9.81 * report.dt * report.dt / 0.1);
}

}  // namespace
}  // namespace polder
