#include "polder/report/report.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "polder/report/audit.hpp"
#include "polder/report/player_fields.hpp"
#include "polder/report/run_points.hpp"
#include "polder/report/soil_shape.hpp"
#include "synthetic_run.hpp"

namespace polder {
namespace {

class Report : public testing::Test {
 protected:
  std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("polder-report-" + std::to_string(::getpid()));
  void TearDown() override { std::filesystem::remove_all(folder); }

  void write(bool finished = true) const {
    SyntheticRun run;
    run.spacing = 0.1;
    run.frames = 13;
    run.finished = finished;
    write_synthetic_run(folder, run);
  }
};

const PageTable* table_of(const Page& page, const std::string& id) {
  for (const PageTable& table : page.tables)
    if (table.id == id) return &table;
  return nullptr;
}

TEST_F(Report, OfAFinishedRunHoldsAllOfIt) {
  write();
  const Page page = run_page(folder);
  EXPECT_EQ(page.title, "A slumping dike, from formulas");
  EXPECT_EQ(page.status, "finished");
  EXPECT_NE(page.summary.find("The end of the last stage was reached."), std::string::npos) << page.summary;
  EXPECT_EQ(page.times.size(), 13u);
  EXPECT_EQ(page.times.back(), 12.0);
  ASSERT_EQ(page.points.size(), 2u);
  EXPECT_EQ(page.points[0].series.name, "soil");
  EXPECT_NEAR(page.points[0].spacing, 0.1, 1e-6);
  EXPECT_EQ(page.history.columns.size(), 8u);
  EXPECT_EQ(page.monitors.size(), 2u);
  EXPECT_EQ(page.outlines.size(), 1u);
  EXPECT_TRUE(page.notes.empty());
}

TEST_F(Report, NamesMaterialsWithSymbolsAndUnits) {
  write();
  const Page page = run_page(folder);
  const PageTable* materials = table_of(page, "materials");
  ASSERT_NE(materials, nullptr);
  const auto row = std::find_if(materials->rows.begin(), materials->rows.end(),
                                [](const auto& r) { return r[0].text == "Friction angle"; });
  ASSERT_NE(row, materials->rows.end());
  EXPECT_EQ((*row)[1].text, "φ'");
  EXPECT_EQ((*row)[2].text, "35°");
  EXPECT_EQ((*row)[3].text, "30°");
}

TEST_F(Report, OfARunThatGoesOnSaysHowFarItIsAndLoadsItselfAgain) {
  write(false);
  const Page page = run_page(folder, {5});
  EXPECT_EQ(page.status, "running");
  EXPECT_EQ(page.reload_seconds, 5);
  EXPECT_NE(page.summary.find("t = 12.0 s"), std::string::npos) << page.summary;
  write(true);
  EXPECT_EQ(run_page(folder, {5}).reload_seconds, 0);
}

TEST_F(Report, IsTheSameForTheSameFolder) {
  write();
  write_report(folder);
  std::ifstream file(folder / "report.html", std::ios::binary);
  const std::string written{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(written, render_page(run_page(folder)));
}

TEST_F(Report, OfAFolderWithoutARunIsRefused) {
  std::filesystem::create_directories(folder);
  EXPECT_THROW(run_page(folder), std::runtime_error);
  std::ofstream(folder / "summary.json") << "{\"status\": ";
  EXPECT_THROW(write_report(folder), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(folder / "report.html"));
}

TEST_F(Report, ShowsAValidationThatLiesBesideTheRun) {
  write();
  std::ofstream(folder / "comparison.json")
      << R"([{"problem": "slump", "quantity": "run-out", "at": "12 s", "reference": 1.0, "computed": 1.2,
              "error": 0.2, "tolerance": 0.1, "pass": false, "seconds": 3}])";
  const Page page = run_page(folder);
  const PageTable* table = table_of(page, "validation");
  ASSERT_NE(table, nullptr);
  ASSERT_EQ(table->rows.size(), 1u);
  EXPECT_EQ(table->rows[0][4].state, PageCell::State::fail);
}

TEST_F(Report, ComparesTheRunWithExpectedToml) {
  write();
  const Page page = run_page(folder);
  const PageTable* table = table_of(page, "comparison");
  ASSERT_NE(table, nullptr);
  EXPECT_EQ(table->rows.size(), 4u);
  EXPECT_EQ(page.facts.back().value, "1 of 2");
}

TEST_F(Report, SaysWhatIsWrongWithExpectedTomlAndIsWrittenAllTheSame) {
  write();
  std::ofstream(folder / "expected.toml") << "[[show]]\nquantity = \"a\"\nmonitor = \"no such\"\nreference = 1\n";
  const Page page = run_page(folder);
  EXPECT_EQ(table_of(page, "comparison"), nullptr);
  ASSERT_EQ(page.notes.size(), 1u);
  EXPECT_NE(page.notes[0].find("'no such'"), std::string::npos);
}

