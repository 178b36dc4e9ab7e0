// Each bound of stage/guards.hpp is passed in a run of the engine whose state was spoilt between two steps, and the run
// says which, where and when.
#include <gtest/gtest.h>

#include <cstdio>
#include <limits>

#include "case_text.hpp"
#include "polder/stage/checkpoint.hpp"

namespace polder {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A submerged bed beside free water, with a hydrograph of the river at the left.
Model bed(const std::string& more = "") {
  return read_text(R"(
[model]
title = "A submerged bed beside free water"
size = ["1 m", "1 m"]
cell = "0.1 m"
[[material]]
name = "sand"
law = "linear-elastic"
grain_density = "2650 kg/m3"
porosity = 0.4
grain_diameter = "2 mm"
young_modulus = "1 MPa"
poisson_ratio = 0.3
[[soil]]
material = "sand"
box = [["0.5 m", "0 m"], ["1 m", "0.4 m"]]
[[free_water]]
box = [["0 m", "0 m"], ["1 m", "0.6 m"]]
[initial]
water_table = [["0 m", "0.6 m"], ["1 m", "0.6 m"]]
[[stage]]
name = "rest"
duration = "0.4 s"
)" + more);
}

/// For docs/reliability.md.
void record(const std::string& said) {
  std::printf("record: guard %s 1 0 %s\n", testing::UnitTest::GetInstance()->current_test_info()->name(), said.c_str());
}

/// Runs to the end after `spoil` has changed the state at the tenth step. The failure's message; empty: none.
template <class Spoil>
std::string failure(const Model& model, Spoil&& spoil) {
  Simulation<PlaneStrain> run(model, 1);
  try {
    for (int step = 0; !run.finished(); ++step) {
      if (step == 10) spoil(run.state());
      run.advance();
    }
  } catch (const RunFailure& error) {
    EXPECT_GT(run.time(), 0);
    EXPECT_NE(std::string(error.what()).find("t = "), std::string::npos) << error.what();
    // whatever the state is, it can be saved
    EXPECT_FALSE(checkpoint_bytes(run, OutputState{}, "case").empty());
    record(error.what());
    return error.what();
  }
  return {};
}

#define EXPECT_SAYS(message, part) EXPECT_NE((message).find(part), std::string::npos) << (message)

TEST(Guards, LetARunAtRestPass) {
  Simulation<PlaneStrain> run(bed(), 1);
  while (!run.finished()) run.advance();
  for (const std::string& warning : run.guards().warnings()) ADD_FAILURE() << warning;
  EXPECT_NEAR(run.guards().energy_now / run.guards().energy_allowed, 1, 0.01);
}

TEST(Guards, StopAtAStressThatIsNotFinite) {
  const std::string said = failure(bed(), [](auto& state) { state.soil.stress[1][7] = nan; });
  EXPECT_SAYS(said, "soil point");
  EXPECT_SAYS(said, "is not finite");
}

TEST(Guards, StopAtAVelocityThatIsNotFinite) {
  EXPECT_SAYS(failure(bed(), [](auto& state) { state.soil.velocity[0][3] = nan; }), "not");
  EXPECT_SAYS(failure(bed(), [](auto& state) { state.water.velocity[1][3] = std::numeric_limits<double>::infinity(); }),
              "not");
}

TEST(Guards, StopWhenAPointHasLeft) {
  const std::string soil = failure(bed(), [](auto& state) { state.soil.position[0][5] = 1.2, state.points_changed(); });
  EXPECT_SAYS(soil, "soil point");
  EXPECT_SAYS(soil, "has left the model");
  const std::string water =
      failure(bed(), [](auto& state) { state.water.position[1][5] = -0.01, state.points_changed(); });
  EXPECT_SAYS(water, "water point");
  EXPECT_SAYS(water, "has left the model");
}

TEST(Guards, StopWhenTheTimeStepCollapses) {
  EXPECT_SAYS(failure(bed(), [](auto& state) { state.motion.speed = 1e15; }), "the time step collapsed");
}

TEST(Guards, StopWhenThePressureSolveDoesNotConverge) {
  // water that expands under pressure: the equations have no definite matrix any more
  EXPECT_SAYS(failure(bed(), [](auto& state) { state.setup.water.bulk_modulus = -1e6; }),
              "the pressure solve did not converge");
}

TEST(Guards, StopAtAPorosityThatCannotBe) {
  EXPECT_SAYS(failure(bed(),
                      [](auto& state) {
                        state.setup.materials[0].fixed = true;
                        state.soil.porosity[2] = 1.5;
                      }),
              "its porosity is not between 0 and 1");
}

TEST(Guards, StopWhenWaterIsLost) {
  const std::string said = failure(bed(), [](auto& state) { state.water.volume[20] *= 0.99; });
  EXPECT_SAYS(said, "the balance of the water is off by");
}

TEST(Guards, StopWhenGrainsAreLost) {
  EXPECT_SAYS(failure(bed(), [](auto& state) { state.soil.mass[20] *= 1.01; }), "the mass of the grains is off by");
}

TEST(Guards, StopWhenEnergyGrowsWithoutWork) {
  const std::string said = failure(bed(), [](auto& state) {
    for (double& v : state.water.velocity[0]) v += 3;
  });
  EXPECT_SAYS(said, "energy grows without work");
  EXPECT_SAYS(said, "the fastest is water point");
}

TEST(Guards, CountTheWorkOfWaterThatEnters) {
  Model model = bed(R"(
[[boundary]]
name = "river"
region = [["0 m", "0 m"], ["0.3 m", "0 m"], ["0.3 m", "1 m"], ["0 m", "1 m"]]
water = "reservoir"
head = [["0 s", "0.6 m"], ["0.4 s", "0.9 m"]]
)");
  Simulation<PlaneStrain> run(model, 1);
  const double before = run.guards().energy_now;
  while (!run.finished()) run.advance();
  EXPECT_GT(run.guards().energy_now, before + 500);  // J/m: 90 kg/m of water came in at 0.6 m and above
}

/// The warnings after `spoil` has changed the state at step number `when`.
template <class Spoil>
std::string warnings(const Model& model, int when, Spoil&& spoil) {
  Simulation<PlaneStrain> run(model, 1);
  for (int step = 0; !run.finished(); ++step) {
    if (step == when) spoil(run.state());
    run.advance();
  }
  std::string all;
  for (const std::string& warning : run.guards().warnings()) all += warning + "\n";
  if (when >= 0) record(all.substr(0, all.find('\n')));
  return all;
}

TEST(Guards, WarnWhenPorosityIsHeldAtItsLimit) {
  const std::string said = warnings(bed(), 10, [](auto& state) {
    for (std::size_t p = 0; p < 10; ++p) state.soil.porosity[p] = least_porosity;
  });
  EXPECT_SAYS(said, "porosity");
  EXPECT_SAYS(said, "t = ");
}

TEST(Guards, WarnWhenCellsAreOverfilled) {
  // half of every second column set down in the next one
  const std::string said = warnings(bed(), 10, [](auto& state) {
    for (double& x : state.water.position[0])
      if (x < 0.4 && static_cast<int>(x / 0.05) % 4 == 1) x += 0.05;
    state.points_changed();
  });
  EXPECT_SAYS(said, "of the wet cells were overfilled");
  EXPECT_SAYS(said, "t = ");
}

TEST(Guards, WarnWhenTheFluxIsNotThatOfThePoints) {
  const Model dam_break = read_text(R"(
[model]
title = "Water that breaks out of the left half"
size = ["1 m", "1 m"]
cell = "0.05 m"
[[free_water]]
box = [["0 m", "0 m"], ["0.4 m", "0.6 m"]]
[[stage]]
name = "event"
duration = "0.4 s"
)");
  // some of the water beyond the section that no flux has brought there
  const std::string said = warnings(dam_break, 40, [](auto& state) {
    for (std::size_t p = 0; p < state.water.size(); ++p)
      if (state.water.position[0][p] < 0.1) state.water.position[0][p] += 0.6;
    state.points_changed();
  });
  EXPECT_SAYS(said, "the flux on the grid and the motion of the points differ");
  EXPECT_SAYS(said, "x = 0.5 m");
  EXPECT_NE(said, warnings(dam_break, -1, [](auto&) {}));
}

TEST(Guards, KeepTheirMemoryInACheckpoint) {
  Simulation<PlaneStrain> run(bed(), 1);
  for (int step = 0; step < 10; ++step) run.advance();
  for (std::size_t p = 0; p < 10; ++p) run.state().soil.porosity[p] = least_porosity;
  for (int step = 0; step < 10; ++step) run.advance();
  ASSERT_FALSE(run.guards().warnings().empty());
  const std::string bytes = checkpoint_bytes(run, OutputState{}, "case");
  Simulation<PlaneStrain> again(bed(), 1);
  restore_checkpoint(bytes, again, "case");
  EXPECT_EQ(again.guards().warnings(), run.guards().warnings());
}

/// Whether a checkpoint of a state that was spoilt is refused, and with which words.
template <class Spoil>
std::string refusal(Spoil&& spoil) {
  Simulation<PlaneStrain> run(bed(), 1);
  for (int step = 0; step < 10; ++step) run.advance();
  spoil(run.state());
  const std::string bytes = checkpoint_bytes(run, OutputState{}, "case");
  Simulation<PlaneStrain> again(bed(), 1);
  try {
    restore_checkpoint(bytes, again, "case");
  } catch (const CheckpointError& error) {
    return error.what();
  }
  return {};
}

TEST(Checkpoint, IsRefusedWhenItsStateCannotBe) {
  EXPECT_SAYS(refusal([](auto& state) { state.soil.position[0][5] = 7; }), "has left the model");
  EXPECT_SAYS(refusal([](auto& state) { state.water.velocity[0][5] = nan; }), "is not finite");
  EXPECT_SAYS(refusal([](auto& state) { state.soil.material[5] = 9; }), "has a material or a load");
  EXPECT_SAYS(refusal([](auto& state) { state.soil.load[5] = 1; }), "has a material or a load");
  EXPECT_SAYS(refusal([](auto& state) { state.soil.home[5] = 1 << 30; }), "is not where the point is");
  EXPECT_SAYS(refusal([](auto& state) { state.water.home[5] = -1; }), "is not where the point is");
  EXPECT_SAYS(refusal([](auto& state) {  // beyond the last tile, where counting round the axes ends at the same cell
                state.soil.home.back() += static_cast<std::int32_t>(count_homes(state.setup.lattice));
              }),
              "is not where the point is");
  EXPECT_SAYS(refusal([](auto& state) { state.soil.porosity.resize(3); }), "has another length");
  EXPECT_SAYS(refusal([](auto& state) { state.motion.speed = nan; }), "not a number");
}

}  // namespace
}  // namespace polder
