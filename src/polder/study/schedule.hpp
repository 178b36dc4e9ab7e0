#pragma once
// Runs the members of a study side by side, as many as the cores and the memory allow, each in a process of its own.
#include <atomic>
#include <functional>
#include <vector>

#include "polder/case/model.hpp"
#include "polder/study/study_file.hpp"

namespace polder::study {

struct Job {
  std::string name;
  Model model;
  std::filesystem::path folder;
};

struct ScheduleOptions {
  int cores = 0;       ///< 0: as many as the machine has
  int threads = 1;     ///< of each run
  double memory = 0;   ///< B that may be used; 0: what is free
  bool force = false;  ///< compute what is finished again
  std::string version;
  const std::atomic<bool>* interrupted = nullptr;
  /// Told when a member begins or ends: its number, and a sentence.
  std::function<void(std::size_t, const std::string&)> tell;
};

enum class Outcome { finished, already_there, failed, interrupted, not_started };

/// Whether the folder holds a finished run of this very model.
bool is_finished(const Job& job);

/// Bytes that a run of the model takes, about (measured: soil and water points, their page).
double memory_of(const Model& model);

/// A member that was interrupted goes on from its checkpoint; one that is finished is left alone. After an interruption
/// nothing new is started. Must be called before the process has other threads.
std::vector<Outcome> run_jobs(const std::vector<Job>& jobs, const ScheduleOptions& options);

}  // namespace polder::study