TEST_F(Report, AuditSaysWhatIsKeptAndWhatIsNot) {
  Summary summary;
  summary.water_balance_error = 3e-15;
  summary.solid_mass_error = 2e-4;
  summary.flux_balance_error = std::nan("");
  const std::vector<AuditRow> rows = audit(summary_json(summary));
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].verdict, "kept");
  EXPECT_EQ(rows[1].verdict, "not kept");
  EXPECT_TRUE(std::isnan(rows[2].value));
  EXPECT_TRUE(audit(nlohmann::ordered_json()).empty());
}

TEST_F(Report, ThinsByIdAndSaysSo) {
  write();
  const RunPoints all = read_run_points(folder, {});
  PageLimits limits;
  limits.points = 100;
  limits.frames = 5;
  const RunPoints some = read_run_points(folder, {}, limits);
  EXPECT_EQ(some.notes.size(), 2u);
  EXPECT_LE(some.times.size(), 6u);
  EXPECT_EQ(some.times.front(), 0.0);
  EXPECT_EQ(some.times.back(), 12.0);
  const double per_frame =
      static_cast<double>(some.soil.entries() + some.water.entries()) / static_cast<double>(some.times.size());
  EXPECT_LT(per_frame, 100 * 1.3);
  EXPECT_GT(per_frame, 100 * 0.4);
  // The same soil points in the first frame as in the last, each standing for more soil.
  const auto begin = some.soil.id.begin();
  const std::vector<std::uint64_t> first(begin, begin + static_cast<std::ptrdiff_t>(some.soil.frame_start[1]));
  const std::size_t last = some.soil.frame_start[some.soil.frames() - 1];
  EXPECT_EQ(first, std::vector<std::uint64_t>(begin + static_cast<std::ptrdiff_t>(last), some.soil.id.end()));
  EXPECT_GT(some.soil_spacing, 1.2 * all.soil_spacing);
}

TEST(SoilShape, LeavesOutGrainsThrownOut) {
  PointSet soil;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 25; ++j) {
      soil.id.push_back(soil.id.size());
      soil.position.push_back({0.1 * i + 0.05, 0.1 * j + 0.05, 0});
      soil.volume.push_back(0.01);
    }
  for (int k = 0; k < 2; ++k) {  // two in the air, together
    soil.id.push_back(5000 + soil.id.size());
    soil.position.push_back({30, 9 + 0.1 * k, 0});
    soil.volume.push_back(0.01);
  }
  const SoilShape shape = soil_shape(soil, 1);
  EXPECT_NEAR(shape.crest, 2.5, 1e-12);
  EXPECT_NEAR(shape.left, 0, 1e-12);
  EXPECT_NEAR(shape.right, 4, 1e-12);
  EXPECT_FALSE(soil_shape({}, 1).any);
}

TEST(SoilShape, KeepsAThinTongue) {
  PointSet soil;
  for (int i = 0; i < 100; ++i) {
    soil.id.push_back(soil.id.size());
    soil.position.push_back({0.1 * i + 0.05, 0.05, 0});
    soil.volume.push_back(0.01);
  }
  const SoilShape shape = soil_shape(soil, 1);
  EXPECT_NEAR(shape.right, 10, 1e-12);
  EXPECT_NEAR(shape.crest, 0.1, 1e-12);
}

TEST(PlayerFields, MakeInvariantsOfTheEffectiveStress) {
  PointSet points;
  points.id = {1};
  points.position = {{1, 2, 0}};
  points.volume = {1};
  points.fields = {make_field("effective_stress", {-1e3, -4e3, -1e3, 2e3, 0, 0}, 6)};
  std::vector<float> mean, deviator, vertical;
  for (const PlayerColumn& column : player_columns(points, 1, {})) {
    if (column.info.key == "mean_effective_stress") append_values(column, points, {0}, mean);
    if (column.info.key == "deviatoric_stress") append_values(column, points, {0}, deviator);
    if (column.info.key == "vertical_effective_stress") append_values(column, points, {0}, vertical);
  }
  ASSERT_EQ(mean.size() + deviator.size() + vertical.size(), 3u);
  EXPECT_FLOAT_EQ(mean[0], 2e3f);
  // s = (1, −2, 1, 2) kPa: √(3/2 (1 + 4 + 1 + 2·4)) = √21
  EXPECT_FLOAT_EQ(deviator[0], 1e3f * std::sqrt(21.0f));
  EXPECT_FLOAT_EQ(vertical[0], -4e3f);
}

}  // namespace
}  // namespace polder
