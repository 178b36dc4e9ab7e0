#include "polder/study/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "polder/report/run_points.hpp"
#include "polder/result/summary.hpp"
#include "polder/result/vtk_reader.hpp"

namespace polder::study {
namespace {

/// Shapes of the soil at both ends of the run, read only if a measure asks for them.
std::pair<SoilShape, SoilShape> shapes_of(const std::filesystem::path& folder) {
  const RunPoints points = read_run_points(folder, {}, {1, 1, 2});
  return {points.first, points.last};
}

}  // namespace

std::vector<MemberResult> read_results(const Study& study, const std::filesystem::path& folder) {
  std::vector<MemberResult> results;
  for (const Member& member : study.members) {
    MemberResult result{"not computed", {}, {}, 0, 0, 0};
    const auto place = folder / member.folder;
    if (std::filesystem::exists(place / "summary.json")) {
      const auto summary = read_json(place / "summary.json");
      const auto number = [&](const char* key) {
        return summary.contains(key) && summary[key].is_number() ? summary[key].get<double>() : 0.0;
      };
      result.status = summary.value("status", "");
      result.points = number("soil_points") + number("water_points");
      result.steps = number("steps");
      result.seconds = number("wall_seconds");
    }
    if (std::filesystem::exists(place / "history.csv")) {
      result.history = read_history(place / "history.csv");
      std::vector<Expectation> asked;
      bool shape = false;
      for (const Measure& measure : study.measures) {
        asked.push_back(measure.what);
        shape = shape || !measure.what.result.empty();
      }
      const auto [first, last] = shape ? shapes_of(place) : std::pair<SoilShape, SoilShape>{};
      result.measures = compare(asked, result.history, first, last);
    }
    results.push_back(std::move(result));
  }
  return results;
}

std::vector<Verdict> judge(const Study& study, const std::vector<MemberResult>& results) {
  std::vector<Verdict> verdicts;
  for (std::size_t m = 0; m < study.measures.size(); ++m) {
    const Measure& measure = study.measures[m];
    std::vector<double> values;
    for (const MemberResult& result : results)
      if (m < result.measures.size() && result.measures[m].computed) values.push_back(*result.measures[m].computed);
    const bool whole = values.size() == results.size();
    if (measure.trend != Trend::none) {
      bool kept = whole;
      for (std::size_t i = 1; i < values.size(); ++i)
        kept = kept && (measure.trend == Trend::rises ? values[i] > values[i - 1] : values[i] < values[i - 1]);
      verdicts.push_back({fmt::format("{} {} from member to member", measure.what.quantity,
                                      measure.trend == Trend::rises ? "rises" : "falls"),
                          kept});
    }
    if (measure.within) {
      double most = 0;
      for (const double value : values)
        most = std::max(most, std::abs(value - values.back()) / std::abs(values.back()));
      verdicts.push_back({fmt::format("{}: all within {:g} % of the last ({:.1f} % at most)", measure.what.quantity,
                                      100 * *measure.within, 100 * most),
                          whole && most <= *measure.within});
    }
  }
  return verdicts;
}

}  // namespace polder::study
