#include "polder/case/locate.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace fs = std::filesystem;

namespace {

/// Two case folders in a folder of their own that is gone after the test.
class CaseFolders : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    root_ = fs::temp_directory_path() / (std::string("polder-") + info->name() + "-" + std::to_string(getpid()));
    add("near/dike");
    add("near/pipe");
    add("far/dike");
    add("far/bench");
    fs::create_directories(root_ / "far/notes");  // no case.toml: not a case
    folders_ = {root_ / "near", root_ / "far"};
  }
  void TearDown() override { fs::remove_all(root_); }

  void add(const std::string& folder) {
    fs::create_directories(root_ / folder);
    std::ofstream(root_ / folder / "case.toml") << "[model]\n";
  }

  fs::path root_;
  std::vector<fs::path> folders_;
};

}  // namespace

TEST_F(CaseFolders, GiveACaseByItsNameNearestFirst) {
  EXPECT_EQ(polder::find_case("dike", folders_), root_ / "near/dike/case.toml");
  EXPECT_EQ(polder::find_case("bench", folders_), root_ / "far/bench/case.toml");
}

TEST_F(CaseFolders, GiveAFileOrAFolderByItsPath) {
  EXPECT_EQ(polder::find_case((root_ / "far/dike/case.toml").string(), {}), root_ / "far/dike/case.toml");
  EXPECT_EQ(polder::find_case((root_ / "far/dike").string(), {}), root_ / "far/dike/case.toml");
}

TEST_F(CaseFolders, GiveTheCasesOfVerificationByNameWithoutListingThem) {
  add("far/verify/terzaghi");
  EXPECT_EQ(polder::find_case("terzaghi", folders_), root_ / "far/verify/terzaghi/case.toml");
  EXPECT_EQ(polder::shipped_cases(folders_).size(), 3u);
}

TEST_F(CaseFolders, GiveNothingForWhatIsNoCase) {
  for (const char* name : {"", ".", "..", "notes", "no-such-case", "../near/pipe", "dike/", "case.toml"})
    EXPECT_EQ(polder::find_case(name, folders_), std::nullopt) << name;
}

TEST_F(CaseFolders, ListEachNameOnceSorted) {
  const auto cases = polder::shipped_cases(folders_);
  ASSERT_EQ(cases.size(), 3u);
  EXPECT_EQ(cases[0].name, "bench");
  EXPECT_EQ(cases[1].name, "dike");
  EXPECT_EQ(cases[1].file, root_ / "near/dike/case.toml");
  EXPECT_EQ(cases[2].name, "pipe");
}

TEST_F(CaseFolders, ThatDoNotExistHoldNoCases) {
  const std::vector<fs::path> missing{root_ / "gone"};
  EXPECT_TRUE(polder::shipped_cases(missing).empty());
  EXPECT_EQ(polder::find_case("dike", missing), std::nullopt);
}
