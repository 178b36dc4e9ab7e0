#include "polder/math/table.hpp"

#include <gtest/gtest.h>

TEST(Table, IsLinearBetweenItsKnotsAndConstantBeyond) {
  const polder::Table f{{0, 10, 20}, {0, 5, 1}};
  EXPECT_DOUBLE_EQ(f(-1), 0);
  EXPECT_DOUBLE_EQ(f(5), 2.5);
  EXPECT_DOUBLE_EQ(f(15), 3);
  EXPECT_DOUBLE_EQ(f(99), 1);
}
