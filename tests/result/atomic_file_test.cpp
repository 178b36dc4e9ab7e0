#include "polder/result/atomic_file.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include "polder/result/output_error.hpp"
#include "temporary_folder.hpp"

using namespace polder;

TEST(AtomicFile, KilledBeforeItsRenameLeavesTheOldFile) {
  const TemporaryFolder folder;
  const auto path = folder.path / "summary.json";
  write_atomically(path, "old");
  const pid_t child = ::fork();
  if (child == 0) {
    AtomicFile file(path);
    file.write("new and only half wr");
    ::raise(SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(bytes_of(path), "old");
  write_atomically(path, "new");  // what the killed process left behind does not stand in the way
  EXPECT_EQ(bytes_of(path), "new");
}

TEST(AtomicFile, KilledAtAnyMomentIsOldOrNewButNeverBetween) {
  const TemporaryFolder folder;
  const auto path = folder.path / "points.pvd";
  const std::string old_text(100000, 'a'), new_text(100000, 'b');
  write_atomically(path, old_text);
  for (int microseconds = 0; microseconds < 3000; microseconds += 150) {
    const pid_t child = ::fork();
    if (child == 0) {
      for (;;) {
        write_atomically(path, new_text);
        write_atomically(path, old_text);
      }
    }
    ::usleep(static_cast<useconds_t>(microseconds));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const std::string found = bytes_of(path);
    EXPECT_TRUE(found == old_text || found == new_text)
        << "after " << microseconds << " µs: " << found.size() << " bytes";
  }
}

TEST(AtomicFile, ThatIsNotCommittedLeavesNothing) {
  const TemporaryFolder folder;
  { AtomicFile(folder.path / "a.png").write("x"); }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path));
}

TEST(AtomicFile, OnAFullDiskThrowsAndKeepsTheOldFile) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const TemporaryFolder folder;
  const auto path = folder.path / "history.csv";
  write_atomically(path, "old");
  std::filesystem::create_symlink("/dev/full", folder.path / ".history.csv.partial");
  try {
    write_atomically(path, std::string(1 << 20, 'x'));
    FAIL() << "no error";
  } catch (const OutputError& error) {
    EXPECT_EQ(error.path(), path.string());
    EXPECT_EQ(error.reason(), "No space left on device");
  }
  EXPECT_EQ(bytes_of(path), "old");
}
