#include "polder/report/expected.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "polder/report/comparison.hpp"

namespace polder {
namespace {

class Expected : public testing::Test {
 protected:
  std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("polder-expected-" + std::to_string(::getpid()) + ".toml");
  void TearDown() override { std::filesystem::remove(file); }

  std::vector<Expectation> read(const std::string& text) const {
    std::ofstream(file) << text;
    return read_expectations(file);
  }
};

/// Settlement 0, 0.1, 0.3 m at 0, 1, 2 s.
History course() { return {{{"time", "s"}, {"settlement", "m"}}, {{0, 1, 2}, {0, 0.1, 0.3}}}; }

SoilShape shape(double crest, double left, double right, double moved) { return {true, crest, left, right, moved}; }

TEST_F(Expected, ComparesAMonitorAtATimeAtTheEndAndWhereItReachesAValue) {
  const auto expectations = read(R"(
[[compare]]
quantity = "then"
monitor = "settlement"
time = "1.5 s"
reference = 0.2
tolerance = 0.001
[[compare]]
quantity = "at the end"
monitor = "settlement"
reference = 0.2
tolerance = 0.05
[[compare]]
quantity = "when"
monitor = "settlement"
reaches = 0.2
reference = 1.5
tolerance = 0.001
[[compare]]
quantity = "most in the first second"
monitor = "settlement"
largest = true
time = 1
reference = 0.1
tolerance = 0.001
)");
  const auto compared = compare(expectations, course(), {}, {});
  ASSERT_EQ(compared.size(), 4u);
  EXPECT_DOUBLE_EQ(*compared[0].computed, 0.2);
  EXPECT_EQ(compared[0].unit, "m");
  EXPECT_EQ(compared[0].verdict, Verdict::within);
  EXPECT_DOUBLE_EQ(*compared[1].computed, 0.3);
  EXPECT_EQ(compared[1].verdict, Verdict::outside);
  EXPECT_DOUBLE_EQ(*compared[2].computed, 1.5);
  EXPECT_EQ(compared[2].unit, "s");
  EXPECT_DOUBLE_EQ(*compared[3].computed, 0.1);
  EXPECT_EQ(comparison_fact(compared)->value, "3 of 4");
}

TEST_F(Expected, AnswersFromTheShapeOfTheSoil) {
  const auto expectations = read(R"(
[[compare]]
quantity = "run-out"
result = "run-out"
reference = 0.7
tolerance = 0.01
[[show]]
quantity = "crest"
result = "residual crest height"
reference = "about 0.8 m"
)");
  const auto compared = compare(expectations, course(), shape(1, 2, 4, 0), shape(0.8, 1.9, 4.7, 1));
  EXPECT_NEAR(*compared[0].computed, 0.7, 1e-12);
  EXPECT_EQ(compared[0].verdict, Verdict::within);
  EXPECT_EQ(*compared[1].computed, 0.8);
  EXPECT_EQ(compared[1].verdict, Verdict::shown);
}

TEST_F(Expected, DoesNotJudgeWhatTheRunCannotAnswer) {
  const auto expectations = read(R"(
[[compare]]
quantity = "difference between grids"
reference = 0
tolerance = 0.1
[[compare]]
quantity = "later"
monitor = "settlement"
time = "5 s"
reference = 0.2
tolerance = 0.1
[[compare]]
quantity = "never"
monitor = "settlement"
reaches = 0.5
reference = 3
tolerance = 1
[[stability]]
method = "bishop"
)");
  const auto compared = compare(expectations, course(), {}, {});
  ASSERT_EQ(compared.size(), 3u);
  EXPECT_EQ(compared[0].verdict, Verdict::other_runs);
  EXPECT_EQ(compared[1].verdict, Verdict::not_reached);
  EXPECT_EQ(compared[2].verdict, Verdict::not_reached);
  const PageTable table = comparison_table(compared);
  EXPECT_EQ(table.rows[0][5].state, PageCell::State::none);
  EXPECT_EQ(table.rows[1][5].state, PageCell::State::fail);
}

TEST_F(Expected, OfARunThatWasStoppedBeforeItsHistoryBeganIsNotReached) {
  const auto expectations = read(R"(
[[compare]]
quantity = "then"
monitor = "settlement"
reference = 0.2
tolerance = 0.001
)");
  EXPECT_EQ(compare(expectations, {}, {}, {}).at(0).verdict, Verdict::not_reached);
}

TEST_F(Expected, SaysWhereAnEntryIsWrong) {
  const auto message = [&](const std::string& text) -> std::string {
    try {
      compare(read(text), course(), {}, {});
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message("[[compare]]\nquantity = \"a\"\nreference = 1\n").find(".toml:1: a [[compare]] needs a reference"),
            std::string::npos);
  EXPECT_NE(message("[[show]]\nquantity = \"a\"\nreference = 1\ntime = \"2 m\"\nmonitor = \"settlement\"\n")
                .find(".toml:4: time: "),
            std::string::npos);
  EXPECT_NE(message("[[show]]\nquantity = \"a\"\nmonitor = \"crest\"\nreference = 1\n").find("the monitor 'crest'"),
            std::string::npos);
  EXPECT_NE(message("[[show]]\nquantity = \"a\"\nresult = \"height\"\nreference = 1\n").find("the result 'height'"),
            std::string::npos);
  EXPECT_NE(message("[[show]\n").find(".toml:1: "), std::string::npos);
}

TEST(ExpectedFiles, OfEveryShippedCaseCanBeRead) {
  int files = 0;
  for (const auto& folder : std::filesystem::directory_iterator(POLDER_SOURCE_DIR "/cases"))
    if (std::filesystem::exists(folder.path() / "expected.toml")) {
      ++files;
      EXPECT_NO_THROW(read_expectations(folder.path() / "expected.toml")) << folder.path();
    }
  EXPECT_GE(files, 4);
}

}  // namespace
}  // namespace polder
