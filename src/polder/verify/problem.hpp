#pragma once
// A verification problem: a case (data, runnable like a user's) and an exact answer that the run is compared with.
#include <cmath>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polder/case/model.hpp"
#include "polder/result/chart.hpp"

namespace polder::verify {

/// One quantity at one place.
struct Comparison {
  std::string quantity, at;
  double reference = 0, computed = 0;
  double scale = 0;    ///< what the error is relative to; 0: the reference
  bool judged = true;  ///< held against a tolerance; false: reported only
  double error() const { return std::abs(computed - reference) / (scale > 0 ? scale : std::abs(reference)); }
};

struct Findings {
  std::vector<Comparison> comparisons;
  std::optional<Chart> figure;  ///< computed on exact
};

/// A case as it is shipped and as it is run: the exact answer belongs to the former, so that whatever disturbs the
/// latter shows as an error.
struct Study {
  Model shipped, run;
};

/// Where the case of a problem lies, and what to change in the run (as `--set` does).
struct Source {
  std::filesystem::path file;
  std::vector<std::string> overrides;

  /// Throws std::runtime_error with all that is wrong with the case.
  Study study() const;
};

/// The run of a problem on a coarser grid, for the observed order of convergence.
struct Refinement {
  std::string_view quantity;         ///< whose errors (rms) are compared
  std::vector<std::string> coarser;  ///< overrides
  double ratio = 2;                  ///< of the spacings
  double least = 0;                  ///< order that it has to reach; 0: reported only
  double error_of(const Findings& findings) const;
};

struct Problem {
  std::string_view name, title, theory;  ///< theory: where the exact answer comes from
  bool quick = false;                    ///< part of `--quick`
  Findings (*solve)(const Source& source);
  std::optional<Refinement> refinement{};
};

/// All problems, in the order of the table.
std::span<const Problem> problems();

// One list per file.
std::vector<Problem> rest_problems();
std::vector<Problem> dam_break_problems();
std::vector<Problem> bar_problems();
std::vector<Problem> vortex_problems();
std::vector<Problem> channel_problems();
std::vector<Problem> mandel_problems();
std::vector<Problem> footing_problems();
std::vector<Problem> cylinder_problems();
std::vector<Problem> suspension_problems();
std::vector<Problem> seepage_problems();
std::vector<Problem> sheet_pile_problems();
std::vector<Problem> element_problems();
std::vector<Problem> consolidation_problems();
std::vector<Problem> fluidisation_problems();
std::vector<Problem> wave_problems();
std::vector<Problem> far_field_problems();
std::vector<Problem> infiltration_problems();

}  // namespace polder::verify
