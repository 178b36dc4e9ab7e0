#include "polder/result/chart.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace polder;

namespace {

std::vector<std::string> texts_of(const Drawing& drawing) {
  std::vector<std::string> texts;
  for (const Shape& shape : drawing.shapes)
    if (const auto* text = std::get_if<Text>(&shape)) texts.push_back(text->text);
  return texts;
}

bool has(const std::vector<std::string>& texts, const std::string& text) {
  return std::find(texts.begin(), texts.end(), text) != texts.end();
}

}  // namespace

TEST(Chart, ShowsUnitsThatSuitTheNumbers) {
  Chart chart{"", "time", "pressure", "s", "Pa", {{"toe", {0, 36000}, {0, 8000}}}, {}};
  const auto texts = texts_of(draw_chart(chart));
  EXPECT_TRUE(has(texts, "time (h)"));
  EXPECT_TRUE(has(texts, "pressure (kPa)"));
  EXPECT_TRUE(has(texts, "8"));
  EXPECT_TRUE(has(texts, "10"));
}

TEST(Chart, LeavesAGapWhereAValueIsMissing) {
  const double none = std::nan("");
  Chart chart{"", "time", "", "s", "m", {{"a", {0, 1, 2, 3, 4}, {1, 2, none, 2, 1}}}, {}};
  std::size_t curves = 0;
  for (const Shape& shape : draw_chart(chart).shapes)
    if (const auto* path = std::get_if<Path>(&shape); path && path->stroke && path->stroke->width == 1.8) ++curves;
  EXPECT_EQ(curves, 2u);
}

TEST(Chart, OfNothingIsStillAChart) {
  EXPECT_NO_THROW(draw_chart({"", "time", "", "s", "m", {{"a", {}, {}}}, {}}));
  EXPECT_GT(texts_of(draw_chart({"", "time", "", "s", "m", {}, {}})).size(), 4u);
}

TEST(Chart, ThinningKeepsEndsAndExtremes) {
  Curve curve{"", {}, {}, false};
  for (int i = 0; i < 100000; ++i) {
    curve.x.push_back(i);
    curve.y.push_back(i == 54321 ? 99 : i == 777 ? -99 : std::sin(0.01 * i));
  }
  const Curve few = thinned(curve, 2000);
  EXPECT_LE(few.x.size(), 2000u);
  EXPECT_TRUE(std::is_sorted(few.x.begin(), few.x.end()));
  EXPECT_EQ(few.x.front(), 0);
  EXPECT_EQ(few.x.back(), 99999);
  EXPECT_EQ(*std::max_element(few.y.begin(), few.y.end()), 99);
  EXPECT_EQ(*std::min_element(few.y.begin(), few.y.end()), -99);
}

TEST(HistoryCharts, JoinWhatSharesUnitAndSize) {
  History history;
  history.columns = {{"time", "s"}, {"p1", "Pa"}, {"u", "m"}, {"p2", "Pa"}, {"p tiny", "Pa"}};
  history.values = {{0, 1}, {1000, 2000}, {0.1, 0.2}, {3000, 500}, {1, 2}};
  const std::vector<Chart> charts = history_charts(history);
  ASSERT_EQ(charts.size(), 3u);
  ASSERT_EQ(charts[0].curves.size(), 2u);
  EXPECT_EQ(charts[0].curves[1].name, "p2");
  EXPECT_EQ(charts[1].title, "u");
  EXPECT_EQ(charts[2].title, "p tiny");
}
