#include "polder/study/schedule.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <map>
#include <system_error>
#include <thread>

#include "polder/case/model_json.hpp"
#include "polder/points/seed.hpp"
#include "polder/report/report.hpp"
#include "polder/result/run.hpp"
#include "polder/result/ticks.hpp"

namespace polder::study {
namespace {

// Peak of dike-seepage on three grids: 22 MB at least, 1.1 kB a point; the page of a run comes on top.
constexpr double base_memory = 60e6, memory_per_point = 2e3;

constexpr int child_finished = 0, child_failed = 3, child_interrupted = 130;

double free_memory() {
  std::ifstream file("/proc/meminfo");
  std::string key, unit;
  double value = 0;
  while (file >> key >> value && std::getline(file, unit))
    if (key == "MemAvailable:") return value * 1024;
  return 1e9;
}

bool has_checkpoint(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / "checkpoint.h5") ||
         std::filesystem::exists(folder / "checkpoint.previous.h5");
}

/// In the child: runs the member and never returns.
[[noreturn]] void run_child(const Job& job, const ScheduleOptions& options) {
  int status = child_failed;
  try {
    RunOptions run;
    run.folder = job.folder;
    run.threads = options.threads;
    run.quiet = true;
    run.version = options.version;
    run.interrupted = options.interrupted;
    run.resume = !options.force && has_checkpoint(job.folder);
    run.force = !run.resume;
    Summary summary;
    try {
      summary = run_case(job.model, run);
    } catch (const FolderError&) {
      if (!run.resume) throw;
      run.resume = false;  // the checkpoint belongs to another state of the case
      run.force = true;
      summary = run_case(job.model, run);
    }
    if (summary.status == RunStatus::finished) {
      write_report(job.folder);
      status = child_finished;
    } else {
      status = summary.status == RunStatus::interrupted ? child_interrupted : child_failed;
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "polder: %s: %s\n", job.name.c_str(), error.what());
  }
  std::fflush(nullptr);
  _exit(status);
}

}  // namespace

bool is_finished(const Job& job) {
  if (!std::filesystem::exists(job.folder / "summary.json")) return false;
  try {
    const auto summary = read_json(job.folder / "summary.json");
    return summary.value("status", "") == "finished" && summary.contains("case") &&
           summary["case"].dump() == case_json(job.model).dump();
  } catch (const std::exception&) {
    return false;
  }
}

double memory_of(const Model& model) {
  const PointCount points = count_points(model);
  return base_memory + memory_per_point * static_cast<double>(points.soil + points.water);
}

std::vector<Outcome> run_jobs(const std::vector<Job>& jobs, const ScheduleOptions& options) {
  std::vector<Outcome> outcomes(jobs.size(), Outcome::not_started);
  const int cores =
      options.cores > 0 ? options.cores : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const std::size_t places = static_cast<std::size_t>(std::max(1, cores / std::max(1, options.threads)));
  const double memory = options.memory > 0 ? options.memory : 0.8 * free_memory();
  struct Running {
    std::size_t job;
    double memory;
    std::chrono::steady_clock::time_point start;
  };
  std::map<pid_t, Running> running;
  double used = 0;
  const auto tell = [&](std::size_t job, const std::string& words) {
    if (options.tell) options.tell(job, words);
  };
  const auto stopped = [&] { return options.interrupted && options.interrupted->load(); };
  std::size_t next = 0;
  while (true) {
    while (next < jobs.size() && running.size() < places && !stopped()) {
      const Job& job = jobs[next];
      if (!options.force && is_finished(job)) {
        outcomes[next] = Outcome::already_there;
        tell(next++, "is there already");
        continue;
      }
      const double need = memory_of(job.model);
      if (!running.empty() && used + need > memory) break;  // one run at least, whatever it takes
      tell(next, has_checkpoint(job.folder) && !options.force ? "goes on" : "begins");
      std::fflush(nullptr);
      const pid_t child = fork();
      if (child == 0) run_child(job, options);
      if (child < 0) {
        if (running.empty())
          throw std::runtime_error("no process could be started: " + std::generic_category().message(errno));
        break;
      }
      running[child] = {next++, need, std::chrono::steady_clock::now()};
      used += need;
    }
    if (running.empty()) break;
    int status = 0;
    const pid_t ended = waitpid(-1, &status, 0);
    const auto found = running.find(ended);
    if (found == running.end()) continue;  // interrupted by a signal: the children have it, too
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - found->second.start).count();
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : child_failed;
    outcomes[found->second.job] = code == child_finished      ? Outcome::finished
                                  : code == child_interrupted ? Outcome::interrupted
                                                              : Outcome::failed;
    tell(found->second.job, code == child_finished      ? fmt::format("finished in {}", time_text(seconds))
                            : code == child_interrupted ? "interrupted; a checkpoint is written"
                                                        : "FAILED; see log.txt in its folder");
    used -= found->second.memory;
    running.erase(found);
  }
  return outcomes;
}

}  // namespace polder::study
