#include "polder/case/grid_axis.hpp"

#include <gtest/gtest.h>

#include <random>

#include "polder/case/grid_sites.hpp"

namespace polder {
namespace {

void check_axis(const GridAxis& axis, double largest, double growth) {
  const int n = axis.cells();
  EXPECT_EQ(axis.edge(0), 0);
  EXPECT_EQ(axis.edge(n), axis.length());
  for (int i = 0; i < n; ++i) {
    EXPECT_GT(axis.width(i), 0);
    EXPECT_LE(axis.width(i), largest * 1.05);
    EXPECT_GT(axis.knot(i), axis.edge(i));
    EXPECT_LT(axis.knot(i), axis.edge(i + 1));
    EXPECT_NEAR(axis.edge(i + 1), 0.5 * (axis.knot(i) + axis.knot(i + 1)), 1e-12 * axis.length());
    if (i > 0) {
      EXPECT_LT(std::max(axis.width(i), axis.width(i - 1)) / std::min(axis.width(i), axis.width(i - 1)),
                1 + 1.1 * (growth - 1))
          << i;
    }
  }
  for (int i = 1; i < 3; ++i) {  // what lies beyond the ends mirrors what is inside
    EXPECT_NEAR(axis.edge(-i), -axis.edge(i), 1e-15);
    EXPECT_NEAR(axis.edge(n + i) - axis.length(), axis.length() - axis.edge(n - i), 1e-12 * axis.length());
  }
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 10000; ++trial) {
    const double x = axis.length() * uniform(random), place = axis.place(x);
    const int i = static_cast<int>(place);
    EXPECT_LE(axis.edge(i), x + 1e-12);
    EXPECT_GE(axis.edge(i + 1), x - 1e-12);
    EXPECT_NEAR(axis.at_place(place), x, 1e-12 * axis.length());
    const int nearest = axis.nearest_edge(x);
    for (const int other : {nearest - 1, nearest + 1})
      EXPECT_LE(std::abs(axis.edge(nearest) - x), std::abs(axis.edge(other) - x) + 1e-12);
  }
  EXPECT_EQ(axis.cell_at(-1), 0);
  EXPECT_EQ(axis.cell_at(axis.length() + 1), n - 1);
}

TEST(GridAxis, GrowsAwayFromAFineRangeWhoseEndsAreEdges) {
  const GridAxis axis(2, 0.05, {{0.998, 1.002, 0.001, 1.15}});
  check_axis(axis, 0.05, 1.15);
  EXPECT_NEAR(axis.least(), 0.001, 1e-12);
  EXPECT_LT(axis.cells(), 120);  // of 2000 equal ones
  const int from = axis.nearest_edge(0.998);
  EXPECT_EQ(axis.edge(from), 0.998);
  EXPECT_NEAR(axis.edge(from + 4), 1.002, 1e-15);
}

TEST(GridAxis, HoldsFineRangesAtItsEndsAndSeveralOfThem) {
  check_axis(GridAxis(1, 0.1, {{0, 0.1, 0.01, 1.2}}), 0.1, 1.2);
  check_axis(GridAxis(1, 0.1, {{0.9, 1, 0.01, 1.2}}), 0.1, 1.2);
  check_axis(GridAxis(3, 0.1, {{0, 0.1, 0.02, 1.1}, {1.3, 1.6, 0.01, 1.1}, {2.9, 3, 0.05, 1.1}}), 0.1, 1.1);
}

TEST(GridAxis, ThatIsNotRefinedHasEqualCells) {
  const GridAxis axis(2, 0.05, {});
  EXPECT_FALSE(axis.graded());
  EXPECT_EQ(axis.cells(), 40);
  EXPECT_EQ(axis.edge(7), 7 * 0.05);
  EXPECT_EQ(axis.place(0.33), 0.33 / 0.05);
  EXPECT_EQ(axis.nearest_edge(0.33), 7);
}

TEST(SiteAxis, CutsEachCellIntoEqualParts) {
  for (const GridAxis& axis : {GridAxis(40, 0.05), GridAxis(2, 0.05, {{0.998, 1.002, 0.001, 1.15}})}) {
    const SiteAxis sites(axis, 2);
    for (int s = 0; s < sites.count(); ++s) {
      EXPECT_NEAR(sites.width(s), 0.5 * axis.width(sites.cell(s)), 1e-15);
      EXPECT_EQ(sites.site_at(sites.middle(s)), s);
      EXPECT_NEAR(sites.low(s + 1) - sites.low(s), sites.width(s), 1e-12);
    }
  }
}

}  // namespace
}  // namespace polder
