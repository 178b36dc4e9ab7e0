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
  const testing::TestResult& result = *testing::UnitTest::GetInstance()->current_test_info()->result();
  std::uint64_t failed = 0, warned = 0;
  double moved = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const int before = result.total_part_count();
    const RandomEnding ending = try_random(seed, seed % 2 == 0 ? Unsaturated::under_water : Unsaturated::plain);
    EXPECT_TRUE(ending.finished) << "model " << seed << ": " << ending.reason;
    failed += result.total_part_count() > before;
    warned += ending.warned;
    moved = std::max(moved, ending.moved);
  }
  const auto whole = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  std::printf(
      "record: models random-from-%llu %llu %llu %llu warned of their flux; at rest, none moved by more than %.1e of a "
      "cell\n",
      whole(first), whole(count), whole(failed), whole(warned), moved);
}

}  // namespace
}  // namespace polder
