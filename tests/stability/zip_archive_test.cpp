// Archives: what their members hold comes out; one that would fill the memory is refused.
#include "polder/stability/zip_archive.hpp"

#include <gtest/gtest.h>
#include <unistd.h>
#include <zip.h>

#include <fstream>
#include <sstream>

namespace polder::stability {
namespace {

class ZipArchive : public ::testing::Test {
 public:
  ~ZipArchive() override { std::filesystem::remove(file); }

  void write(const std::map<std::string, std::string>& members) const {
    zip_t* archive = zip_open(file.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
    ASSERT_NE(archive, nullptr);
    for (const auto& [name, text] : members)
      zip_file_add(archive, name.c_str(), zip_source_buffer(archive, text.data(), text.size(), 0), ZIP_FL_OVERWRITE);
    ASSERT_EQ(zip_close(archive), 0);
  }

  /// The message of a refusal; empty: it was read.
  std::string refusal(std::size_t most = 1u << 28) const {
    try {
      read_zip(file, most);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return {};
  }

  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("polder-archive-" + std::to_string(::getpid()) + ".zip");
};

TEST_F(ZipArchive, GivesWhatItsMembersHold) {
  const std::string large(300000, 'x');  // more than a piece
  write({{"stages/geometry_1.json", "{}"}, {"empty", ""}, {"large", large}});
  const auto members = read_zip(file);
  ASSERT_EQ(members.size(), 3u);
  EXPECT_EQ(members.at("stages/geometry_1.json"), "{}");
  EXPECT_EQ(members.at("empty"), "");
  EXPECT_EQ(members.at("large"), large);
}

TEST_F(ZipArchive, IsRefusedWhenItsMembersHoldTooMuchTogether) {
  write({{"a", std::string(60000, '\0')}, {"b", std::string(60000, '\0')}});
  EXPECT_LT(std::filesystem::file_size(file), 1000u);
  EXPECT_EQ(refusal(120000), "");
  EXPECT_NE(refusal(119999).find("holds more than 119999 bytes"), std::string::npos) << refusal(119999);
}

TEST_F(ZipArchive, DoesNotBelieveALengthThatItSays) {
  write({{"a", std::string(1000, 'a')}});
  std::ostringstream content;
  content << std::ifstream(file, std::ios::binary).rdbuf();
  std::string bytes = content.str();
  const std::size_t entry = bytes.find("PK\x01\x02");
  ASSERT_NE(entry, std::string::npos);
  bytes.replace(entry + 24, 4, "\xff\xff\xff\x7f");  // its uncompressed size: 2 GB
  std::ofstream(file, std::ios::binary) << bytes;
  const std::string said = refusal();
  EXPECT_NE(said.find("damaged"), std::string::npos) << said;
}

}  // namespace
}  // namespace polder::stability
