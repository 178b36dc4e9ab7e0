// Work is cut into parts that cover everything once, whatever it weighs and however many threads there are.
#include "polder/math/threads.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <vector>

namespace polder {
namespace {

using Weights = std::vector<std::ptrdiff_t>;

Weights parts_of(const Weights& weights, int parts) {
  Weights sums;
  std::ptrdiff_t next = 0;
  cut_in_parts(
      static_cast<std::ptrdiff_t>(weights.size()), parts, [&](std::ptrdiff_t i) { return weights[i]; },
      [&](int part, std::ptrdiff_t begin, std::ptrdiff_t end) {
        EXPECT_EQ(part, static_cast<int>(sums.size()));
        EXPECT_EQ(begin, next);
        next = end;
        sums.push_back(std::accumulate(weights.begin() + begin, weights.begin() + end, std::ptrdiff_t{0}));
      });
  EXPECT_EQ(next, static_cast<std::ptrdiff_t>(weights.size()));
  EXPECT_EQ(sums.size(), static_cast<std::size_t>(parts));
  return sums;
}

TEST(PartsByWeight, AreOffTheirShareByHalfAnItemAtMost) {
  for (const Weights& weights :
       {Weights{1, 1, 1, 1}, {5, 1, 1, 1, 1, 1}, {1, 1, 1, 1, 1, 5}, {3, 0, 0, 7, 2, 2, 0, 4}, {9}, {0, 0, 0}, {}})
    for (const int parts : {1, 2, 3, 7}) {
      const auto total = std::accumulate(weights.begin(), weights.end(), std::ptrdiff_t{0});
      const auto largest = weights.empty() ? 0 : *std::max_element(weights.begin(), weights.end());
      std::ptrdiff_t passed = 0;
      int part = 0;
      for (const std::ptrdiff_t sum : parts_of(weights, parts)) {
        passed += sum;
        ++part;
        EXPECT_LE(2 * std::abs(parts * passed - part * total), parts * largest) << parts << " parts, end of " << part;
      }
    }
}

TEST(Team, EachDoesEveryItemOnceWhateverItsWeight) {
  for (const int threads : {1, 2, 3, 4}) {
    Team team(threads);
    for (const std::ptrdiff_t count : {0, 1, 2, 5, 1000}) {
      std::vector<int> done(static_cast<std::size_t>(count), 0);
      team.each(
          count, [&](std::ptrdiff_t i) { ++done[i]; }, [](std::ptrdiff_t i) { return i % 7 * 100; });
      EXPECT_EQ(done, std::vector<int>(static_cast<std::size_t>(count), 1)) << threads << " threads";
    }
  }
}

}  // namespace
}  // namespace polder
