#include "polder/result/history.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "polder/result/output_error.hpp"
#include "temporary_folder.hpp"

using namespace polder;

namespace {
const std::vector<HistoryColumn> columns{{"crest settlement", "m"}, {"pressure, toe", "Pa"}, {"n \"max\"", ""}};

void write_rows(const std::filesystem::path& path, int rows) {
  HistoryFile history(path, columns);
  for (int i = 0; i < rows; ++i) history.append(0.1 * i, std::vector{1e-300 * i, -1.0 / 3 - i, std::nan("")});
}
}  // namespace

TEST(History, ReadsBackBitByBit) {
  const TemporaryFolder folder;
  write_rows(folder.path / "history.csv", 4);
  const History history = read_history(folder.path / "history.csv");
  ASSERT_EQ(history.columns.size(), 4u);
  EXPECT_EQ(history.columns[0].name, "time");
  EXPECT_EQ(history.columns[0].unit, "s");
  EXPECT_EQ(history.columns[2].name, "pressure, toe");
  EXPECT_EQ(history.columns[2].unit, "Pa");
  EXPECT_EQ(history.columns[3].name, "n \"max\"");
  ASSERT_EQ(history.rows(), 4u);
  EXPECT_EQ(history.values[0][3], 0.1 * 3);
  EXPECT_EQ(history.values[1][3], 1e-300 * 3);
  EXPECT_EQ(history.values[2][3], -1.0 / 3 - 3);
  EXPECT_TRUE(std::isnan(history.values[3][3]));
}

TEST(History, ResumedAfterTwoRowsIsWhatAnUninterruptedRunWrites) {
  const TemporaryFolder folder;
  write_rows(folder.path / "straight.csv", 5);
  write_rows(folder.path / "resumed.csv", 4);
  {
    HistoryFile history(folder.path / "resumed.csv", columns, 2);
    EXPECT_EQ(history.rows(), 2u);
    for (int i = 2; i < 5; ++i) history.append(0.1 * i, std::vector{1e-300 * i, -1.0 / 3 - i, std::nan("")});
  }
  EXPECT_EQ(bytes_of(folder.path / "resumed.csv"), bytes_of(folder.path / "straight.csv"));
}

TEST(History, IsNotResumedWithOtherColumnsOrTooFewRows) {
  const TemporaryFolder folder;
  write_rows(folder.path / "history.csv", 2);
  const std::string before = bytes_of(folder.path / "history.csv");
  EXPECT_THROW(HistoryFile(folder.path / "history.csv", {{"other", "m"}}, 1), OutputError);
  EXPECT_THROW(HistoryFile(folder.path / "history.csv", columns, 3), OutputError);
  EXPECT_EQ(bytes_of(folder.path / "history.csv"), before);
}

TEST(History, LeavesOutALineThatIsStillBeingWritten) {
  const TemporaryFolder folder;
  write_rows(folder.path / "history.csv", 3);
  std::ofstream(folder.path / "history.csv", std::ios::app) << "0.3,1e-";
  EXPECT_EQ(read_history(folder.path / "history.csv").rows(), 3u);
}

TEST(History, ThatIsNoTableIsRefusedWithItsLine) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "history.csv") << "time [s],a\n0,1\n1,x\n";
  try {
    read_history(folder.path / "history.csv");
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("line 3: a value is not a number"), std::string::npos) << error.what();
  }
}
