// The dike for some hundred steps: the same state for any number of threads, and after a restart; nothing is lost.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "case_text.hpp"
#include "polder/case/reader.hpp"
#include "polder/stage/checkpoint.hpp"

namespace polder {
namespace {

Model dike(double end) {
  const ReadResult result = read_case(std::string(POLDER_SOURCE_DIR) + "/cases/dike-seepage/case.toml",
                                      {"stage.failure.duration=" + std::to_string(end) + " s"});
  EXPECT_TRUE(result.ok());
  return result.model;
}

/// archive(name, value or array) that condenses everything the next step depends on to one number.
struct Digest {
  std::uint64_t* sum;
  template <class T>
  void operator()(const std::string& name, T& value) const {
    std::string bytes = name;
    if constexpr (std::is_arithmetic_v<T>)
      bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    else
      bytes.append(reinterpret_cast<const char*>(value.data()), value.size() * sizeof value[0]);
    *sum = *sum * 31 + checksum(bytes.data(), bytes.size());
  }
};

template <class Space>
std::uint64_t state_of(Simulation<Space>& run) {
  std::uint64_t sum = 0;
  run.each_state(Digest{&sum});
  return sum;
}

TEST(Run, IsTheSameForAnyNumberOfThreads) {
  const Model model = dike(0.2);
  std::uint64_t alone = 0;
  for (const int threads : {1, 2, 4}) {
    Simulation<PlaneStrain> run(model, threads);
    while (!run.finished()) run.advance();
    if (threads == 1)
      alone = state_of(run);
    else
      EXPECT_EQ(state_of(run), alone) << threads << " threads";
  }
}

TEST(Run, LeavesNoSliverOfAStepAtAStagesEnd) {
  constexpr double step = 1e-3;  // s, less than the pool's own
  for (const double over : {1.0 + 1e-6, 1.1, 1.49, 1.51, 1.9}) {
    const Model pool = read_text(fmt::format(R"(
[model]
size = ["0.4 m", "0.4 m"]
cell = "0.1 m"
[[free_water]]
box = [["0 m", "0 m"], ["0.4 m", "0.2 m"]]
[[stage]]
name = "rest"
duration = {}
[numerics]
max_step = {}
)",
                                             (3 + over) * step, step));
    Simulation<PlaneStrain> run(pool, 1);
    while (!run.finished()) {
      const double dt = run.advance().dt;
      EXPECT_GT(dt, 0.499 * step) << over;
      EXPECT_LE(dt, step * (1 + 1e-12)) << over;
    }
    EXPECT_DOUBLE_EQ(run.time(), (3 + over) * step);
  }
}

TEST(Run, KeepsGrainsAndWater) {
  Simulation<PlaneStrain> run(dike(1), 1);
  while (!run.finished()) run.advance();
  EXPECT_LT(run.audit().solid_mass_error(run.state()), 1e-12);
  EXPECT_LT(run.audit().water_balance_error(run.state()), 1e-12);
  EXPECT_LT(run.audit().overfilled_most, 0.01);
  EXPECT_LT(run.audit().underfilled_most, 0.01);
}

TEST(Checkpoint, ContinuesBitForBit) {
  const Model model = dike(0.25);
  Simulation<PlaneStrain> whole(model, 1);
  std::string half;
  for (int step = 0; !whole.finished(); ++step) {
    if (step == 333) half = checkpoint_bytes(whole, OutputState{7, 8, 9, 10, 11.5, 12.5}, "case");
    whole.advance();
  }
  ASSERT_FALSE(half.empty());
  Simulation<PlaneStrain> resumed(model, 2);
  const OutputState output = restore_checkpoint(half, resumed, "case");
  EXPECT_EQ(output.history_rows, 7u);
  EXPECT_EQ(output.wall_seconds, 11.5);
  while (!resumed.finished()) resumed.advance();
  EXPECT_EQ(state_of(resumed), state_of(whole));
}

TEST(Checkpoint, IsRefusedWhenDamagedCutOffOrOfAnotherCase) {
  const Model model = dike(0.2);
  Simulation<PlaneStrain> run(model, 1);
  const std::string good = checkpoint_bytes(run, OutputState{}, "case");
  std::string flipped = good;
  flipped[good.size() / 2] ^= 4;
  Simulation<PlaneStrain> other(model, 1);
  EXPECT_THROW(restore_checkpoint(flipped, other, "case"), CheckpointError);
  EXPECT_THROW(restore_checkpoint(good.substr(0, good.size() - 100), other, "case"), CheckpointError);
  EXPECT_THROW(restore_checkpoint("", other, "case"), CheckpointError);
  EXPECT_THROW(restore_checkpoint(good, other, "another case"), CheckpointError);
}

TEST(Reservoir, HoldsItsLevelAndIsAudited) {
  const ReadResult read =
      read_case(std::string(POLDER_SOURCE_DIR) + "/cases/dike-constant-head/case.toml", {"stage.failure.duration=4 s"});
  ASSERT_TRUE(read.ok());
  Simulation<PlaneStrain> run(read.model, 1);
  while (!run.finished()) {
    run.advance();
    if (run.time() <= 0) continue;
    double stored = 0;
    const auto& lattice = run.state().setup.lattice;
    for (const auto& cell : run.state().setup.reservoirs[0].cells)
      stored += run.state().grid.water_volume[lattice.index(cell[0], cell[1])];
    ASSERT_NEAR(stored / 2, 0.8, 0.002) << "t = " << run.time();
  }
  EXPECT_GT(run.audit().water_in, 0.01);
  EXPECT_LT(run.audit().water_balance_error(run.state()), 1e-12);
}

}  // namespace
}  // namespace polder
