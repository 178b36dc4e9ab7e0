// The problems of `polder verify` that take longer.
#include "support.hpp"

namespace polder::verify {
namespace {

TEST_P(VerificationProblem, IsWithinItsTolerances) {
  const Outcome outcome = run_problem(*find_problem(GetParam()), {{}, false});
  EXPECT_TRUE(outcome.pass()) << table_of(outcome);
}
INSTANTIATE_TEST_SUITE_P(Long, VerificationProblem, testing::ValuesIn(names(false)), test_name);

}  // namespace
}  // namespace polder::verify
