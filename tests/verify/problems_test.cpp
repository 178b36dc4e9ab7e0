// The problems of `polder verify --quick`, and that errors put into them on purpose are caught.
#include "support.hpp"

namespace polder::verify {
namespace {

TEST_P(VerificationProblem, IsWithinItsTolerances) {
  const Outcome outcome = run_problem(*find_problem(GetParam()), {{}, false});
  EXPECT_TRUE(outcome.pass()) << table_of(outcome);
}
INSTANTIATE_TEST_SUITE_P(Quick, VerificationProblem, testing::ValuesIn(names(true)), test_name);

TEST(Verification, NamesEachProblemOnce) {
  for (const Problem& problem : problems()) EXPECT_EQ(find_problem(problem.name), &problem);
  EXPECT_EQ(find_problem("no-such-problem"), nullptr);
}

struct Sabotage {
  const char* problem;
  std::vector<std::string> overrides;
};

class Sabotaged : public testing::TestWithParam<Sabotage> {};

TEST_P(Sabotaged, ProblemFallsShort) {
  const Outcome outcome = run_problem(*find_problem(GetParam().problem), {GetParam().overrides, false});
  EXPECT_FALSE(outcome.pass()) << table_of(outcome);
}
INSTANTIATE_TEST_SUITE_P(
    Verification, Sabotaged,
    testing::Values(Sabotage{"hydrostatic", {"model.gravity=10.3005 m/s2"}},  // the pressure gradient × 1.05
                    Sabotage{"ergun-column", {"material.sand.ergun_a=157.5", "material.sand.ergun_b=1.8375"}},  // drag
                    Sabotage{"terzaghi", {"material.soil.permeability=1.05e-3 m/s"}},
                    Sabotage{"triaxial-drained", {"material.sand.friction_angle=38 deg"}}));

}  // namespace
}  // namespace polder::verify
