#include "polder/stability/assessment_json.hpp"

#include <cmath>

namespace polder::stability {
namespace {

using Json = nlohmann::ordered_json;

constexpr double degree = 57.29577951308232;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json slices_json(const Slices& slices) {
  Json list = Json::array();
  for (const Slice& s : slices.list)
    list.push_back({{"x_left", s.left},
                    {"x_right", s.right},
                    {"base_left", s.base_left},
                    {"base_right", s.base_right},
                    {"top_left", s.top_left},
                    {"top_right", s.top_right},
                    {"angle_deg", s.angle * degree},
                    {"weight", s.weight},
                    {"load", s.load},
                    {"free_water", s.free_water},
                    {"pore_pressure", s.pore_pressure},
                    {"effective_stress", s.effective_stress},
                    {"cohesion", s.cohesion},
                    {"tan_friction", s.tan_friction},
                    {"layer", s.layer}});
  return list;
}

Json factor_json(const std::string& name, const Factor& row, const AssessmentDetails& details) {
  Json entry{{"case", name}, {"method", row.label}};
  const bool found = static_cast<bool>(row.outcome);
  entry["factor_of_safety"] = found ? number(row.factor) : Json();
  entry["reference"] = row.expected ? Json(row.expected->reference) : Json();
  entry["tolerance"] = row.expected ? Json(row.expected->tolerance) : Json();
  entry["pass"] = row.pass();
  entry["seconds"] = row.seconds;
  entry["water"] = row.water;
  entry["strengths"] = row.strengths == Strengths::given            ? "given"
                       : row.strengths == Strengths::characteristic ? "characteristic"
                                                                    : "design";
  entry["surface"] = found ? Json(row.outcome.remark) : Json();
  if (!found) entry["problem"] = row.outcome.problem;
  if (details.slices && row.outcome.search && *row.outcome.search)
    entry["slices"] = slices_json(row.outcome.search->slices);
  if (details.contours && row.outcome.search) {
    entry["contours"] = Json::array();
    for (const CentreFactor& c : row.outcome.search->contours)
      entry["contours"].push_back({{"x", c.centre[0]}, {"y", c.centre[1]}, {"factor_of_safety", c.factor}});
  }
  if (details.curve && row.outcome.reduction) {
    entry["curve"] = Json::array();
    for (const auto& p : row.outcome.reduction->result.curve)
      entry["curve"].push_back(
          {{"factor", p.factor}, {"displacement", p.displacement}, {"in_equilibrium", p.converged && !p.runs_away}});
  }
  return entry;
}

Json check_json(const std::string& name, const DikeCheck& check) {
  Json entry{{"case", name}, {"method", check.label}};
  entry["factor_of_safety"] = check.problem.empty() ? number(check.factor) : Json();
  entry["reference"] = check.expected ? Json(check.expected->reference) : Json();
  entry["tolerance"] = check.expected ? Json(check.expected->tolerance) : Json();
  entry["pass"] = check.pass();
  entry["water"] = check.water;
  entry["remark"] = check.remark;
  if (!check.problem.empty()) entry["problem"] = check.problem;
  return entry;
}

}  // namespace

Json assessment_json(const Assessment& assessment, const AssessmentDetails& details) {
  Json list = Json::array();
  for (const Factor& row : assessment.factors) list.push_back(factor_json(assessment.name, row, details));
  for (const DikeCheck& check : assessment.checks) list.push_back(check_json(assessment.name, check));
  for (const Probability& p : assessment.probabilities) {
    const Reliability& r = p.reliability;
    Json entry{{"case", assessment.name},
               {"method", p.method + " (" + p.kind + ")"},
               {"reliability_index", number(r.index)},
               {"probability_of_failure", number(r.probability)},
               {"standard_error", p.kind == "FORM" ? Json() : number(r.deviation)},
               {"evaluations", r.evaluations},
               {"converged", r.converged},
               {"seconds", p.seconds}};
    for (std::size_t i = 0; i < r.influence.size(); ++i) {
      entry["influence of " + p.uncertain[i]] = number(r.influence[i]);
      entry["design point of " + p.uncertain[i]] = number(r.design_point[i]);
    }
    list.push_back(entry);
  }
  return list;
}

}  // namespace polder::stability
