#include "polder/case/geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace polder {
namespace {

using Polygon = std::vector<Point2>;

const Polygon dike{{2, 0}, {2, 1}, {2.14, 1}, {4.1, 0}};
const Polygon unit{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

TEST(Area, IsPositiveCounterClockwise) {
  EXPECT_NEAR(area(dike), 0.5 * (0.14 + 2.1), 1e-15);
  EXPECT_LT(signed_area(dike), 0);
  EXPECT_EQ(signed_area(unit), 1);
}

TEST(Contains, GivesEveryPointOfSharedEdgesToExactlyOnePolygon) {
  // A square cut into four by lines through an inner corner; edges level, upright and inclined.
  const Polygon parts[] = {{{0, 0}, {4, 0}, {1.7, 2.1}},
                           {{4, 0}, {4, 4}, {1.7, 2.1}},
                           {{4, 4}, {0, 4}, {1.7, 2.1}},
                           {{0, 4}, {0, 0}, {1.7, 2.1}}};
  const auto owners = [&](Point2 p) {
    int count = 0;
    for (const Polygon& part : parts) count += contains(part, p);
    return count;
  };
  const unsigned seed = 20240707;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> inside(0, 4), along(0, 1);
  for (int i = 0; i < 20000; ++i) {
    const Point2 p{inside(random), inside(random)};
    EXPECT_EQ(owners(p), 1) << p[0] << " " << p[1] << ", seed " << seed;
  }
  for (const Polygon& part : parts)
    for (int i = 0; i < 2000; ++i) {
      const double t = along(random);
      const Point2 a = part[1], b = part[2];
      const Point2 p{a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
      if (p[0] <= 0 || p[0] >= 4 || p[1] <= 0 || p[1] >= 4) continue;
      EXPECT_EQ(owners(p), 1) << p[0] << " " << p[1] << ", seed " << seed;
    }
  EXPECT_EQ(owners({1.7, 2.1}), 1);
}

TEST(Contains, IsHalfOpen) {
  EXPECT_TRUE(contains(unit, {0, 0}));
  EXPECT_TRUE(contains(unit, {0, 0.5}));
  EXPECT_TRUE(contains(unit, {0.5, 0}));
  EXPECT_FALSE(contains(unit, {1, 0.5}));
  EXPECT_FALSE(contains(unit, {0.5, 1}));
  const Region slab{unit, {0, 2}};
  EXPECT_TRUE(contains(slab, 0.5, 0, 0.5));
  EXPECT_FALSE(contains(slab, 0.5, 2, 0.5));
}

TEST(SelfIntersection, IsFoundWhereEdgesCrossTouchOrFoldBack) {
  EXPECT_FALSE(self_intersection(dike));
  EXPECT_FALSE(self_intersection(unit));
  const auto crossing = self_intersection(Polygon{{0, 0}, {2, 2}, {2, 0}, {0, 2}});
  ASSERT_TRUE(crossing);
  EXPECT_NEAR((*crossing)[0], 1, 1e-15);
  EXPECT_NEAR((*crossing)[1], 1, 1e-15);
  EXPECT_TRUE(self_intersection(Polygon{{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 2}}));   // a corner on an edge
  EXPECT_TRUE(self_intersection(Polygon{{0, 0}, {2, 0}, {1, 0}, {1, 1}}));           // folds back
  EXPECT_TRUE(self_intersection(Polygon{{0, 0}, {0, 0}, {1, 0}, {1, 1}}));           // twice the same corner
  EXPECT_FALSE(self_intersection(Polygon{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}));  // a corner on a straight edge
}

TEST(Overlap, IsExactForConcaveAndTouchingPolygons) {
  EXPECT_NEAR(overlap(unit, Polygon{{0.5, 0.25}, {2, 0.25}, {2, 0.75}, {0.5, 0.75}}).area, 0.25, 1e-15);
  EXPECT_EQ(overlap(unit, Polygon{{1, 0}, {2, 0}, {2, 1}, {1, 1}}).area, 0);
  EXPECT_NEAR(overlap(dike, dike).area, area(dike), 1e-14);
  const Polygon u{{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  const Overlap both_arms = overlap(u, Polygon{{0.5, 2}, {2.5, 2}, {2.5, 2.5}, {0.5, 2.5}});
  EXPECT_NEAR(both_arms.area, 0.5, 1e-14);
  EXPECT_TRUE(contains(u, both_arms.inside));
}

TEST(Overlap, OfTrianglesAgreesWithClipping) {
  const unsigned seed = 7;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> at(0, 1);
  const auto triangle = [&] {
    Polygon t{{at(random), at(random)}, {at(random), at(random)}, {at(random), at(random)}};
    if (signed_area(t) < 0) std::swap(t[1], t[2]);
    return t;
  };
  for (int i = 0; i < 500; ++i) {
    const Polygon a = triangle(), b = triangle();
    Polygon common = a;
    for (std::size_t k = 0; k < 3 && !common.empty(); ++k) {
      const Point2 p = b[k], q = b[(k + 1) % 3], outward{q[1] - p[1], p[0] - q[0]};
      common = clip(common, outward, outward[0] * p[0] + outward[1] * p[1]);
    }
    EXPECT_NEAR(overlap(a, b).area, common.empty() ? 0 : area(common), 1e-12) << "seed " << seed << ", pair " << i;
  }
}

TEST(Clip, CutsTheDikeAtALevel) {
  const Polygon below = clip(dike, Bounds{{0, 0}, {5, 0.5}});
  EXPECT_NEAR(area(below), 0.5 * 0.5 * (2.1 + 0.5 * (2.1 + 0.14)), 1e-14);
}

TEST(HeightAt, IsLinearAndLevelBeyondTheEnds) {
  const Polygon line{{2, 0.8}, {4.1, 0}};
  EXPECT_EQ(height_at(line, 1), 0.8);
  EXPECT_EQ(height_at(line, 5), 0);
  EXPECT_NEAR(height_at(line, 3.05), 0.4, 1e-15);
}

}  // namespace
}  // namespace polder
