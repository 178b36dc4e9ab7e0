// A sample of the random models; ./test --all runs 300.
#include "random_models.hpp"

namespace polder {
namespace {

TEST(RandomModels, ASampleRunsWithoutLoss) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const RandomEnding ending = try_random(seed);
    EXPECT_TRUE(ending.finished) << "model " << seed << ": " << ending.reason;
  }
}

void expect_unsaturated_ones_run(Unsaturated kind) {
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    if (!ModelGenerator(seed).make().unsaturated) continue;
    const RandomEnding ending = try_random(seed, kind);
    EXPECT_TRUE(ending.finished) << "model " << seed << ": " << ending.reason;
    ++count;
  }
  EXPECT_GT(count, 8);
}

TEST(RandomModels, UnsaturatedOnesWithFinerCellsRunWithoutLoss) { expect_unsaturated_ones_run(Unsaturated::finer); }

TEST(RandomModels, UnsaturatedOnesUnderWaterRunWithoutLoss) { expect_unsaturated_ones_run(Unsaturated::under_water); }

// Unsaturated ones whose pressures were not found once: 207 by a step of Newton that went round in a circle, the others
// by the sliver of a step that was left at the end of a stage.
TEST(RandomModels, ThoseThatFailedOnceRun) {
  for (const std::uint64_t seed : {207, 851, 1128, 1134}) {
    const RandomEnding ending = try_random(seed);
    EXPECT_TRUE(ending.finished) << "model " << seed << ": " << ending.reason;
  }
}

}  // namespace
}  // namespace polder
