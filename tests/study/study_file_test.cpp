// Study files: lists, ranges and tables become members; mistakes are named with their place.
#include <gtest/gtest.h>

#include <fstream>

#include "polder/case/locate.hpp"
#include "polder/case/reader.hpp"
#include "polder/study/results.hpp"

namespace polder::study {
namespace {

Study read_text(const std::string& text) {
  const std::string path =
      testing::TempDir() + "/" + testing::UnitTest::GetInstance()->current_test_info()->name() + "-study.toml";
  std::ofstream(path) << text;
  return read_study(path);
}

std::string mistake_in(const std::string& text) {
  try {
    read_text(text);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(StudyFile, MakesEveryCombinationOfListsRangesAndTables) {
  const Study study = read_text(R"(
case = "hydrostatic"
set = ["model.gravity=9.8 m/s2"]
[[vary]]
key = "material.sand.cohesion"
from = "0 kPa"
to = "10 kPa"
count = 3
[[vary]]
keys = ["model.cell", "numerics.cfl"]
rows = [["0.1 m", 0.8], ["0.05 m", 0.5]]
)");
  ASSERT_EQ(study.members.size(), 6u);
  EXPECT_EQ(study.labels, (std::vector<std::string>{"cohesion", "cell", "cfl"}));
  EXPECT_EQ(study.members[3].overrides,
            (std::vector<std::string>{"model.gravity=9.8 m/s2", "material.sand.cohesion=5 kPa", "model.cell=0.05 m",
                                      "numerics.cfl=0.5"}));
  EXPECT_EQ(study.members[3].name, "cohesion = 5 kPa, cell = 0.05 m, cfl = 0.5");
  EXPECT_EQ(study.members[3].folder, "cohesion_5_kPa_cell_0.05_m_cfl_0.5");
}

TEST(StudyFile, NamesMembersWithNumbersAsTheyAreWritten) {
  const Study study = read_text(
      "case = \"x\"\n[[vary]]\nlabel = \"Δt\"\nkey = \"a\"\n"
      "values = [\"π\", 1e-3, 0.25, 0.00625,\n 2e6, 7, true]\n");
  std::vector<std::string> names;
  for (const Member& member : study.members) names.push_back(member.name);
  EXPECT_EQ(names, (std::vector<std::string>{"Δt = π", "Δt = 1e-3", "Δt = 0.25", "Δt = 0.00625", "Δt = 2e6", "Δt = 7",
                                             "Δt = true"}));
}

TEST(StudyFile, NamesMistakesWithTheirLine) {
  EXPECT_NE(mistake_in("case = \"x\"\n[[vary]]\nkeyy = \"a\"\n").find(":3: 'keyy' is no key of [[vary]]; did you mean"),
            std::string::npos);
  EXPECT_NE(mistake_in("case = \"x\"\n").find("nothing varies"), std::string::npos);
  EXPECT_NE(mistake_in("case = \"x\"\n[[vary]]\nkey = \"a\"\nfrom = \"0 kPa\"\nto = \"1 Pa\"\ncount = 2\n")
                .find("different units"),
            std::string::npos);
}

TEST(StudyFile, ShippedOnesFitTheirCases) {
  const auto names = shipped_studies();
  EXPECT_GE(names.size(), 7u);
  for (const std::string& name : names) {
    const Study study = read_study(*find_study(name));
    const auto file = find_case(study.case_name);
    ASSERT_TRUE(file) << name;
    for (const Member& member : study.members) {
      const ReadResult result = read_case(file->string(), member.overrides);
      EXPECT_TRUE(result.ok()) << name << ": " << member.name << "\n" << format(result.diagnostics);
    }
  }
}

TEST(StudyResults, JudgeTrendsAndAgreement) {
  Study study = read_text(
      "case = \"x\"\n[[vary]]\nkey = \"a\"\nvalues = [1, 2, 3]\n[[measure]]\nname = \"m\"\nmonitor = \"m\"\n"
      "trend = \"falls\"\nwithin = 0.15\n");
  const auto results = [](std::vector<double> values) {
    std::vector<MemberResult> list;
    for (const double value : values) {
      Comparison c;
      c.computed = value;
      list.push_back({"finished", {}, {c}, 0, 0, 0});
    }
    return list;
  };
  const auto falling = judge(study, results({1.1, 1.05, 1}));
  ASSERT_EQ(falling.size(), 2u);
  EXPECT_TRUE(falling[0].kept && falling[1].kept);
  const auto rising = judge(study, results({1, 1.1, 1.3}));
  EXPECT_FALSE(rising[0].kept || rising[1].kept);
}

}  // namespace
}  // namespace polder::study
