#include "polder/verify/suite.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "polder/case/locate.hpp"
#include "polder/stage/simulation.hpp"
#include "polder/verify/expected.hpp"

namespace polder::verify {

constexpr double exact_error = 1e-5;  // below it a scheme that is exact shows the tolerance of the solver

bool Outcome::pass() const {
  return trouble.empty() && std::all_of(rows.begin(), rows.end(), [](const Row& row) { return row.pass; });
}

const Problem* find_problem(std::string_view name) {
  for (const Problem& problem : problems())
    if (problem.name == name) return &problem;
  return nullptr;
}

Outcome run_problem(const Problem& problem, const SuiteOptions& options) {
  const auto file = find_case(problem.name);
  if (!file) throw std::runtime_error(fmt::format("the case of {} is not installed", problem.name));
  const auto expected = expected_tolerances(file->parent_path() / "expected.toml");
  const auto start = std::chrono::steady_clock::now();
  Outcome outcome;
  try {
    const Findings findings = problem.solve({*file, options.overrides});
    outcome.figure = findings.figure;
    for (const Comparison& c : findings.comparisons) {
      if (!c.judged) {
        outcome.rows.push_back(
            {std::string(problem.name), c.quantity, c.at, c.reference, c.computed, c.error(), {}, true, 0, {}});
        continue;
      }
      const auto rule =
          std::find_if(expected.begin(), expected.end(), [&](const Expected& e) { return e.quantity == c.quantity; });
      if (rule == expected.end())
        throw std::logic_error(fmt::format("{}: expected.toml has no tolerance for {}", problem.name, c.quantity));
      const double error = c.error();
      outcome.rows.push_back({std::string(problem.name), c.quantity, c.at, c.reference, c.computed, error,
                              rule->tolerance, error <= rule->tolerance, 0, rule->source});
    }
    if (problem.refinement && options.orders && options.overrides.empty()) {
      const Refinement& refinement = *problem.refinement;
      const double fine = refinement.error_of(findings);
      const double coarse = refinement.error_of(problem.solve({*file, refinement.coarser}));
      Row row{
          std::string(problem.name), "observed order", std::string(refinement.quantity), {}, 0, {}, {}, true, 0, {}};
      if (std::max(fine, coarse) < exact_error) {
        row.at = fmt::format("none: {} is exact on both; error on the coarser", refinement.quantity);
        row.computed = coarse;
      } else {
        row.computed = std::log(coarse / fine) / std::log(refinement.ratio);
        row.pass = row.computed >= refinement.least;
        if (refinement.least > 0) row.at += ", at least", row.reference = row.tolerance = refinement.least;
      }
      outcome.rows.push_back(row);
    }
  } catch (const RunFailure& failure) {
    outcome.trouble = failure.what();
    outcome.rows.push_back({std::string(problem.name),
                            "run",
                            "to its end",
                            {},
                            std::numeric_limits<double>::quiet_NaN(),
                            {},
                            {},
                            false,
                            0,
                            {}});
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  for (Row& row : outcome.rows) row.seconds = seconds;
  return outcome;
}

}  // namespace polder::verify
