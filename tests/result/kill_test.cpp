#include "killed_run.hpp"

namespace polder {

TEST(Kill, LosesNothing) { expect_nothing_lost(5, 20261125, 0.4); }

}  // namespace polder
