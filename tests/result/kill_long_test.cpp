#include "killed_run.hpp"

namespace polder {

TEST(Kill, FiftyTimesLosesNothing) { expect_nothing_lost(50, 4711, 1.5); }

}  // namespace polder
