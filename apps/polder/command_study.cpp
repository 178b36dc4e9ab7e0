// polder study STUDY: a sweep over keys of a case, its members side by side, one page.
#include <fmt/format.h>

#include <csignal>
#include <iostream>

#include "case_argument.hpp"
#include "commands.hpp"

#include "polder/case/diagnostic.hpp"
#include "polder/result/atomic_file.hpp"
#include "polder/result/output_error.hpp"
#include "polder/study/schedule.hpp"
#include "polder/study/study_page.hpp"

namespace polder::cli {

namespace {

std::atomic<bool> interrupted{false};
void interrupt(int) { interrupted = true; }

struct StudyArguments {
  std::string name, folder;
  std::vector<std::string> overrides;
  int cores = 0, threads = 1;
  bool force = false, list = false, report_only = false;
};

std::filesystem::path study_file(const std::string& name) {
  if (const auto file = study::find_study(name)) return *file;
  const std::string near = nearest(name, study::shipped_studies());
  throw Failure(status_wrong_input, fmt::format("there is no study '{}': neither a file nor a shipped one; {}", name,
                                                near.empty() ? "'polder study --list' names those"
                                                             : fmt::format("did you mean '{}'?", near)));
}

/// All members are read before anything is computed.
std::vector<study::Job> jobs_of(const study::Study& study, const StudyArguments& arguments,
                                const std::filesystem::path& folder) {
  std::vector<study::Job> jobs;
  const std::string file = find_case_file(study.case_name);
  for (const study::Member& member : study.members) {
    std::vector<std::string> overrides = member.overrides;
    overrides.insert(overrides.end(), arguments.overrides.begin(), arguments.overrides.end());
    ReadResult result = read_case(file, overrides);
    if (!result.ok()) {
      std::cerr << format(result.diagnostics);
      throw Failure(status_wrong_input, fmt::format("the member '{}' is wrong; nothing was computed", member.name));
    }
    jobs.push_back({member.name, std::move(result.model), folder / member.folder});
  }
  return jobs;
}

void print_results(const study::Study& study, const std::vector<study::MemberResult>& results) {
  std::size_t width = 8;
  for (const study::Member& member : study.members) width = std::max(width, member.name.size());
  for (std::size_t i = 0; i < results.size(); ++i) {
    fmt::print("{:<{}}", study.members[i].name, width);
    for (const Comparison& c : results[i].measures)
      fmt::print("  {} {}{}", c.expected.quantity, c.computed ? fmt::format("{:.4g}", *c.computed) : "-",
                 c.unit.empty() || !c.computed ? "" : " " + c.unit);
    fmt::print("  ({})\n", results[i].status);
  }
}

int run_study(const StudyArguments& arguments) {
  if (arguments.list) {
    for (const std::string& name : study::shipped_studies()) fmt::print("{}\n", name);
    return status_done;
  }
  if (arguments.name.empty())
    throw Failure(status_wrong_input, "which study? 'polder study --list' names those shipped");
  study::Study study;
  try {
    study = study::read_study(study_file(arguments.name));
  } catch (const std::runtime_error& error) {
    throw Failure(status_wrong_input, error.what());
  }
  const std::filesystem::path folder = arguments.folder.empty() ? std::filesystem::path("results") / study.name
                                                                : std::filesystem::path(arguments.folder);
  const std::vector<study::Job> jobs = jobs_of(study, arguments, folder);
  try {
    make_folder(folder);
    const auto write_page = [&] {
      auto results = study::read_results(study, folder);
      write_atomically(folder / "report.html", study::study_page(study, results, folder));
      return results;
    };
    bool failed = false;
    if (!arguments.report_only) {
      std::signal(SIGINT, interrupt);
      std::signal(SIGTERM, interrupt);
      study::ScheduleOptions options;
      options.cores = arguments.cores;
      options.threads = arguments.threads;
      options.force = arguments.force;
      options.version = POLDER_VERSION;
      options.interrupted = &interrupted;
      options.tell = [&](std::size_t job, const std::string& words) {
        fmt::print("{} of {}, {}: {}\n", job + 1, jobs.size(), jobs[job].name, words);
        std::fflush(stdout);
      };
      for (const study::Outcome outcome : study::run_jobs(jobs, options))
        failed = failed || outcome == study::Outcome::failed;
    }
    const auto results = write_page();
    print_results(study, results);
    bool kept = true;
    for (const study::Verdict& verdict : study::judge(study, results)) {
      fmt::print("{}: {}\n", verdict.text, verdict.kept ? "yes" : "NO");
      kept = kept && verdict.kept;
    }
    fmt::print("{}\n", (folder / "report.html").string());
    if (interrupted) return status_interrupted;
    if (failed) throw Failure(status_failed, "a member failed; see its log.txt");
    return kept ? status_done : status_outside_tolerance;
  } catch (const OutputError& error) {
    throw Failure(status_not_written, error.what());
  } catch (const std::runtime_error& error) {
    throw Failure(status_wrong_input, error.what());
  }
}

}  // namespace

void add_study(CLI::App& polder, Action& action) {
  const auto arguments = std::make_shared<StudyArguments>();
  CLI::App* command = add_command(polder, "study", "Compute a case for several values of its keys, on one page",
                                  "polder study --list\n"
                                  "polder study overtopping-cohesion --cores 2\n"
                                  "polder study my-study.toml --out results/trial     (again: it goes on)");
  command->add_option("STUDY", arguments->name, "Study file, or the name of a shipped study");
  command->add_option("--out", arguments->folder, "Folder of the results (default: results/NAME)");
  command->add_option("--cores", arguments->cores, "Cores to use (default: all)")->check(CLI::Range(1, 1024));
  command->add_option("--threads", arguments->threads, "Threads of each member")->check(CLI::Range(1, 1024));
  command->add_option("--set", arguments->overrides, "Override a key of all members: section.key=value")
      ->allow_extra_args(false);
  command->add_flag("--force", arguments->force, "Compute again what is finished");
  command->add_flag("--report", arguments->report_only, "Only write the page again from what is there");
  command->add_flag("--list", arguments->list, "Name the shipped studies");
  command->callback([=, &action] { action = [=] { return run_study(*arguments); }; });
}

}  // namespace polder::cli
