#include "polder/report/expected.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "polder/math/units.hpp"

namespace polder {
namespace {

std::string place_of(const std::filesystem::path& file, const toml::node& node) {
  return fmt::format("{}:{}", file.string(), node.source().begin.line);
}

double seconds(const toml::node& node, const std::filesystem::path& file) {
  if (const auto number = node.value<double>()) return *number;
  const Measured time = read_measure(node.value_or(std::string()), *find_quantity("time"));
  if (!time.ok()) throw std::runtime_error(fmt::format("{}: time: {}", place_of(file, node), time.error));
  return time.value;
}

Expectation expectation(const toml::table& entry, bool judged, const std::filesystem::path& file) {
  const auto wrong = [&](const char* what) {
    return std::runtime_error(fmt::format("{}: a [[{}]] {}", place_of(file, entry), judged ? "compare" : "show", what));
  };
  const auto text = [&](const char* key) { return entry[key].value_or(std::string()); };
  Expectation e;
  e.quantity = text("quantity");
  e.at = text("at");
  e.source = text("source");
  e.monitor = text("monitor");
  e.result = text("result");
  if (e.quantity.empty()) throw wrong("needs a quantity");
  if (!e.monitor.empty() && !e.result.empty()) throw wrong("has a monitor or a result, not both");
  if (const toml::node* time = entry.get("time")) e.time = seconds(*time, file);
  if (entry["largest"].value_or(false)) e.take = Expectation::Take::largest;
  if (entry["smallest"].value_or(false)) e.take = Expectation::Take::smallest;
  if (const auto value = entry["reaches"].value<double>()) {
    e.take = Expectation::Take::time_of;
    e.reaches = *value;
  }
  if (e.monitor.empty() && (e.time || e.take != Expectation::Take::value))
    throw wrong("with time, largest, smallest or reaches needs a monitor, a column of history.csv");
  e.words = text("reference");
  e.reference = entry["reference"].value<double>();
  e.tolerance = entry["tolerance"].value_or(0.0);
  if (judged && (!e.reference || e.tolerance <= 0))
    throw wrong("needs a reference and a tolerance, both plain numbers in SI");
  if (!judged && !e.reference && e.words.empty()) throw wrong("needs a reference");
  return e;
}

/// Linear between rows; absent outside of them (beyond round-off).
std::optional<double> value_at(const std::vector<double>& times, const std::vector<double>& values, double time) {
  const double slack = 1e-6 * std::max(1.0, std::abs(time));
  if (times.empty() || time < times.front() - slack || time > times.back() + slack) return {};
  const auto after = std::lower_bound(times.begin(), times.end(), time);
  if (after == times.begin()) return values.front();
  if (after == times.end()) return values.back();
  const auto k = static_cast<std::size_t>(after - times.begin());
  const double share = (time - times[k - 1]) / (times[k] - times[k - 1]);
  return values[k - 1] + share * (values[k] - values[k - 1]);
}

/// When the course first reaches `level`, from whichever side it starts.
std::optional<double> time_of(const std::vector<double>& times, const std::vector<double>& values, double level) {
  if (values.empty()) return {};
  const double side = values.front() <= level ? 1 : -1;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (side * (values[k] - level) < 0) continue;
    if (k == 0) return times.front();
    return times[k - 1] + (level - values[k - 1]) / (values[k] - values[k - 1]) * (times[k] - times[k - 1]);
  }
  return {};
}

std::optional<double> from_history(const Expectation& e, const History& history, std::size_t column) {
  const std::vector<double>&times = history.values[0], &values = history.values[column];
  if (e.take == Expectation::Take::time_of) return time_of(times, values, e.reaches);
  if (values.empty()) return {};
  if (e.take == Expectation::Take::value) return e.time ? value_at(times, values, *e.time) : values.back();
  if (e.time && !value_at(times, values, *e.time)) return {};
  const auto end = e.time ? std::upper_bound(times.begin(), times.end(), *e.time * (1 + 1e-9)) : times.end();
  const auto stop = values.begin() + (end - times.begin());
  return e.take == Expectation::Take::largest ? *std::max_element(values.begin(), stop)
                                              : *std::min_element(values.begin(), stop);
}

void answer(Comparison& c, const History& history, const SoilShape& first, const SoilShape& last) {
  const Expectation& e = c.expected;
  c.verdict = Verdict::not_reached;
  if (!e.monitor.empty()) {
    if (history.columns.empty()) return;
    const auto found = std::find_if(history.columns.begin(), history.columns.end(),
                                    [&](const HistoryColumn& column) { return column.name == e.monitor; });
    if (found == history.columns.end())
      throw std::runtime_error(
          fmt::format("expected.toml: '{}' asks for the monitor '{}', which history.csv does not have: name a column "
                      "of it, without its unit",
                      e.quantity, e.monitor));
    c.unit = e.take == Expectation::Take::time_of ? "s" : found->unit;
    c.computed = from_history(e, history, static_cast<std::size_t>(found - history.columns.begin()));
  } else {
    c.unit = "m";
    if (e.result == "residual crest height") {
      if (last.any) c.computed = last.crest;
    } else if (e.result == "run-out") {
      if (first.any && last.any) c.computed = run_out(first, last);
    } else if (e.result == "largest displacement") {
      if (last.any) c.computed = last.moved;
    } else {
      throw std::runtime_error(
          fmt::format("expected.toml: '{}' asks for the result '{}'; there are: residual crest height, run-out, "
                      "largest displacement",
                      e.quantity, e.result));
    }
  }
}

}  // namespace

std::vector<Expectation> read_expectations(const std::filesystem::path& file) {
  std::vector<Expectation> expectations;
  if (!std::filesystem::exists(file)) return expectations;
  toml::table table;
  try {
    table = toml::parse_file(file.string());
  } catch (const toml::parse_error& error) {
    throw std::runtime_error(fmt::format("{}:{}: {}", file.string(), error.source().begin.line, error.description()));
  }
  for (const bool judged : {true, false})
    if (const toml::array* entries = table[judged ? "compare" : "show"].as_array())
      for (const toml::node& node : *entries)
        if (const toml::table* entry = node.as_table()) expectations.push_back(expectation(*entry, judged, file));
  return expectations;
}

std::vector<Comparison> compare(const std::vector<Expectation>& expectations, const History& history,
                                const SoilShape& first, const SoilShape& last) {
  std::vector<Comparison> comparisons;
  for (const Expectation& e : expectations) {
    Comparison c{e, "", {}, Verdict::other_runs};
    if (!e.monitor.empty() || !e.result.empty()) answer(c, history, first, last);
    const bool judged = e.tolerance > 0 && e.reference;
    if (c.computed)
      c.verdict = !judged                                               ? Verdict::shown
                  : std::abs(*c.computed - *e.reference) <= e.tolerance ? Verdict::within
                                                                        : Verdict::outside;
    else if (!judged && c.verdict == Verdict::other_runs)
      c.verdict = Verdict::shown;
    comparisons.push_back(c);
  }
  return comparisons;
}

}  // namespace polder
