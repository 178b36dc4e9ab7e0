#pragma once
// report.html: what a run did and whether one may trust it, on one page that needs no network and no script.
#include <filesystem>
#include <string>

namespace polder {

struct ReportOptions {
  double reload_seconds = 0;  ///< the page of a run that goes on asks the browser to load it again so often; 0: never
};

/// The page for a run's folder, from what lies in it: summary.json (absent while the run goes on), history.csv,
/// pictures/*.png, model.svg or pictures/model.png. Throws std::runtime_error where the folder holds neither a summary
/// nor a history, or one of them is damaged.
std::string report_page(const std::filesystem::path& folder, const ReportOptions& options = {});

/// Writes it to `folder`/report.html, atomically. Throws as report_page, and OutputError.
void write_report(const std::filesystem::path& folder, const ReportOptions& options = {});

}  // namespace polder
