#pragma once
// What a summary says about a run, in the words and units of readers: the facts at the head of a report, and the audit
// by which a reviewer judges it.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace polder {

struct Fact {
  std::string label, value;
};

/// Simulated time, steps, points, cells, wall time, speed, memory; those that the summary has.
std::vector<Fact> run_facts(const nlohmann::ordered_json& summary);

struct AuditRow {
  std::string quantity;
  double value = 0;     ///< NaN: not measured
  std::string demand;   ///< what is asked of it; empty: shown for judgement only
  std::string verdict;  ///< "kept", "not kept", "not measured"; empty where nothing is asked
  std::string meaning;
};

/// Errors larger than this are no round-off: a sum over millions of points and steps stays well below.
inline constexpr double round_off = 1e-10;

/// Rows for the errors and shares that the summary has.
std::vector<AuditRow> audit(const nlohmann::ordered_json& summary);

}  // namespace polder
