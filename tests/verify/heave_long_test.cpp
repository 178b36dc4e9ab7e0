// Hydraulic heave at a sheet pile in level ground (cases/excavation-onset): it begins between Terzaghi's difference of
// head and that at which the exit gradient is critical, each ± 8 %.
#include <gtest/gtest.h>

#include "polder/verify/validation.hpp"

namespace polder::validate {
namespace {

TEST(Heave, BeginsBetweenTerzaghiAndTheExitGradient) {
  const Result result = run_validation(*find_validation("excavation-onset"), {}, 1);
  EXPECT_TRUE(result.trouble.empty()) << result.trouble;
  ASSERT_FALSE(result.rows.empty());
  EXPECT_EQ(result.rows.front().verdict, Verdict::within) << *result.rows.front().computed << " m";
  for (const Row& row : result.rows) EXPECT_NE(row.verdict, Verdict::outside) << row.quantity;
}

}  // namespace
}  // namespace polder::validate
