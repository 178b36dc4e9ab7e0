#pragma once
// A case run into a folder: history, snapshots, pictures, checkpoints, summary, log, and a progress line.
#include <atomic>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "polder/case/model.hpp"
#include "polder/result/summary.hpp"

namespace polder {

struct RunOptions {
  std::filesystem::path folder;
  int threads = 0;              ///< 0: as many as the machine has
  std::optional<double> until;  ///< s; stop there instead of at the end of the last stage
  bool resume = false;          ///< go on from the folder's checkpoint
  bool force = false;           ///< replace what a run left in the folder
  bool quiet = false;           ///< no progress line
  std::string version;
  const std::atomic<bool>* interrupted = nullptr;  ///< set from outside (a signal): write a checkpoint and stop
};

/// The folder cannot be used as it is: what the user can do.
struct FolderError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What makes a case the same one, wherever its file lies: a checkpoint keeps it.
std::string case_identity(const Model& model);

/// Runs the case and returns its summary, which is also written. Throws FolderError before anything is written, and
/// OutputError; a run that fails numerically returns with status `failed`.
Summary run_case(const Model& model, const RunOptions& options);

}  // namespace polder
