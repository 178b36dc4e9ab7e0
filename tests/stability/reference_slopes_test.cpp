#include "reference_slopes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "polder/stability/search.hpp"

namespace polder::stability {
namespace {

const Method by_bishop = [](const Slices& slices, const SlipSurface& surface) {
  return bishop(slices, surface.circle);
};
const Method by_spencer = [](const Slices& slices, const SlipSurface&) { return spencer(slices); };
const Method by_morgenstern_price = [](const Slices& slices, const SlipSurface&) {
  return morgenstern_price(slices, Interslice::half_sine);
};

double slices_lever(const SearchResult& result, const Slice& slice, const Circle& circle) {
  return result.slices.direction * (circle.centre[0] - slice.middle());
}

void expect_within(const Section& section, const Method& method, double reference, double tolerance) {
  const SearchResult result = critical_circle(prepare(section), method);
  ASSERT_TRUE(result) << result.problem;
  EXPECT_NEAR(result.equilibrium.factor, reference, tolerance * reference);
}

TEST(Acads1a, BishopAgreesWithTheReferee) { expect_within(testing::acads_1a(), by_bishop, 0.987, 0.02); }
TEST(Acads1a, SpencerAgreesWithTheReferee) { expect_within(testing::acads_1a(), by_spencer, 0.985, 0.02); }
TEST(Acads1a, MorgensternPriceAgreesWithSpencer) {
  expect_within(testing::acads_1a(), by_morgenstern_price, 0.985, 0.02);
}
TEST(Acads1c, BishopAgreesWithTheReferee) { expect_within(testing::acads_1c(), by_bishop, 1.405, 0.02); }
TEST(Acads1c, SpencerAgreesWithTheReferee) { expect_within(testing::acads_1c(), by_spencer, 1.375, 0.02); }
TEST(GriffithsLane1, BishopAgreesWithTheCharts) { expect_within(testing::griffiths_lane_1(), by_bishop, 1.378, 0.02); }
TEST(GriffithsLane1, SpencerAgreesWithTheCharts) {
  expect_within(testing::griffiths_lane_1(), by_spencer, 1.376, 0.02);
}

TEST(Acads1a, FreeSurfaceIsAtMostTwoPerCentBelowTheCircle) {
  const SearchResult result = critical_free_surface(prepare(testing::acads_1a()), by_spencer);
  ASSERT_TRUE(result) << result.problem;
  EXPECT_NEAR(result.equilibrium.factor, 0.985, 0.02 * 0.985);
}

TEST(GriffithsLane1, MirroredSlopeHasTheSameFactor) {
  Section mirrored = testing::griffiths_lane_1();
  for (Layer& layer : mirrored.layers)
    for (Point& p : layer.polygon) p[0] = -p[0];
  const PreparedSection here = prepare(testing::griffiths_lane_1()), there = prepare(mirrored);
  for (const double radius : {16.0, 17.0, 17.9}) {
    const Circle circle{{15, 18}, radius}, image{{-15, 18}, radius};
    for (const Method& method : {by_bishop, by_spencer, by_morgenstern_price}) {
      const SearchResult a = evaluate(here, circle_surface(here, circle), method);
      const SearchResult b = evaluate(there, circle_surface(there, image), method);
      EXPECT_EQ(a.problem, b.problem);
      EXPECT_NEAR(a.equilibrium.factor, b.equilibrium.factor, 1e-7) << radius;
    }
  }
}

TEST(UndrainedCircle, BishopAndSpencerGiveTheMomentOfTheArc) {
  // With φ = 0 every method must return s_u L R / (moment of the weight): nothing else enters the moments.
  Section section = testing::griffiths_lane_1();
  Strength undrained;
  undrained.model = StrengthModel::undrained;
  undrained.undrained_strength = 40e3;
  section.soils[0].above = section.soils[0].below = undrained;
  const PreparedSection prepared = prepare(section);
  const Circle circle{{17, 20}, 19.5};
  const SearchResult bishops = evaluate(prepared, circle_surface(prepared, circle), by_bishop);
  const SearchResult spencers = evaluate(prepared, circle_surface(prepared, circle), by_spencer);
  ASSERT_TRUE(bishops) << bishops.problem;
  ASSERT_TRUE(spencers) << spencers.problem;
  double length = 0, moment = 0;
  for (const Slice& slice : bishops.slices.list) {
    length += slice.length;
    moment += slice.weight * slices_lever(bishops, slice, circle);
  }
  const double exact = 40e3 * length * circle.radius / moment;
  EXPECT_NEAR(bishops.equilibrium.factor, exact, 1e-6 * exact);
  EXPECT_NEAR(spencers.equilibrium.factor, exact, 2e-3 * exact);  // straight bases instead of arcs
}

TEST(InfiniteSlope, DrySandFailsAtItsFrictionAngle) {
  // A shallow surface parallel to a long slope: F = tan φ / tan β, for any depth.
  Section section;
  section.soils = {testing::drained(0, 35, 18)};
  section.layers = {testing::layer({{-20, -60}, {220, -60}, {220, 0}, {200, 0}, {0, 100}, {-20, 100}})};
  const PreparedSection prepared = prepare(section);
  const Line points{{20, 90}, {20.4, 89.5}, {179.6, 9.9}, {180, 10}};
  const SearchResult result = evaluate(prepared, free_surface(prepared, points), by_spencer);
  ASSERT_TRUE(result) << result.problem;
  EXPECT_NEAR(result.equilibrium.factor, std::tan(35 * std::numbers::pi / 180) / 0.5, 0.02);
}

}  // namespace
}  // namespace polder::stability
