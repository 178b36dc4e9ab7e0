// The messages of whole files, as a user sees them: golden/NAME.toml must give golden/NAME.txt. To renew them after a
// change of wording, run with POLDER_RENEW_GOLDEN=1 and read the difference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "polder/case/reader.hpp"

namespace polder {
namespace {

namespace fs = std::filesystem;

class GoldenMessages : public testing::Test {
 protected:
  void SetUp() override { fs::current_path(fs::path(POLDER_SOURCE_DIR) / "tests/case/golden"); }
  void TearDown() override { fs::current_path(before_); }

 private:
  fs::path before_ = fs::current_path();
};

TEST_F(GoldenMessages, AreAsAgreed) {
  int files = 0, refused = 0;
  for (const auto& entry : fs::directory_iterator(".")) {
    if (entry.path().extension() != ".toml") continue;
    ++files;
    const std::string name = entry.path().filename().string();
    const Diagnostics diagnostics = read_case(name).diagnostics;
    const std::string text = format(diagnostics);
    refused += static_cast<int>(std::count_if(diagnostics.begin(), diagnostics.end(),
                                              [](const Diagnostic& d) { return d.severity == Severity::error; }));
    const fs::path golden = entry.path().stem().string() + ".txt";
    if (std::getenv("POLDER_RENEW_GOLDEN")) std::ofstream(golden) << text;
    std::ifstream file(golden);
    std::ostringstream agreed;
    agreed << file.rdbuf();
    EXPECT_EQ(text, agreed.str()) << name;
  }
  EXPECT_GE(files, 15);
  std::printf("record: refused mistakes-with-agreed-messages %d 0 in %d files\n", refused, files);
}

TEST_F(GoldenMessages, OfTheCommandLineNameTheOverride) {
  const auto message = [](const std::string& override_) {
    return format(read_case("sound.toml", {override_}).diagnostics);
  };
  EXPECT_EQ(message("model.cell=0.1 kg"),
            "--set:1:12: error: model.cell: \"0.1 kg\" is a mass; a length is needed\n"
            "    1 | model.cell=0.1 kg\n"
            "      |            ^\n"
            "      help: write a length such as \"0.05 m\", or a plain number in SI (m)\n"
            "1 error\n");
  EXPECT_EQ(message("material.clay.porosity=0.3"),
            "--set:1:1: error: material.clay.porosity: material has no entry \"clay\"\n"
            "    1 | material.clay.porosity=0.3\n"
            "      | ^\n"
            "      help: known: sand; or a number from 1 to 1\n"
            "1 error\n");
  EXPECT_NE(message("model.cell").find("is not of the form key=value"), std::string::npos);
  EXPECT_NE(message("model.cell.x=1").find("model.cell is a text, not a section"), std::string::npos);
  EXPECT_NE(message("stage.0.duration=1 s").find("stage has no entry \"0\""), std::string::npos);
}

TEST_F(GoldenMessages, NameAFileThatCannotBeRead) {
  EXPECT_EQ(format(read_case("absent.toml").diagnostics),
            "absent.toml: error: cannot be read\n      help: is the path right, and may the file be read?\n1 error\n");
  EXPECT_FALSE(read_case(".").ok());
}

}  // namespace
}  // namespace polder
