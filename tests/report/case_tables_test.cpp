#include "polder/report/case_tables.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace polder {
namespace {

using Json = nlohmann::ordered_json;

const PageTable& table_named(const std::vector<PageTable>& tables, const std::string& id) {
  const auto found = std::find_if(tables.begin(), tables.end(), [&](const PageTable& t) { return t.id == id; });
  if (found == tables.end()) throw std::runtime_error("no table " + id);
  return *found;
}

Json levee() {
  return Json::parse(R"({
    "initial": {"water_table": [[0, 2.5], [36, 2.5]]},
    "retention": [{"material": "sand", "model": "van-genuchten", "entry_pressure": 9810, "lambda": 0.5}],
    "boundary": [{"name": "base", "side": "base", "soil": "rough", "water": "closed"}],
    "seepage_boundary": [
      {"name": "river", "condition": "head", "line": [[0, 3], [7, 3], [17, 7]], "head": [[0, 2.5], [64800, 6], [259200, 3]]},
      {"name": "rain", "condition": "rain", "line": [[17, 7], [20, 7]], "rate": [[0, 1e-6]]},
      {"name": "drain", "condition": "head", "line": [[0, 0], [36, 0]], "head": [[0, 2]], "head_at_end": [[0, 3]]}],
    "load": [{"name": "road", "span": [17, 20], "pressure": [[0, 0], [3600, 13000]], "from_stage": "flood"}],
    "change": [{"name": "pit", "stage": "flood", "action": "excavate", "polygon": []}],
    "stage": [{"name": "gravity", "duration": 60, "initial": true}, {"name": "flood", "duration": 259200}]})");
}

TEST(CaseTables, SayWhatHoldsAtTheEdgesOfUnsaturatedGround) {
  const PageTable table = table_named(case_tables(levee()), "boundaries");
  ASSERT_EQ(table.rows.size(), 5u);
  EXPECT_EQ(table.rows[1][0].text, "River");
  EXPECT_EQ(table.rows[1][3].text, "head");
  EXPECT_EQ(table.rows[1][4].text, "head 2.5 m to 6 m, 3 m after 3.0 d");
  EXPECT_EQ(table.rows[3][4].text, "head 2 m; at its end 3 m");
  EXPECT_EQ(table.rows[4][1].text, "x from 17 to 20 m");
  EXPECT_EQ(table.note, "Water table at the start: (0, 2.5) – (36, 2.5) m.");
}

TEST(CaseTables, SayWhatChangesAsAStageBegins) {
  const PageTable table = table_named(case_tables(levee()), "stages");
  EXPECT_EQ(table.rows[1][2].text, "excavate pit; road from here on");
}

TEST(CaseTables, ShowHowSoilHoldsWater) {
  const PageTable table = table_named(case_tables(levee()), "retention");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"Quantity", "Sand"}));
  EXPECT_EQ(table.rows[1][0].text, "Entry pressure");
  EXPECT_EQ(table.rows[1][1].text, "9.81 kPa");
}

TEST(CaseTables, PrintPowersAsPowers) {
  const Json inputs =
      Json::parse(R"({"material": [{"name": "clay", "law": "mohr-coulomb", "horizontal_permeability": 1e-7,
                                      "vertical_permeability": 1.16e-9}]})");
  const PageTable table = table_named(case_tables(inputs), "materials");
  EXPECT_EQ(table.rows[1][2].text, "10⁻⁷ m/s");
  EXPECT_EQ(table.rows[2][2].text, "1.16·10⁻⁹ m/s");
}

TEST(PageLevels, AreThoseOfHeadsThatAreTheSameAlongTheirLine) {
  const auto levels = page_levels(levee());
  ASSERT_EQ(levels.size(), 1u);
  EXPECT_EQ(levels[0].name, "river");
  EXPECT_EQ(levels[0].line.size(), 3u);
  EXPECT_EQ(levels[0].head[1], (Point2{64800, 6}));
}

TEST(PageLevels, OfCoursesThatAreSomethingElseAreLeftOut) {
  EXPECT_TRUE(page_levels(Json::parse(R"({"seepage_boundary": [{"condition": "head", "line": [[0, 0], [1, 0]],
                                          "head": [[0], [2.5]]}]})"))
                  .empty());
}

}  // namespace
}  // namespace polder
