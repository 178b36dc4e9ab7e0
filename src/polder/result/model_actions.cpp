#include "polder/result/model_actions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "polder/result/model_symbols.hpp"
#include "polder/result/paint.hpp"

namespace polder {
namespace {

using Kind = SeepageCondition::Kind;

Stroke stroke_of(Kind kind) {
  switch (kind) {
    case Kind::head:
      return {ink::water_line, 2.8, {}};
    case Kind::seepage:
      return {ink::water_line, 2.8, {4, 3}};
    case Kind::rain:
      return {ink::water_line, 2.8, {1, 3}};
    case Kind::closed:
      return {ink::axis, 2.8, {}};
  }
  throw std::logic_error("model drawing: unknown condition of pore water");
}

/// Level of the ground's surface at x: the highest crossing of an upright line with the soil's outlines.
double ground_at(const Model& model, double x) {
  double top = 0;
  for (const SoilBody& body : model.soils) {
    const std::vector<Point2>& polygon = body.region.polygon;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Point2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
      if (x < std::min(a[0], b[0]) || x > std::max(a[0], b[0])) continue;
      top = std::max(top, a[0] == b[0] ? std::max(a[1], b[1]) : a[1] + (x - a[0]) / (b[0] - a[0]) * (b[1] - a[1]));
    }
  }
  return top;
}

/// Least and largest of the values, and of those of `also`.
std::string range_text(const Table& table, const std::optional<Table>& also, double factor, const char* unit) {
  std::vector<double> values = table.y;
  if (also) values.insert(values.end(), also->y.begin(), also->y.end());
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const std::string text = number_text(*high / factor);
  return *low == *high ? fmt::format("{} {}", text, unit)
                       : fmt::format("{} to {} {}", number_text(*low / factor), text, unit);
}

/// Height of the condition's line at x; −∞ beyond its ends.
double line_at(const SeepageCondition& condition, double x) {
  for (std::size_t k = 0; k + 1 < condition.line.size(); ++k) {
    const Point2 &a = condition.line[k], &b = condition.line[k + 1];
    if (a[0] != b[0] && x >= std::min(a[0], b[0]) && x <= std::max(a[0], b[0]))
      return a[1] + (x - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
  }
  return -std::numeric_limits<double>::infinity();
}

/// Water that stands on the ground along the line at this level; none where the line is under the ground (a drain).
bool draw_level(Drawing& drawing, const Panel& panel, const Model& model, const SeepageCondition& condition,
                double level) {
  constexpr int pieces = 200;
  const double first = condition.line.front()[0], last = condition.line.back()[0];
  double begin = std::numeric_limits<double>::quiet_NaN(), end = begin;
  for (int k = 0; k <= pieces; ++k) {
    const double x = first + (last - first) * k / pieces;
    const double ground = ground_at(model, x);
    if (ground >= level || line_at(condition, x) < ground - 0.5 * model.cell[1]) continue;
    if (std::isnan(begin)) begin = x;
    end = x;
  }
  if (std::isnan(begin) || begin == end || level > model.size[1]) return false;
  drawing.line(panel.at(begin, level), panel.at(end, level), Stroke{ink::water_line, 1.2, {}});
  draw_level_mark(drawing, panel.at(0.5 * (begin + end), level));
  return true;
}

}  // namespace

void draw_pore_water(Drawing& drawing, const Panel& panel, const Model& model) {
  for (const SeepageCondition& condition : model.pore_water) {
    if (condition.line.size() < 2 || condition.kind == Kind::closed) continue;
    Path path{{}, false, {}, stroke_of(condition.kind)};
    for (const Point2& p : condition.line) path.points.push_back(panel.at(p));
    drawing.add(path);
    if (condition.kind != Kind::head || condition.head.y.empty()) continue;
    const double high = *std::max_element(condition.head.y.begin(), condition.head.y.end());
    const bool stands = draw_level(drawing, panel, model, condition, high);
    const std::string name = condition.name.empty() ? "head" : condition.name;
    const Point2 at = panel.at(condition.line.front()[0], stands ? high : condition.line.front()[1]);
    drawing.add(Text{{std::max(at[0], panel.x) + 6, std::max(at[1] - 6, panel.y + 12)},
                     fmt::format("{}: {}", name, range_text(condition.head, condition.head_at_end, 1, "m")),
                     tick_size,
                     ink::water_line});
  }
}

void draw_loads(Drawing& drawing, const Panel& panel, const Model& model) {
  constexpr double length = 20;
  for (const GroundLoad& load : model.loads) {
    const double from = std::max(load.span[0], 0.0), to = std::min(load.span[1], model.size[0]);
    if (to <= from || load.pressure.y.empty()) continue;
    const int arrows = std::clamp(static_cast<int>((to - from) * panel.scale() / 14), 1, 24);
    double top = panel.y + panel.height;
    for (int k = 0; k <= arrows; ++k) {
      const double x = from + (to - from) * k / arrows;
      const Point2 tip = panel.at(x, ground_at(model, x));
      const Stroke stroke{ink::text, 1.1, {}};
      drawing.line({tip[0], tip[1] - length}, tip, stroke);
      drawing.line({tip[0] - 3, tip[1] - 5}, tip, stroke);
      drawing.line({tip[0] + 3, tip[1] - 5}, tip, stroke);
      top = std::min(top, tip[1] - length);
    }
    const std::string name = load.name.empty() ? "load" : load.name;
    drawing.add(Text{{panel.at(0.5 * (from + to), 0)[0], top - 4},
                     fmt::format("{}: {}", name, range_text(load.pressure, load.pressure_at_end, 1e3, "kPa")),
                     tick_size,
                     ink::text,
                     Anchor::middle});
  }
}

void head_sample(Drawing& drawing, double x, double y, const Colour&) {
  drawing.line({x, y}, {x + 22, y}, stroke_of(Kind::head));
}
void seepage_sample(Drawing& drawing, double x, double y, const Colour&) {
  drawing.line({x, y}, {x + 22, y}, stroke_of(Kind::seepage));
}
void rain_sample(Drawing& drawing, double x, double y, const Colour&) {
  drawing.line({x, y}, {x + 22, y}, stroke_of(Kind::rain));
}
void load_sample(Drawing& drawing, double x, double y, const Colour& colour) {
  for (const double at : {x + 5, x + 16}) {
    drawing.line({at, y - 6}, {at, y + 5}, Stroke{colour, 1.1, {}});
    drawing.line({at - 3, y + 1}, {at, y + 5}, Stroke{colour, 1.1, {}});
    drawing.line({at + 3, y + 1}, {at, y + 5}, Stroke{colour, 1.1, {}});
  }
}

}  // namespace polder
