#include "polder/report/report.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "polder/report/audit.hpp"
#include "polder/report/html.hpp"
#include "polder/result/history.hpp"
#include "polder/result/output_error.hpp"
#include "polder/result/paint.hpp"
#include "polder/result/summary.hpp"

using namespace polder;

namespace {

// A run's folder with a history, a picture and, when it is finished, a summary.
class Report : public testing::Test {
 protected:
  std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("polder-report-" + std::to_string(::getpid()));

  void SetUp() override {
    std::filesystem::create_directories(folder / "pictures");
    HistoryFile history(folder / "history.csv", {{"crest <settlement>", "m"}, {"p", "Pa"}});
    for (int i = 0; i < 20; ++i) history.append(0.5 * i, std::vector{0.01 * i, 9000.0 - 10 * i});
    for (const char* file : {"porosity_t0.png", "porosity_t9.5.png"}) std::ofstream(folder / "pictures" / file) << file;
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  void finish() const {
    Summary summary;
    summary.reason = "the end of stage <failure> is reached";
    summary.steps = 1234567;
    summary.water_balance_error = 3e-15;
    summary.solid_mass_error = 2e-4;
    summary.flux_balance_error = std::nan("");
    summary.case_inputs["title"] = "A dike & its water";
    summary.case_inputs["material"] = {{{"name", "sand"}, {"porosity", 0.4}}};
    write_summary(folder / "summary.json", summary);
  }
};

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

}  // namespace

TEST_F(Report, OfAFinishedRunHoldsAllOfIt) {
  finish();
  const std::string page = report_page(folder);
  for (const std::string& text :
       {std::string("A dike &amp; its water"), std::string("the end of stage &lt;failure&gt; is reached"),
        std::string("1\u2009234\u2009567"), std::string("status finished"), std::string("crest &lt;settlement&gt;"),
        base64("porosity_t0.png"), base64("porosity_t9.5.png"), std::string("<td>0.4</td>")})
    EXPECT_NE(page.find(text), std::string::npos) << text;
  EXPECT_EQ(count_of(page, "<svg"), 2u);  // metres and pascals make two charts
  EXPECT_EQ(count_of(page, "<svg"), count_of(page, "</svg>"));
}

TEST_F(Report, NeedsNeitherNetworkNorScript) {
  finish();
  const std::string page = report_page(folder);
  EXPECT_EQ(count_of(page, "<script"), 0u);
  EXPECT_EQ(count_of(page, "http://") + count_of(page, "https://"),
            count_of(page, "xmlns=\"http://www.w3.org/2000/svg\""));
  EXPECT_EQ(count_of(page, "src=\""), count_of(page, "src=\"data:"));
}

TEST_F(Report, OfARunThatGoesOnSaysHowFarItIsAndReloads) {
  const std::string page = report_page(folder, {5});
  EXPECT_NE(page.find("status running"), std::string::npos);
  EXPECT_NE(page.find("t = 9.50 s"), std::string::npos);
  EXPECT_NE(page.find("http-equiv=\"refresh\" content=\"5\""), std::string::npos);
  finish();
  EXPECT_EQ(report_page(folder, {5}).find("http-equiv=\"refresh\""), std::string::npos);
}

TEST_F(Report, IsTheSameForTheSameFolder) {
  finish();
  EXPECT_EQ(report_page(folder), report_page(folder));
  write_report(folder);
  EXPECT_EQ(std::filesystem::file_size(folder / "report.html"), report_page(folder).size());
}

TEST_F(Report, OfAFolderWithoutARunIsRefused) {
  EXPECT_THROW(report_page(folder / "pictures"), std::runtime_error);
  std::ofstream(folder / "summary.json") << "{\"status\": ";
  EXPECT_THROW(write_report(folder), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(folder / "report.html"));
}

TEST_F(Report, AuditSaysWhatIsKeptAndWhatIsNot) {
  finish();
  const std::vector<AuditRow> rows = audit(read_json(folder / "summary.json"));
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].verdict, "kept");
  EXPECT_EQ(rows[1].verdict, "not kept");
  EXPECT_TRUE(std::isnan(rows[2].value));
  EXPECT_TRUE(audit(nlohmann::ordered_json()).empty());
}

TEST(HtmlOutline, ShowsNestedInputsAndHarmlessText) {
  const auto json = nlohmann::ordered_json::parse(
      R"({"cell_size": 0.05, "polygon": [[0, 0], [1, 0.5]], "soil": [{"name": "a <b>", "x": null}], "none": []})");
  const std::string page = html::outline(json);
  EXPECT_NE(page.find("cell size"), std::string::npos);
  EXPECT_NE(page.find("(0, 0), (1, 0.5)"), std::string::npos);
  EXPECT_NE(page.find("a &lt;b&gt;"), std::string::npos);
}
