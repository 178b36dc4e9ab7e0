#include "polder/stability/assessment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "polder/stability/check_section.hpp"

namespace polder::stability {
namespace {

bool has_factors(const PartialFactors& f) {
  return f.cohesion != 1 || f.tan_friction != 1 || f.undrained != 1 || f.load != 1 || f.model != 1;
}

class Clock {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// The section as it was before `prepare`, which takes the daily state out of it.
Section whole(const PreparedSection& prepared) {
  Section section = prepared.section;
  for (const PreparedSection& before : prepared.before) section.before.push_back(before.section);
  return section;
}

// Least factors over 21 × 21 centres around the critical one, 20 tangents each.
void add_contours(const PreparedSection& prepared, SearchResult& found) {
  if (!found || found.surface.kind != SurfaceKind::circle) return;
  const Circle& circle = found.surface.circle;
  constexpr int half = 10, tangents = 20;
  CircleGrid grid;
  const double reach = 0.8 * circle.radius;
  grid.spacing_x = grid.spacing_z = reach / half;
  grid.corner = {circle.centre[0] - reach, circle.centre[1] - reach};
  grid.count_x = grid.count_z = 2 * half + 1;
  const double deepest = circle.centre[1] - circle.radius, depth = 0.3 * circle.radius;
  grid.tangent = deepest - depth;
  grid.tangent_spacing = 2 * depth / tangents;
  grid.tangents = tangents + 1;
  SearchOptions options;
  options.refine = false;
  found.contours =
      critical_circle(
          prepared, [](const Slices& s, const SlipSurface& on) { return bishop(s, on.circle); }, grid, options)
          .contours;
}

Probability probability(const Study& study, const StudySection& on, const StabilityMethod& method, bool by_form,
                        int samples) {
  const std::vector<Uncertainty> uncertain = uncertainties(study.model, study.input);
  if (uncertain.empty())
    throw std::invalid_argument(
        "nothing is uncertain; give strength.variation of a material or stability.head_deviation");
  if (!on.prepared.section.pressures.empty())
    for (const Uncertainty& u : uncertain)
      if (u.soil < 0)
        throw std::invalid_argument(
            "stability.head_deviation raises the heads of the water net; pressures from seepage do not follow it: "
            "leave it out, or set stability.pressures to \"water-net\"");
  const FactorOf factor = [&](const Section& section) {
    const Outcome outcome = method.run(study, prepare(section));
    return outcome ? outcome.factor : std::nan("");
  };
  const Clock clock;
  Probability result{std::string(method.name), by_form ? "FORM" : "Monte Carlo", {}, {}, 0};
  for (const Uncertainty& u : uncertain) result.uncertain.push_back(u.name);
  result.reliability = by_form ? form(whole(on.prepared), uncertain, factor)
                               : monte_carlo(whole(on.prepared), uncertain, factor, samples);
  result.seconds = clock.seconds();
  return result;
}

}  // namespace

bool Factor::pass() const {
  return outcome && (!expected || std::abs(factor - expected->reference) <= expected->tolerance * expected->reference);
}

Assessment assess(const Study& study, const AssessmentOptions& options, const std::vector<ExpectedFactor>& expected,
                  const Told& told) {
  Assessment all{study.model.name, study.model.title, study_sections(study), {}, {}, {}, {}};
  for (const StudySection& section : all.sections)
    for (const std::string& note : notes(section.prepared)) all.notes.push_back(note);

  const PartialFactors& partial = study.input.partial_factors;
  const std::vector<Uncertainty> uncertain = uncertainties(study.model, study.input);
  const bool scatter = std::any_of(uncertain.begin(), uncertain.end(), [](const auto& u) { return u.soil >= 0; });
  const auto compute = [&](const StabilityMethod& method, std::size_t at, Strengths strengths) {
    const StudySection& on = all.sections[at];
    Factor row;
    row.method = method.name;
    row.water = on.water;
    row.strengths = strengths;
    row.section = at;
    std::string differs = at > 0 ? on.water : "";
    if (strengths != Strengths::given)
      differs +=
          (differs.empty() ? "" : ", ") + std::string(strengths == Strengths::design ? "design" : "characteristic");
    row.label = differs.empty() ? row.method : fmt::format("{} ({})", row.method, differs);
    const Clock clock;
    if (strengths == Strengths::given) {
      row.outcome = method.run(study, on.prepared);
    } else {
      Section section = characteristic_section(whole(on.prepared), uncertain);
      if (strengths == Strengths::design) section = design_section(std::move(section), partial);
      row.outcome = method.run(study, prepare(std::move(section)));
    }
    row.factor = row.outcome.factor / (strengths == Strengths::design ? partial.model : 1);
    row.seconds = clock.seconds();
    if (options.contours && row.method == "bishop" && strengths == Strengths::given && row.outcome.search)
      add_contours(on.prepared, *row.outcome.search);
    for (const ExpectedFactor& e : expected)
      if (e.method == row.label) row.expected = e;
    if (told) told(row);
    all.factors.push_back(std::move(row));
  };
  for (std::size_t at = 0; at < all.sections.size(); ++at)
    for (const StabilityMethod* method : options.methods) {
      if (at > 0 && method->name == "srm") continue;  // minutes, for an answer that nobody asked for twice
      compute(*method, at, Strengths::given);
      if (scatter) compute(*method, at, Strengths::characteristic);
      if (has_factors(partial)) compute(*method, at, Strengths::design);
    }
  for (std::size_t at = 0; options.dike_checks && at < all.sections.size(); ++at)
    for (DikeCheck& check : dike_checks(study, all.sections[at])) {
      if (at > 0) check.label += fmt::format(" ({})", check.water);
      for (const ExpectedFactor& e : expected)
        if (e.method == check.label) check.expected = e;
      all.checks.push_back(std::move(check));
    }
  const StabilityMethod& first = *options.methods.front();
  if (options.form) all.probabilities.push_back(probability(study, all.sections.front(), first, true, 0));
  if (options.samples > 0)
    all.probabilities.push_back(probability(study, all.sections.front(), first, false, options.samples));
  return all;
}

}  // namespace polder::stability
