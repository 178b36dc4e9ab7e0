#pragma once
// Validation: shipped cases against experiments and against the numbers that papers state. Each runs its case, answers
// the case's expected.toml from the history, and some measure more (surfaces, fronts) against data.
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polder/report/expected.hpp"
#include "polder/result/chart.hpp"
#include "polder/stage/simulation.hpp"

namespace polder::validate {

/// One quantity beside what it is held against.
struct Row {
  std::string quantity, at, unit;
  std::optional<double> reference, computed, tolerance;
  polder::Verdict verdict = polder::Verdict::shown;
  std::string words, source;  ///< a reference in words, where it is no number
};

struct Result {
  std::vector<Row> rows;
  std::optional<Chart> figure;
  double points = 0, steps = 0, seconds = 0;  ///< of the processor
  std::string trouble;                        ///< why it ended early, or what could not be compared
  bool pass() const;
};

/// Told of the state after each step of the event.
using Watch = std::function<void(const Simulation<PlaneStrain>&)>;

/// What a validation measures beyond expected.toml; it is asked before and after the run.
struct Experiment {
  Watch watch;                          ///< may be empty
  std::function<void(Result&)> finish;  ///< adds rows and the figure; may be empty
};

struct Validation {
  std::string_view name;                         ///< of the case
  std::string_view against;                      ///< whom it is compared with
  Experiment (*experiment)(const Model& model);  ///< null: expected.toml alone
};

std::span<const Validation> validations();
/// nullptr where there is none of that name.
const Validation* find_validation(std::string_view name);

Experiment porous_block(const Model& model);
Experiment water_column(const Model& model);
Experiment heave(const Model& model);

/// The folder of the measurements: the environment variable POLDER_SHARED, or a folder `shared` beside the checkout,
/// each with `data` in it. Nothing where there is none.
std::optional<std::filesystem::path> measurements();

/// Throws std::runtime_error where the case is missing or wrong.
Result run_validation(const Validation& validation, const std::vector<std::string>& overrides, int threads);

}  // namespace polder::validate
