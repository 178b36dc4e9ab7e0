#include "polder/verify/validation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <stdexcept>

#include "polder/case/locate.hpp"
#include "polder/case/reader.hpp"
#include "polder/result/frame_of.hpp"
#include "polder/result/monitors.hpp"

namespace polder::validate {
namespace {

constexpr std::string_view of_liu = "Liu et al. (1999), crushed rock", of_martin = "Martin and Moyce (1952)",
                           of_columns = "Lube et al. (2005), Lajeunesse et al. (2005)",
                           of_heave = "Terzaghi's prism, exit gradient", of_p1 = "study P1", of_p2 = "study P2",
                           of_p3 = "study P3", of_p4 = "study P4";

constexpr Validation list[] = {
    {"porous-block", of_liu, porous_block},
    {"porous-block-dry", of_liu, porous_block},
    {"water-column", of_martin, water_column},
    {"water-column-small", of_martin, water_column},
    {"water-column-square", of_martin, water_column},
    {"granular-column-05", of_columns, nullptr},
    {"granular-column", of_columns, nullptr},
    {"granular-column-2", of_columns, nullptr},
    {"granular-column-4", of_columns, nullptr},
    {"excavation-onset", of_heave, heave},
    {"dike-seepage", of_p1, nullptr},
    {"pipe-leak-5kpa", of_p2, nullptr},
    {"pipe-leak-10kpa", of_p2, nullptr},
    {"pipe-leak", of_p2, nullptr},
    {"pipe-leak-paper", of_p2, nullptr},
    {"pipe-leak-15kpa", of_p2, nullptr},
    {"pipe-leak-16kpa", of_p2, nullptr},
    {"pipe-leak-inflow", of_p2, nullptr},
    {"pipe-leak-inflow-fast", of_p2, nullptr},
    {"pipe-leak-inflow-kozeny", of_p2, nullptr},
    {"pipe-leak-inflow-kozeny-fast", of_p2, nullptr},
    {"pipe-leak-head", of_p2, nullptr},
    {"overtopping-020", of_p3, nullptr},
    {"overtopping-025", of_p3, nullptr},
    {"overtopping", of_p3, nullptr},
    {"overtopping-paper", of_p3, nullptr},
    {"levee-uplift-paper", of_p4, nullptr},
};

/// The history of a run, kept in memory, and the soil's shape at both ends.
struct Recorded {
  History history;
  SoilShape first, last;
};

/// Runs to the end; what it came to before a failure is kept, and `trouble` says why.
Recorded record(Simulation<PlaneStrain>& run, const Watch& watch, std::string& trouble) {
  Recorded recorded;
  std::unique_ptr<Monitors<PlaneStrain>> monitors;
  double due = 0, dt = 0;
  const auto look = [&] {
    if (!run.finished() && run.stage()->initial) return;
    if (!monitors) {
      monitors = std::make_unique<Monitors<PlaneStrain>>(run);
      recorded.first = soil_shape(frame_of(run).soil, 1);
      recorded.history.columns = {{"time", "s"}};
      for (const HistoryColumn& column : monitors->columns()) recorded.history.columns.push_back(column);
      recorded.history.values.resize(recorded.history.columns.size());
    }
    if (watch) watch(run);
    if (run.time() < due * (1 - 1e-9) && !run.finished()) return;
    due += run.model().output.history_interval;
    recorded.history.values[0].push_back(run.time());
    const auto row = monitors->sample(run, dt);
    for (std::size_t c = 0; c < row.size(); ++c) recorded.history.values[c + 1].push_back(row[c]);
  };
  try {
    look();
    while (!run.finished()) {
      dt = run.advance().dt;
      look();
    }
  } catch (const RunFailure& failure) {
    trouble = failure.what();
  }
  recorded.last = soil_shape(frame_of(run).soil, 1);
  return recorded;
}

}  // namespace

bool Result::pass() const {
  return trouble.empty() && std::none_of(rows.begin(), rows.end(), [](const Row& row) {
           return row.verdict == Verdict::outside || row.verdict == Verdict::not_reached;
         });
}

std::span<const Validation> validations() { return list; }

const Validation* find_validation(std::string_view name) {
  for (const Validation& validation : list)
    if (validation.name == name) return &validation;
  return nullptr;
}

std::optional<std::filesystem::path> measurements() {
  std::vector<std::filesystem::path> places;
  // Nothing in this program changes the environment.
  if (const char* given = std::getenv("POLDER_SHARED"))  // NOLINT(concurrency-mt-unsafe)
    places.emplace_back(given);
  for (const auto& cases : case_folders()) places.push_back(cases.parent_path().parent_path() / "shared");
  std::error_code unreadable;
  for (const auto& place : places)
    if (std::filesystem::is_directory(place / "data", unreadable)) return place / "data";
  return {};
}

Result run_validation(const Validation& validation, const std::vector<std::string>& overrides, int threads) {
  const auto file = find_case(validation.name);
  if (!file) throw std::runtime_error(fmt::format("the case {} is not installed", validation.name));
  const ReadResult read = read_case(file->string(), overrides);
  if (!read.ok()) throw std::runtime_error(format(read.diagnostics));
  Result result;
  const std::clock_t start = std::clock();
  const Experiment experiment = validation.experiment ? validation.experiment(read.model) : Experiment{};
  Simulation<PlaneStrain> run(read.model, threads);
  const Recorded recorded = record(run, experiment.watch, result.trouble);
  result.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  result.points = static_cast<double>(run.state().soil.size() + run.state().water.size());
  result.steps = static_cast<double>(run.state().step);
  const auto expectations = read_expectations(file->parent_path() / "expected.toml");
  for (const Comparison& c : compare(expectations, recorded.history, recorded.first, recorded.last)) {
    const Expectation& e = c.expected;
    Row row{e.quantity, e.at, c.unit, e.reference, c.computed, {}, c.verdict, e.words, e.source};
    if (e.tolerance > 0) row.tolerance = e.tolerance;
    result.rows.push_back(std::move(row));
  }
  if (experiment.finish) experiment.finish(result);
  if (run.state().water.size() > 0) {
    result.rows.push_back({"overfilled cells",
                           "most of all steps, share",
                           "",
                           0.0,
                           run.audit().overfilled_most,
                           {},
                           Verdict::shown,
                           "",
                           "audit"});
    const double balance = run.audit().water_balance_error(run.state());
    result.rows.push_back({"water balance", "end, share of the water at the start", "", 0.0, balance, 1e-6,
                           balance <= 1e-6 ? Verdict::within : Verdict::outside, "", "audit"});
  }
  return result;
}

}  // namespace polder::validate
