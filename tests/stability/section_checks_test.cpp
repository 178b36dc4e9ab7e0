#include <gtest/gtest.h>

#include <stdexcept>

#include "polder/stability/check_section.hpp"
#include "polder/stability/search.hpp"
#include "reference_slopes.hpp"

namespace polder::stability {
namespace {

std::string complaint(const Section& section) {
  try {
    prepare(section);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

const Method by_bishop = [](const Slices& slices, const SlipSurface& surface) {
  return bishop(slices, surface.circle);
};

TEST(SectionChecks, NoSoilIsNamed) { EXPECT_TRUE(says(complaint({}), "there is no soil")); }

TEST(SectionChecks, GapBetweenLayersIsLocated) {
  Section section = testing::griffiths_lane_1();
  section.layers = {testing::layer({{0, 0}, {50, 0}, {50, 4}, {0, 4}}),
                    testing::layer({{0, 4.2}, {50, 4.2}, {50, 10}, {0, 10}})};
  const std::string text = complaint(section);
  EXPECT_TRUE(says(text, "gap of 0.200 m between layer 2 and layer 1 at x = 25 m")) << text;
  EXPECT_TRUE(says(text, "share the points")) << text;
}

TEST(SectionChecks, OverlapIsLocated) {
  Section section = testing::griffiths_lane_1();
  section.layers = {testing::layer({{0, 0}, {50, 0}, {50, 4}, {0, 4}}),
                    testing::layer({{0, 3}, {50, 3}, {50, 10}, {0, 10}})};
  EXPECT_TRUE(says(complaint(section), "overlap by 1.000 m at x = 25 m"));
}

TEST(SectionChecks, LimitsOutsideTheSectionAreRefused) {
  Section section = testing::griffiths_lane_1();
  section.limits.entry = Range{80, 90};
  EXPECT_TRUE(says(complaint(section), "entry from 80 to 90 m lies outside the section (0 to 50 m)"));
}

TEST(SectionChecks, LimitsThatExcludeEverythingAreExplained) {
  Section section = testing::griffiths_lane_1();
  section.limits.minimum_depth = 30;
  const SearchResult result = critical_circle(prepare(section), by_bishop);
  EXPECT_FALSE(result);
  EXPECT_TRUE(says(result.problem, "none of")) << result.problem;
  EXPECT_TRUE(says(result.problem, "limit: minimum depth")) << result.problem;
}

TEST(SectionChecks, LevelGroundHasNoSlidingSurface) {
  Section section = testing::griffiths_lane_1();
  section.layers = {testing::layer({{0, 0}, {50, 0}, {50, 10}, {0, 10}})};
  const SearchResult result = critical_circle(prepare(section), by_bishop);
  EXPECT_FALSE(result);
  EXPECT_TRUE(says(result.problem, "nothing drives the soil")) << result.problem;
}

TEST(SectionChecks, HeadAboveTheGroundIsNoted) {
  Section section = testing::griffiths_lane_1();
  section.water.phreatic = {{0, 3}, {50, 3}};
  const std::vector<std::string> remarks = notes(prepare(section));
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_TRUE(says(remarks[0], "above the ground from x = 0 to 18 m, up to 3.00 m")) << remarks[0];
}

TEST(SectionChecks, UpliftUnderALayerIsNoted) {
  Section section = testing::griffiths_lane_1();
  section.layers.push_back(testing::layer({{0, -4}, {50, -4}, {50, 0}, {0, 0}}));
  section.water.phreatic = {{0, 0}, {50, 0}};
  section.water.references = {{{{0, -2}, {50, -2}}, {{0, 5}, {50, 5}}, {{0, 5}, {50, 5}}}};
  const std::vector<std::string> remarks = notes(prepare(section));
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_TRUE(says(remarks[0], "lifts the soil above it: weight over pressure is 0.582")) << remarks[0];
}

TEST(Limits, EntryAndExitHoldForTheCriticalCircle) {
  Section section = testing::griffiths_lane_1();
  section.limits.entry = Range{40, 45};
  section.limits.exit = Range{13, 16};
  const SearchResult result = critical_circle(prepare(section), by_bishop);
  ASSERT_TRUE(result) << result.problem;
  EXPECT_GE(result.surface.right, 40);
  EXPECT_LE(result.surface.right, 45);
  EXPECT_GE(result.surface.left, 13);
  EXPECT_LE(result.surface.left, 16);
}

TEST(Limits, ForbiddenLineIsNotCrossed) {
  Section section = testing::griffiths_lane_1();
  section.limits.forbidden_lines = {{{20, 0}, {20, 3}}};
  const SearchResult result = critical_circle(prepare(section), by_bishop);
  ASSERT_TRUE(result) << result.problem;
  EXPECT_GT(base_level(result.surface, 20), 3 - 0.05);
}

TEST(Limits, ForbiddenZoneIsNotEntered) {
  Section section = testing::griffiths_lane_1();
  section.limits.forbidden_zones = {{{0, 0}, {50, 0}, {50, 2}, {0, 2}}};
  const SearchResult result = critical_circle(prepare(section), by_bishop);
  ASSERT_TRUE(result) << result.problem;
  for (const Slice& slice : result.slices.list) EXPECT_GT(slice.base(), 2 - 0.02);
}

}  // namespace
}  // namespace polder::stability
