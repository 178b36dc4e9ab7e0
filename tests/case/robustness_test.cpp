// Whatever is in a file, reading it ends with a model or with messages.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "polder/case/reader.hpp"

namespace polder {
namespace {

namespace fs = std::filesystem;

TEST(ReadCase, SurvivesDamagedFiles) {
  std::ostringstream sound;
  sound << std::ifstream(fs::path(POLDER_SOURCE_DIR) / "tests/case/golden/sound.toml").rdbuf();
  const fs::path file = fs::temp_directory_path() / ("polder-damaged-" + std::to_string(getpid()) + ".toml");
  const unsigned seed = 4711;
  std::mt19937 random(seed);
  const std::string pieces[] = {"\"",  "[",      "]",      "[[", "=",    "\n",   "nan",
                                "inf", "-1e308", "1e-308", "{}", "true", "\xff", "base = \"x\"\n"};
  int sound_ones = 0;
  for (int i = 0; i < 1500; ++i) {
    std::string text = sound.str();
    const int damages = 1 + static_cast<int>(random() % 3);
    for (int k = 0; k < damages; ++k) {
      const std::size_t at = random() % text.size(), length = random() % 8;
      text.replace(at, std::min(length, text.size() - at), pieces[random() % std::size(pieces)]);
    }
    std::ofstream(file) << text;
    ReadResult result;
    ASSERT_NO_THROW(result = read_case(file.string())) << "seed " << seed << ", file " << i << ":\n" << text;
    sound_ones += result.ok();
    for (const Diagnostic& d : result.diagnostics) EXPECT_FALSE(d.message.empty());
  }
  fs::remove(file);
  EXPECT_GT(sound_ones, 10) << "the damage should leave some files sound";
  EXPECT_LT(sound_ones, 1000);
  std::printf("record: refused case-file-damaged-at-random %d 0 of 1500\n", 1500 - sound_ones);
}

TEST(ReadCase, SurvivesPathsThatCannotBe) {
  const fs::path file = fs::temp_directory_path() / ("polder-path-" + std::to_string(getpid()) + ".toml");
  for (const std::string& name : {std::string(10000, 'x'), std::string("\\u0000"), std::string(), std::string(".")}) {
    std::ofstream(file) << "base = \"" << name << "\"\n";
    ReadResult result;
    ASSERT_NO_THROW(result = read_case(file.string())) << name.substr(0, 20);
    EXPECT_FALSE(result.ok());
  }
  fs::remove(file);
  EXPECT_FALSE(read_case(std::string(10000, 'x')).ok());
}

}  // namespace
}  // namespace polder
