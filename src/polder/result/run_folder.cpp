#include "polder/result/run_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

#include "polder/result/atomic_file.hpp"
#include "polder/result/output_error.hpp"
#include "polder/result/run.hpp"

namespace polder {

namespace fs = std::filesystem;

namespace {

constexpr const char* checkpoint_name = "checkpoint.h5";
constexpr const char* previous_name = "checkpoint.previous.h5";
constexpr const char* lock_name = ".lock";

bool has_results(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().filename() != lock_name) return true;
  return false;
}

void remove_results(const fs::path& folder) {
  for (const char* name :
       {"summary.json", "history.csv", "points.pvd", checkpoint_name, previous_name, "failed.h5", "report.html",
        "log.txt", "points", "pictures", "model.svg", "expected.toml", "comparison.json", "figures"}) {
    std::error_code error;
    fs::remove_all(folder / name, error);
    if (error) throw OutputError((folder / name).string(), error.message());
  }
}

}  // namespace

RunFolder::RunFolder(const fs::path& path, bool resume, bool replace) : path_(path) {
  const bool used = fs::exists(path) && has_results(path);
  if (used && !resume && !replace)
    throw FolderError(
        fmt::format("{} is not empty: add --resume to go on from its checkpoint, --force to replace its "
                    "results, or --out for another folder",
                    path.string()));
  if (resume && !fs::exists(path / checkpoint_name) && !fs::exists(path / previous_name))
    throw FolderError(fmt::format("{} has no checkpoint to resume from: run without --resume", path.string()));
  make_folder(path);
  const std::string lock = (path / lock_name).string();
  lock_ = open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (lock_ < 0) throw OutputError(lock, std::generic_category().message(errno));
  if (flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    close(lock_);
    throw FolderError(
        fmt::format("another run is writing to {}: wait for it, or choose another folder with --out", path.string()));
  }
  if (replace && !resume) remove_results(path);
}

RunFolder::~RunFolder() {
  if (lock_ >= 0) close(lock_);
}

void RunFolder::write_checkpoint(const std::string& bytes) const {
  std::error_code error;
  if (fs::exists(path_ / checkpoint_name)) {
    // a hard link keeps the old bytes under the second name while the new file takes the first
    fs::remove(path_ / previous_name, error);
    fs::create_hard_link(path_ / checkpoint_name, path_ / previous_name, error);
    if (error) write_atomically(path_ / previous_name, read_file(path_ / checkpoint_name));
  }
  write_atomically(path_ / checkpoint_name, bytes);
}

std::vector<fs::path> RunFolder::checkpoints() const {
  std::vector<fs::path> found;
  for (const char* name : {checkpoint_name, previous_name})
    if (fs::exists(path_ / name)) found.push_back(path_ / name);
  return found;
}

std::string read_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace polder
