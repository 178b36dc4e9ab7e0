// polder run: a case from its file to results in a folder.
#include <fmt/format.h>

#include <csignal>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "case_argument.hpp"
#include "commands.hpp"

#include "polder/report/report.hpp"
#include "polder/result/output_error.hpp"
#include "polder/result/run.hpp"

namespace polder::cli {

namespace {

std::atomic<bool> interrupted{false};
void interrupt(int) { interrupted = true; }

struct RunArguments {
  std::string case_name, folder;
  std::vector<std::string> overrides;
  double until = 0;
  int threads = 0;
  bool resume = false, force = false, quiet = false, json = false;
};

/// Of what a run writes, for the last line on the screen.
std::string what_is_in(const std::filesystem::path& folder) {
  std::vector<std::string> there;
  for (const char* name : {"report.html", "pictures/", "history.csv", "points.pvd", "failed.h5", "summary.json"})
    if (std::filesystem::exists(folder / name)) there.emplace_back(name);
  return fmt::format("{}", fmt::join(there, ", "));
}

int run(const RunArguments& arguments, bool has_until) {
  const Model model = read_case_or_fail(arguments.case_name, arguments.overrides);
  RunOptions options;
  const std::filesystem::path usual = std::filesystem::path("results") / model.name;
  options.folder = arguments.folder.empty() ? usual : std::filesystem::path(arguments.folder);
  options.threads = arguments.threads;
  if (has_until) options.until = arguments.until;
  options.resume = arguments.resume;
  options.force = arguments.force;
  options.quiet = arguments.quiet || arguments.json;
  options.version = POLDER_VERSION;
  options.interrupted = &interrupted;
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  try {
    const Summary summary = run_case(model, options);
    if (summary.status != RunStatus::failed) write_report(options.folder);
    if (arguments.json)
      std::cout << summary_json(summary).dump(2) << "\n";
    else if (!arguments.quiet)
      fmt::print("{}results in {}: {}\n", summary.status == RunStatus::failed ? "" : summary.reason + "\n",
                 options.folder.string(), what_is_in(options.folder));
    if (summary.status == RunStatus::interrupted) return status_interrupted;
    if (summary.status == RunStatus::failed) throw Failure(status_failed, summary.reason);
    return status_done;
  } catch (const FolderError& error) {
    throw Failure(status_wrong_input, error.what());
  } catch (const OutputError& error) {
    throw Failure(status_not_written, error.what());
  }
}

}  // namespace

void add_run(CLI::App& polder, Action& action) {
  const auto arguments = std::make_shared<RunArguments>();
  CLI::App* command = add_command(polder, "run", "Run a case: history, snapshots, pictures, report.",
                                  "polder run dike-seepage\n"
                                  "polder run my-dike.toml --out results/trial --until 5 --threads 2\n"
                                  "polder run dike-seepage --set \"model.cell=0.025 m\" --force\n"
                                  "polder run dike-seepage --resume");
  command->add_option("CASE", arguments->case_name, "Case file, or the name of a shipped case")->required();
  command->add_option("--out", arguments->folder, "Folder of the results (default: results/NAME)");
  CLI::Option* until = command->add_option("--until", arguments->until, "Stop at this time, s");
  command->add_option("--threads", arguments->threads, "Threads (default: all)")->check(CLI::Range(1, 1024));
  command->add_option("--set", arguments->overrides, "Override a key of the case: section.key=value")
      ->allow_extra_args(false);
  command->add_flag("--resume", arguments->resume, "Go on from the folder's checkpoint");
  command->add_flag("--force", arguments->force, "Replace the results in the folder");
  command->add_flag("--quiet", arguments->quiet, "No progress line");
  command->add_flag("--json", arguments->json, "Print summary.json on standard output");
  command->callback([=, &action] { action = [=] { return run(*arguments, until->count() > 0); }; });
}

}  // namespace polder::cli
