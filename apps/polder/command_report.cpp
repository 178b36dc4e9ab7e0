// polder report DIR: the page of a run, made again from what lies in its folder.
#include <chrono>
#include <filesystem>
#include <iostream>
#include <thread>

#include "commands.hpp"
#include "polder/report/report.hpp"
#include "polder/result/output_error.hpp"
#include "polder/result/picture_files.hpp"
#include "polder/result/vtk_reader.hpp"

namespace polder::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  fs::path folder;
  bool watch = false, figures = false;
};

void draw_figures(const fs::path& folder) {
  const VtkSeries series = read_pvd(folder / "points.pvd");
  if (series.empty())
    throw Failure(status_wrong_input,
                  (folder / "points.pvd").string() + ": no snapshots to draw; 'polder run' writes them");
  for (std::size_t number = 0; 2 * number < series.size(); ++number) {
    const Frame frame = read_snapshot(folder, series, number);
    write_pictures(folder, frame, standard_pictures(frame), frame.time);
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
    if (options.figures) draw_figures(options.folder);
    if (options.watch) watch(options.folder);
    write_report(options.folder);
  } catch (const OutputError&) {
    throw;
  } catch (const Failure&) {
    throw;
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
                  "polder report out/dike\npolder report out/dike --figures\npolder report out/dike --watch");
  const auto options = std::make_shared<Options>();
  command->add_option("DIR", options->folder, "Folder of a finished or running run")->required();
  command->add_flag("--watch", options->watch, "Rewrite the page as the run goes on, until it ends");
  command->add_flag("--figures", options->figures, "Draw the pictures of all snapshots first");
  command->callback([options, &action] { action = [options] { return report(*options); }; });
}

}  // namespace polder::cli
