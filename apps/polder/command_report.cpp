// polder report DIR: the page of a run, made again from what lies in its folder.
#include <chrono>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <thread>

#include "commands.hpp"
#include "polder/report/figures.hpp"
#include "polder/report/report.hpp"
#include "polder/result/output_error.hpp"

namespace polder::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  fs::path folder;
  bool watch = false, figures = false;
  FigureOptions drawn;
  std::string times;
};

/// "2, 6.5, 14" or "all".
void read_times(const std::string& text, FigureOptions& options) {
  options.all_times = text == "all";
  if (options.all_times) return;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const std::string word = text.substr(at, comma - at);
    char* end = nullptr;
    const double time = std::strtod(word.c_str(), &end);
    while (*end == ' ') ++end;
    if (word.empty() || *end != 0)
      throw Failure(status_wrong_input,
                    "--times: '" + word + "' is no time; give seconds, as in --times 2,6,14, or --times all");
    options.times.push_back(time);
    at = comma + 1;
  }
}

fs::file_time_type written(const fs::path& path) {
  std::error_code none;
  const fs::file_time_type time = fs::last_write_time(path, none);
  return none ? fs::file_time_type::min() : time;
}

/// Follows a run until its summary is there, and newer than its history.
void watch(const fs::path& folder) {
  constexpr double reload_seconds = 5;
  for (fs::file_time_type shown = fs::file_time_type::min();;) {
    const auto history = written(folder / "history.csv"), summary = written(folder / "summary.json");
    if (std::max(history, summary) > shown) {
      write_report(folder, {reload_seconds});
      shown = std::max(history, summary);
    }
    if (summary != fs::file_time_type::min() && summary >= history) return;
    std::this_thread::sleep_for(std::chrono::seconds(2));
  }
}

int report(const Options& options) {
  if (!fs::is_directory(options.folder))
    throw Failure(status_wrong_input, options.folder.string() + ": there is no such folder; give the --out of a run");
  try {
    if (options.figures) {
      FigureOptions drawn = options.drawn;
      read_times(options.times, drawn);
      for (const fs::path& file : write_figures(options.folder, drawn)) std::cout << file.string() << '\n';
    }
    if (options.watch) watch(options.folder);
    write_report(options.folder);
  } catch (const OutputError&) {
    throw;
  } catch (const Failure&) {
    throw;
  } catch (const std::invalid_argument& error) {
    throw Failure(status_wrong_input, error.what());
  } catch (const std::runtime_error& error) {
    throw Failure(status_wrong_input, error.what());
  }
  std::cout << (options.folder / "report.html").string() << '\n';
  return status_done;
}

}  // namespace

void add_report(CLI::App& polder, Action& action) {
  CLI::App* command =
      add_command(polder, "report", "Build the HTML report of a run again, from what it has written",
                  "polder report out/dike\n"
                  "polder report out/dike --watch\n"
                  "polder report out/dike --figures --fields porosity,pore_pressure --times 2,6,14 --formats svg");
  const auto options = std::make_shared<Options>();
  command->add_option("DIR", options->folder, "Folder of a finished or running run")->required();
  command->add_flag("--watch", options->watch, "Rewrite the page as the run goes on, until it ends");
  CLI::Option* figures =
      command->add_flag("--figures", options->figures, "Draw figures for publications into DIR/figures first");
  command->add_option("--fields", options->drawn.fields, "Fields of the figures (default: those of the run's pictures)")
      ->delimiter(',')
      ->needs(figures);
  command
      ->add_option("--times", options->times,
                   "Times of the figures, s, or all; the nearest snapshots are drawn (default: the case's pictures)")
      ->needs(figures);
  command->add_option("--formats", options->drawn.formats, "png, svg or both (default)")
      ->delimiter(',')
      ->check(CLI::IsMember({"png", "svg"}))
      ->needs(figures);
  command->callback([options, &action] { action = [options] { return report(*options); }; });
}

}  // namespace polder::cli
