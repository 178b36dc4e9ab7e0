#pragma once
// report.html: what a run did and whether one may trust it, on one page that needs no network.
#include <filesystem>
#include <string>

#include "polder/report/page.hpp"

namespace polder {

struct ReportOptions {
  double reload_seconds = 0;  ///< the page of a run that goes on loads itself again so often; 0: never
};

/// What the report of a run's folder says, from what lies in it: summary.json (absent while the run goes on),
/// history.csv, points.pvd, comparison.json (rows as `polder validate --json` writes them), model.svg. Throws
/// std::runtime_error where the folder holds neither a summary nor a history, or one of the files is damaged.
Page run_page(const std::filesystem::path& folder, const ReportOptions& options = {});

/// Writes it to `folder`/report.html, atomically. Throws as run_page, and OutputError.
void write_report(const std::filesystem::path& folder, const ReportOptions& options = {});

}  // namespace polder
