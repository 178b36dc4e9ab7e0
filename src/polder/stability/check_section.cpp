#include "polder/stability/check_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "polder/stability/lines.hpp"

namespace polder::stability {
namespace {

constexpr double gap_tolerance = 0.005;  // m; drawings are rounded to millimetres

void check_soil(const Soil& soil, std::vector<std::string>& problems) {
  if (soil.unit_weight <= 0 || soil.saturated_unit_weight <= 0)
    problems.push_back(fmt::format("soil '{}': its unit weight must be positive; give it in kN/m3", soil.name));
  for (const Strength* strength : {&soil.above, &soil.below}) {
    if (strength->cohesion < 0 || strength->undrained_strength < 0 || strength->ratio < 0)
      problems.push_back(fmt::format("soil '{}': a strength is negative; strengths are positive numbers", soil.name));
    if (strength->friction_angle < 0 || strength->friction_angle >= 1.4)
      problems.push_back(fmt::format("soil '{}': friction angle {:.1f} deg is outside 0 to 80 deg", soil.name,
                                     strength->friction_angle * 57.29577951308232));
  }
}

void check_level(const Line& line, const std::string& what, std::vector<std::string>& problems) {
  for (std::size_t i = 1; i < line.size(); ++i)
    if (line[i][0] < line[i - 1][0] - 1e-9) {
      problems.push_back(
          fmt::format("{}: x goes back from {:g} to {:g} m at its point {}; list its points from left to right", what,
                      line[i - 1][0], line[i][0], i + 1));
      return;
    }
}

void check_range(const std::optional<Range>& range, const char* what, double left, double right,
                 std::vector<std::string>& problems) {
  if (!range) return;
  if ((*range)[0] > (*range)[1])
    problems.push_back(fmt::format("limits: {} from {:g} to {:g} m is empty; give the smaller x first", what,
                                   (*range)[0], (*range)[1]));
  else if ((*range)[1] < left || (*range)[0] > right)
    problems.push_back(
        fmt::format("limits: {} from {:g} to {:g} m lies outside the section ({:g} to {:g} m); no slip "
                    "surface can satisfy it",
                    what, (*range)[0], (*range)[1], left, right));
}

}  // namespace

std::vector<std::string> check_data(const Section& section) {
  std::vector<std::string> problems;
  if (section.layers.empty())
    problems.push_back("there is no soil: the section has no layer; add at least one [[soil]] with a polygon");
  for (const Soil& soil : section.soils) check_soil(soil, problems);
  double left = 1e300, right = -1e300;
  for (std::size_t i = 0; i < section.layers.size(); ++i) {
    const Layer& layer = section.layers[i];
    const std::string name =
        layer.name.empty() ? fmt::format("layer {}", i + 1) : fmt::format("layer '{}'", layer.name);
    if (layer.polygon.size() < 3)
      problems.push_back(
          fmt::format("{}: its polygon has {} points; at least 3 are needed", name, layer.polygon.size()));
    else if (std::abs(signed_area(layer.polygon)) < 1e-9)
      problems.push_back(fmt::format("{}: its polygon has no area; its points lie on one line", name));
    if (layer.soil < 0 || static_cast<std::size_t>(layer.soil) >= section.soils.size())
      problems.push_back(fmt::format("{}: it has no soil; name one of the {} soils", name, section.soils.size()));
    for (const Point& p : layer.polygon) {
      if (!std::isfinite(p[0]) || !std::isfinite(p[1]))
        problems.push_back(fmt::format("{}: a point of its polygon is not a number", name));
      left = std::min(left, p[0]), right = std::max(right, p[0]);
    }
  }
  check_level(section.water.phreatic, "phreatic line", problems);
  for (std::size_t i = 0; i < section.water.references.size(); ++i) {
    const ReferenceLine& reference = section.water.references[i];
    const std::string name = fmt::format("reference line {}", i + 1);
    check_level(reference.line, name, problems);
    check_level(reference.head_above, name + ", head above", problems);
    check_level(reference.head_below, name + ", head below", problems);
    if (section.water.phreatic.empty())
      problems.push_back(fmt::format("{}: a head per layer needs a phreatic line; add one", name));
  }
  for (const StatePoint& state : section.state_points)
    if (state.layer < 0 || static_cast<std::size_t>(state.layer) >= section.layers.size())
      problems.push_back(fmt::format("a state point at x = {:g} m names a layer that does not exist", state.at[0]));
  for (const StripLoad& load : section.strip_loads)
    if (load.to <= load.from)
      problems.push_back(fmt::format("load '{}': it runs from {:g} to {:g} m; give the smaller x first", load.name,
                                     load.from, load.to));
  for (const LineLoad& load : section.line_loads)
    if (!section.layers.empty() && (load.at[0] < left || load.at[0] > right))
      problems.push_back(fmt::format("line load '{}': x = {:g} m lies outside the section ({:g} to {:g} m)", load.name,
                                     load.at[0], left, right));
  if (!section.layers.empty()) {
    check_range(section.limits.entry, "entry", left, right, problems);
    check_range(section.limits.exit, "exit", left, right, problems);
  }
  return problems;
}

std::vector<std::string> check_columns(const Section& section, const std::vector<Column>& columns) {
  std::vector<std::string> problems;
  const auto name = [&](int layer) {
    const Layer& l = section.layers[static_cast<std::size_t>(layer)];
    return l.name.empty() ? fmt::format("layer {}", layer + 1) : fmt::format("layer '{}'", l.name);
  };
  for (const Column& column : columns) {
    if (problems.size() >= 5) break;  // one mistake in a drawing shows in many columns
    const double middle = (column.left + column.right) / 2;
    if (column.right - column.left < gap_tolerance) continue;
    if (column.pieces.empty()) {
      problems.push_back(
          fmt::format("there is no soil between x = {:g} and {:g} m; draw a layer there", column.left, column.right));
      continue;
    }
    for (std::size_t k = 0; k + 1 < column.pieces.size(); ++k) {
      const Piece& upper = column.pieces[k];
      const Piece& lower = column.pieces[k + 1];
      const double base = (upper.base[0] + upper.base[1]) / 2, top = (lower.top[0] + lower.top[1]) / 2;
      if (base - top > gap_tolerance)
        problems.push_back(
            fmt::format("gap of {:.3f} m between {} and {} at x = {:g} m (heights {:g} to {:g} m); let "
                        "their polygons share the points of their common boundary",
                        base - top, name(upper.layer), name(lower.layer), middle, top, base));
      if (top - base > gap_tolerance)
        problems.push_back(
            fmt::format("{} and {} overlap by {:.3f} m at x = {:g} m (heights {:g} to {:g} m); let their "
                        "polygons share the points of their common boundary",
                        name(upper.layer), name(lower.layer), top - base, middle, base, top));
    }
  }
  return problems;
}

std::vector<std::string> notes(const PreparedSection& prepared) {
  std::vector<std::string> notes;
  const Section& section = prepared.section;
  const WaterNet& water = section.water;
  if (water.phreatic.empty()) return notes;
  // Free water, told once per stretch.
  double from = 0, deepest = 0;
  bool wet = false;
  const auto tell = [&](double to) {
    notes.push_back(
        fmt::format("the phreatic line is above the ground from x = {:g} to {:g} m, up to {:.2f} m: free water "
                    "stands there; lower the line if it should not",
                    from, to, deepest));
  };
  for (std::size_t k = 0; k < prepared.breaks.size(); ++k) {
    const double x = prepared.breaks[k];
    if (x < prepared.left() || x > prepared.right()) continue;
    const double depth = free_water_pressure(prepared, x) / water.unit_weight;
    const bool under = depth > 1e-3;
    if (under && !wet) from = k > 0 ? prepared.breaks[k - 1] : x, deepest = 0;
    if (under) deepest = std::max(deepest, depth);
    if (!under && wet) tell(x);
    wet = under;
  }
  if (wet) tell(prepared.right());
  // A reference line under which the water lifts the soil over it.
  for (std::size_t i = 0; i < water.references.size(); ++i) {
    double worst = 1e300, where = 0;
    for (const double x : prepared.breaks) {
      if (x < prepared.left() || x > prepared.right() || !covers(water.references[i].line, x)) continue;
      const double z = level(water.references[i].line, x) - 1e-6;
      if (z >= ground_level(prepared, x) - 1e-3) continue;
      const double pressure = pore_pressure(prepared, x, z);
      if (pressure <= 0) continue;
      const double factor = (soil_weight(prepared, x, z) + free_water_pressure(prepared, x)) / pressure;
      if (factor < worst) worst = factor, where = x;
    }
    if (worst < 1)
      notes.push_back(
          fmt::format("the head under reference line {} lifts the soil above it: weight over pressure is {:.3f} "
                      "at x = {:g} m; effective stress there is taken as zero",
                      i + 1, worst, where));
  }
  return notes;
}

}  // namespace polder::stability
