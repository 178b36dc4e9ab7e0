#pragma once
// Figures for publications, drawn from the snapshots of a run: one for each field and time, and a sheet of all of them.
// All of one field share one range of colours. The same folder gives the same bytes; no display is needed.
#include <filesystem>
#include <string>
#include <vector>

namespace polder {

struct FigureOptions {
  std::vector<std::string> fields;                 ///< empty: those of a run's pictures that the snapshots have
  std::vector<double> times;                       ///< s; the nearest snapshots are drawn
  bool all_times = false;                          ///< every snapshot
  std::vector<std::string> formats{"png", "svg"};  ///< endings
};

/// Writes `folder`/figures/FIELD_TIMEs.FORMAT and sheet.FORMAT, atomically, and returns their paths. Without times,
/// those of the case's pictures are drawn (summary.json), or five spread over the run. Throws std::invalid_argument
/// where there is no such field, std::runtime_error where there are no snapshots or one is damaged, OutputError.
std::vector<std::filesystem::path> write_figures(const std::filesystem::path& folder, const FigureOptions& options);

}  // namespace polder
