// 300 random models: none crashes, loses mass or moves without cause. POLDER_SEED starts elsewhere.
#include <cstdio>
#include <cstdlib>

#include "random_models.hpp"

namespace polder {
namespace {

TEST(RandomModels, ThreeHundredRunWithoutLoss) {
  const char* given = std::getenv("POLDER_SEED");
  const std::uint64_t first = given ? std::strtoull(given, nullptr, 10) : 1;
  const char* many = std::getenv("POLDER_MODELS");
  const std::uint64_t count = many ? std::strtoull(many, nullptr, 10) : 300;
  std::uint64_t finished = 0, warned = 0;
  double moved = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const RandomEnding ending = try_random(seed);
    finished += ending.finished;
    warned += ending.warned;
    moved = std::max(moved, ending.moved);
    if (std::getenv("POLDER_SHOW"))
      std::printf("%llu %d %g\n", static_cast<unsigned long long>(seed), ending.warned, ending.moved);
    EXPECT_TRUE(ending.finished) << "model " << seed << ": " << ending.reason;
  }
  std::printf(
      "random models from %llu: %llu of %llu without a guard's stop, %llu warned of their flux; at rest, none moved by "
      "more than %.1e of a cell\n",
      static_cast<unsigned long long>(first), static_cast<unsigned long long>(finished),
      static_cast<unsigned long long>(count), static_cast<unsigned long long>(warned), moved);
}

}  // namespace
}  // namespace polder
