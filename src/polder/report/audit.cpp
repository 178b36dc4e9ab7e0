#include "polder/report/audit.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "polder/result/ticks.hpp"

namespace polder {
namespace {

using Json = nlohmann::ordered_json;

bool has(const Json& summary, const char* key) { return summary.is_object() && summary.contains(key); }

double number(const Json& summary, const char* key) {
  return has(summary, key) && summary[key].is_number() ? summary[key].get<double>()
                                                       : std::numeric_limits<double>::quiet_NaN();
}

// Whole numbers with thin spaces between thousands.
std::string count_text(double value) {
  std::string digits = fmt::format("{:.0f}", value);
  for (std::size_t at = digits.size(); at > 3 && at - 3 > (value < 0 ? 1u : 0u);) {
    at -= 3;
    digits.insert(at, "\u2009");
  }
  return digits;
}

void add_demand(std::vector<AuditRow>& rows, const Json& summary, const char* key, const char* quantity,
                const char* meaning) {
  if (!has(summary, key)) return;
  const double value = number(summary, key);
  rows.push_back({quantity, value, "round-off: below 10⁻¹⁰",
                  std::isnan(value)             ? "not measured"
                  : std::abs(value) < round_off ? "kept"
                                                : "not kept",
                  meaning});
}

void add_share(std::vector<AuditRow>& rows, const Json& summary, const char* key, const char* quantity,
               const char* meaning) {
  if (has(summary, key)) rows.push_back({quantity, number(summary, key), "", "", meaning});
}

}  // namespace

std::vector<Fact> run_facts(const Json& summary) {
  std::vector<Fact> facts;
  const auto add = [&](const char* key, const char* label, auto text) {
    if (const double value = number(summary, key); !std::isnan(value)) facts.push_back({label, text(value)});
  };
  add("simulated_time", "simulated time", time_text);
  add("steps", "steps", count_text);
  add("soil_points", "soil points", count_text);
  add("water_points", "water points", count_text);
  add("cells", "cells", count_text);
  add("wall_seconds", "wall time", time_text);
  add("threads", "threads", count_text);
  add("point_steps_per_second", "point-steps per second", [](double v) { return number_text(v); });
  add("pressure_iterations_per_step", "pressure iterations per step", [](double v) { return number_text(v); });
  add("bytes_per_point", "bytes per point", count_text);
  return facts;
}

std::vector<AuditRow> audit(const Json& summary) {
  std::vector<AuditRow> rows;
  add_demand(rows, summary, "water_balance_error", "water balance error",
             "in − out − stored, relative to the water at the start");
  add_demand(rows, summary, "solid_mass_error", "solid mass error", "change of the mass of all grains, relative");
  add_share(rows, summary, "flux_balance_error", "flux balance error",
            "flux through the boundaries on the grid against what the points gained, relative");
  add_share(rows, summary, "overfilled_cells", "overfilled cells", "share of wet cells filled to more than 1.05");
  return rows;
}

}  // namespace polder
