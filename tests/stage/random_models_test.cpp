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

}  // namespace
}  // namespace polder
