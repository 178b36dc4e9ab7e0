#include "polder/report/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "polder/result/ticks.hpp"

namespace polder {
namespace {

const char* words(Verdict verdict) {
  switch (verdict) {
    case Verdict::within:
      return "within";
    case Verdict::outside:
      return "outside";
    case Verdict::shown:
      return "not judged";
    case Verdict::other_runs:
      return "takes other runs too";
    case Verdict::not_reached:
      return "not reached";
  }
  throw std::logic_error("report: unknown verdict");
}

PageCell::State state_of(Verdict verdict) {
  if (verdict == Verdict::within) return PageCell::State::pass;
  return verdict == Verdict::outside || verdict == Verdict::not_reached ? PageCell::State::fail : PageCell::State::none;
}

std::string with_unit(double value, const DisplayUnit& unit) {
  std::string name = unit.name;
  if (name == "m2") name = "m²";
  if (name == "m3") name = "m³";
  return number_text(value / unit.factor) + (name.empty() ? "" : "\u202f" + name);
}

}  // namespace

PageTable comparison_table(const std::vector<Comparison>& comparisons) {
  PageTable table{"comparison",
                  "Comparison",
                  "What this case is held against, from its expected.toml.",
                  {"Quantity", "At", "Computed", "Reference", "Tolerance", "Verdict", "Source"},
                  {false, false, true, true, true, false, false},
                  {}};
  for (const Comparison& c : comparisons) {
    const Expectation& e = c.expected;
    const DisplayUnit unit =
        display_unit(c.unit, std::max(std::abs(c.computed.value_or(0)), std::abs(e.reference.value_or(0))));
    table.rows.push_back({{e.quantity},
                          {e.at},
                          {c.computed ? with_unit(*c.computed, unit) : "–"},
                          {e.reference ? with_unit(*e.reference, unit) : e.words},
                          {e.tolerance > 0 ? "±\u202f" + with_unit(e.tolerance, unit) : "–"},
                          {words(c.verdict), state_of(c.verdict)},
                          {e.source}});
  }
  return table;
}

std::optional<PageFact> comparison_fact(const std::vector<Comparison>& comparisons) {
  const auto number = [&](auto... verdicts) {
    return std::count_if(comparisons.begin(), comparisons.end(),
                         [&](const Comparison& c) { return ((c.verdict == verdicts) || ...); });
  };
  const auto judged = number(Verdict::within, Verdict::outside, Verdict::not_reached);
  if (judged == 0) return {};
  return PageFact{"Comparison", fmt::format("{} of {}", number(Verdict::within), judged), "",
                  "within tolerance of expected.toml"};
}

}  // namespace polder
