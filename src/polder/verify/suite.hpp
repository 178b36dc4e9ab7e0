#pragma once
// Runs verification problems and judges them by the tolerances that stand beside their cases.
#include <optional>
#include <string>
#include <vector>

#include "polder/verify/problem.hpp"

namespace polder::verify {

/// One line of the table. What has no tolerance (an observed order of convergence) is shown and not judged.
struct Row {
  std::string problem, quantity, at;
  std::optional<double> reference;
  double computed = 0;
  std::optional<double> error, tolerance;
  bool pass = true;
  double seconds = 0;  ///< of the whole problem
  std::string source;  ///< of the tolerance
};

struct Outcome {
  std::vector<Row> rows;
  std::optional<Chart> figure;
  std::string trouble;  ///< why the run ended early; empty: it did not
  bool pass() const;
};

struct SuiteOptions {
  std::vector<std::string> overrides;  ///< changes to the run, not to the exact answer
  bool orders = true;                  ///< run coarser grids, too, for the observed order of convergence
};

/// Throws std::runtime_error where the case or its tolerances are missing or wrong.
Outcome run_problem(const Problem& problem, const SuiteOptions& options);

/// nullptr where there is none of that name.
const Problem* find_problem(std::string_view name);

}  // namespace polder::verify
