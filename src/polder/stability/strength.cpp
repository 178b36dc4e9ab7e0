#include "polder/stability/strength.hpp"

#include <algorithm>
#include <cmath>

#include "polder/stability/lines.hpp"

namespace polder::stability {
namespace {

constexpr double on_boundary = 1e-3;  // m

double overburden(const PreparedSection& reference, const Preconsolidation& state, const Point& at) {
  switch (state.kind) {
    case PreconsolidationKind::pop:
      return state.value;
    case PreconsolidationKind::ocr:
      return (state.value - 1) * std::max(0.0, vertical_effective_stress(reference, at[0], at[1]));
    case PreconsolidationKind::yield_stress:
      return state.value - vertical_effective_stress(reference, at[0], at[1]);
  }
  return 0;
}

double interpolate(double x, double x0, double y0, double x1, double y1) {
  return x1 > x0 ? y0 + std::clamp((x - x0) / (x1 - x0), 0.0, 1.0) * (y1 - y0) : y0;
}

// POP from the state points of the layer. An OCR holds at the point asked for, a yield stress where it was measured.
double from_points(const PreparedSection& prepared, const PreparedSection& reference, const std::vector<int>& states,
                   const Point& at) {
  const auto value = [&](std::size_t k) {
    const StatePoint& state = prepared.section.state_points[static_cast<std::size_t>(states[k])];
    return overburden(reference, state.value, state.value.kind == PreconsolidationKind::ocr ? at : state.at);
  };
  const auto x_of = [&](std::size_t k) {
    return prepared.section.state_points[static_cast<std::size_t>(states[k])].at[0];
  };
  std::size_t right = 0;
  while (right < states.size() && x_of(right) < at[0]) ++right;
  if (right == 0) return value(0);
  if (right == states.size()) return value(right - 1);
  return interpolate(at[0], x_of(right - 1), value(right - 1), x_of(right), value(right));
}

double along(const PreparedSection& reference, const StateLine& line, bool below, const Point& at) {
  const auto value = [&](const StateLine::Value& v) { return overburden(reference, below ? v.below : v.above, at); };
  std::size_t right = 0;
  while (right < line.values.size() && line.values[right].x < at[0]) ++right;
  if (right == 0) return value(line.values.front());
  if (right == line.values.size()) return value(line.values.back());
  return interpolate(at[0], line.values[right - 1].x, value(line.values[right - 1]), line.values[right].x,
                     value(line.values[right]));
}

PointStrength evaluate(const PreparedSection& prepared, int layer, double x, double z, double effective) {
  const Section& section = prepared.section;
  const Soil& soil = section.soils[static_cast<std::size_t>(section.layers[static_cast<std::size_t>(layer)].soil)];
  const bool dry = section.water.phreatic.empty() || z >= level(section.water.phreatic, x);
  const Strength& law = dry ? soil.above : soil.below;
  PointStrength strength;
  strength.layer = layer;
  switch (law.model) {
    case StrengthModel::drained: {
      const double sin_phi = std::sin(law.friction_angle), cos_phi = std::cos(law.friction_angle);
      const double psi = law.dilatancy_angle.value_or(law.friction_angle);
      const double band = std::cos(psi) / (1 - sin_phi * std::sin(psi));
      strength.cohesion = law.cohesion * cos_phi * band;
      strength.tan_friction = sin_phi * band;
      break;
    }
    case StrengthModel::undrained: {
      const double top = law.reference_level.value_or(law.strength_gradient != 0 ? ground_level(prepared, x) : z);
      strength.cohesion = std::max(0.0, law.undrained_strength + law.strength_gradient * std::max(0.0, top - z));
      break;
    }
    case StrengthModel::shansep: {
      const double stress = std::max(effective, 0.0);
      strength.yield_stress = yield_stress(prepared, layer, x, z);
      const double ocr = stress > 0 ? std::max(1.0, strength.yield_stress / stress) : 1.0;
      strength.cohesion = law.ratio * stress * std::pow(ocr, law.exponent);
      break;
    }
    case StrengthModel::table: {
      const auto& t = law.stress_table;
      std::size_t right = 0;
      while (right < t.size() && t[right][0] < effective) ++right;
      if (t.empty()) break;
      strength.cohesion = right == 0 ? t.front()[1]
                          : right == t.size()
                              ? t.back()[1]
                              : interpolate(effective, t[right - 1][0], t[right - 1][1], t[right][0], t[right][1]);
      break;
    }
  }
  return strength;
}

}  // namespace

double yield_stress(const PreparedSection& prepared, int layer, double x, double z) {
  const PreparedSection& reference = prepared.before.empty() ? prepared : prepared.before.front();
  const Section& section = prepared.section;
  const Point at{x, z};
  const double stress = vertical_effective_stress(reference, x, z);
  const std::vector<int>& states = prepared.states[static_cast<std::size_t>(layer)];
  if (!states.empty()) return stress + from_points(prepared, reference, states, at);

  const StateLine* over = nullptr;
  const StateLine* under = nullptr;
  double z_over = 0, z_under = 0;
  for (const StateLine& line : section.state_lines) {
    if (line.values.empty() || !covers(line.line, x)) continue;
    const double here = level(line.line, x);
    if (here >= z && (over == nullptr || here < z_over)) over = &line, z_over = here;
    if (here < z && (under == nullptr || here > z_under)) under = &line, z_under = here;
  }
  if (over != nullptr && under != nullptr)
    return stress + interpolate(z_over - z, 0, along(reference, *over, true, at), z_over - z_under,
                                along(reference, *under, false, at));
  if (over != nullptr) return stress + along(reference, *over, true, at);
  if (under != nullptr) return stress + along(reference, *under, false, at);
  return stress + overburden(reference, section.layers[static_cast<std::size_t>(layer)].preconsolidation, at);
}

PointStrength strength_at(const PreparedSection& prepared, double x, double z, double effective) {
  const int above = layer_at(prepared, x, z + on_boundary), below = layer_at(prepared, x, z - on_boundary);
  const int first = above >= 0 ? above : below, second = below >= 0 ? below : above;
  if (first < 0) return {};
  const PointStrength a = evaluate(prepared, first, x, z, effective);
  if (first == second) return a;
  const PointStrength b = evaluate(prepared, second, x, z, effective);
  const double stress = std::max(effective, 0.0);
  return b.cohesion + b.tan_friction * stress < a.cohesion + a.tan_friction * stress ? b : a;
}

}  // namespace polder::stability
