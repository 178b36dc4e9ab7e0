#pragma once
// The folder of a run: who may use it, and the checkpoints in it.
#include <filesystem>
#include <string>
#include <vector>

namespace polder {

/// Opens a folder for one run. A non-empty folder is refused unless it is to be resumed or replaced; a second run in
/// the same folder is refused as long as the first one lives (a lock that the system drops with the process).
class RunFolder {
 public:
  /// Throws FolderError, OutputError. With `replace`, what an earlier run left is removed (nothing else).
  RunFolder(const std::filesystem::path& path, bool resume, bool replace);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Keeps the last checkpoint as checkpoint.previous.h5 and writes the new one, each atomically.
  void write_checkpoint(const std::string& bytes) const;
  /// The bytes of the checkpoints, newest first.
  std::vector<std::filesystem::path> checkpoints() const;

 private:
  std::filesystem::path path_;
  int lock_ = -1;
};

std::string read_file(const std::filesystem::path& path);

}  // namespace polder
