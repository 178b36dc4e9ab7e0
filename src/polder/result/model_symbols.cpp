#include "polder/result/model_symbols.hpp"

#include <algorithm>
#include <cmath>

#include "polder/result/paint.hpp"

namespace polder {
namespace {

const Stroke support{ink::axis, 1.1, {}};

Point2 moved(Point2 p, Point2 along, double a, Point2 across, double b) {
  return {p[0] + a * along[0] + b * across[0], p[1] + a * along[1] + b * across[1]};
}

// A line with the direction in which its symbols stand: away from the model.
struct Edge {
  Point2 from{0, 0}, to{0, 0}, out{0, 0};
  double length() const { return std::hypot(to[0] - from[0], to[1] - from[1]); }
  Point2 along() const { return {(to[0] - from[0]) / length(), (to[1] - from[1]) / length()}; }
};

Edge edge_of(const Panel& panel, const Boundary& boundary) {
  const double l = panel.x, r = panel.x + panel.width, t = panel.y, b = panel.y + panel.height;
  if (!boundary.side) {
    if (boundary.line.size() < 2) return {};
    const Point2 from = panel.at(boundary.line[0]), to = panel.at(boundary.line[1]);
    const bool upright = std::abs(to[0] - from[0]) < std::abs(to[1] - from[1]);
    return {from, to, upright ? Point2{1, 0} : Point2{0, 1}};
  }
  switch (*boundary.side) {
    case Side::left:
      return {{l, t}, {l, b}, {-1, 0}};
    case Side::right:
      return {{r, t}, {r, b}, {1, 0}};
    case Side::base:
      return {{l, b}, {r, b}, {0, 1}};
    case Side::top:
      return {{l, t}, {r, t}, {0, -1}};
    case Side::front:
    case Side::back:
      return {};  // before and behind the section
  }
  return {};
}

void draw_rollers(Drawing& drawing, const Edge& edge) {
  constexpr double radius = 3.5, spacing = 34;
  const int count = std::max(1, static_cast<int>(edge.length() / spacing));
  for (int i = 0; i < count; ++i) {
    const Point2 centre = moved(edge.from, edge.along(), (i + 0.5) * edge.length() / count, edge.out, radius + 1);
    drawing.add(Disc{centre, radius, rgb(0xffffff), support});
  }
  drawing.line(moved(edge.from, edge.along(), 0, edge.out, 2 * radius + 2),
               moved(edge.to, edge.along(), 0, edge.out, 2 * radius + 2), support);
}

void draw_hatch(Drawing& drawing, const Edge& edge) {
  constexpr double depth = 9, spacing = 9;
  const int count = std::max(1, static_cast<int>(edge.length() / spacing));
  for (int i = 0; i < count; ++i) {
    const double at = (i + 1) * edge.length() / count;
    drawing.line(moved(edge.from, edge.along(), at, edge.out, 0),
                 moved(edge.from, edge.along(), at - depth, edge.out, depth), support);
  }
  drawing.line(edge.from, edge.to, Stroke{ink::wall, 2, {}});
}

// The piston and the pot of a dashpot, again and again.
void draw_dashpots(Drawing& drawing, const Edge& edge) {
  constexpr double spacing = 40;
  const Stroke stroke{ink::axis, 1.1, {}};
  const int count = std::max(1, static_cast<int>(edge.length() / spacing));
  for (int i = 0; i < count; ++i) {
    const double at = (i + 0.5) * edge.length() / count;
    const auto point = [&](double beside, double out) {
      return moved(edge.from, edge.along(), at + beside, edge.out, out);
    };
    drawing.line(point(0, 0), point(0, 6), stroke);
    drawing.line(point(-3, 6), point(3, 6), stroke);
    drawing.add(Path{{point(-5, 3), point(-5, 10), point(5, 10), point(5, 3)}, false, {}, stroke});
    drawing.line(point(0, 10), point(0, 14), stroke);
  }
}

// Parallel lines at 45° inside a polygon, by the even-odd rule.
void draw_stripes(Drawing& drawing, const std::vector<Point2>& polygon, const Stroke& stroke) {
  constexpr double spacing = 9;
  double low = 1e300, high = -1e300;
  for (const Point2& p : polygon) low = std::min(low, p[0] + p[1]), high = std::max(high, p[0] + p[1]);
  const auto first = std::lround(std::ceil(low / spacing));
  for (long stripe = first; static_cast<double>(stripe) * spacing < high; ++stripe) {
    const double level = static_cast<double>(stripe) * spacing;
    std::vector<double> cuts;  // x − y of the crossings of x + y = level with the sides
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      const double a = p[0] + p[1] - level, b = q[0] + q[1] - level;
      if ((a < 0) == (b < 0)) continue;
      const double share = a / (a - b);
      cuts.push_back((p[0] - p[1]) + share * ((q[0] - q[1]) - (p[0] - p[1])));
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t i = 0; i + 1 < cuts.size(); i += 2)
      drawing.line({(level + cuts[i]) / 2, (level - cuts[i]) / 2},
                   {(level + cuts[i + 1]) / 2, (level - cuts[i + 1]) / 2}, stroke);
  }
}

}  // namespace

void draw_level_mark(Drawing& drawing, Point2 at) {
  const Stroke stroke{ink::water_line, 1.2, {}};
  drawing.add(Path{{at, {at[0] - 5.5, at[1] - 9}, {at[0] + 5.5, at[1] - 9}}, true, rgb(0xffffff), stroke});
  drawing.line({at[0] - 5.5, at[1] + 3.5}, {at[0] + 5.5, at[1] + 3.5}, stroke);
  drawing.line({at[0] - 3, at[1] + 6.5}, {at[0] + 3, at[1] + 6.5}, stroke);
}

void draw_boundary(Drawing& drawing, const Panel& panel, const Boundary& boundary) {
  const Edge edge = edge_of(panel, boundary);
  if (edge.length() == 0) return;
  if (boundary.soil == SoilCondition::roller) draw_rollers(drawing, edge);
  if (boundary.soil == SoilCondition::rough) draw_hatch(drawing, edge);
  if (boundary.soil == SoilCondition::absorbing) draw_dashpots(drawing, edge);
  if (boundary.water == WaterCondition::open) drawing.line(edge.from, edge.to, Stroke{ink::water_line, 3, {8, 5}});
}

void draw_reservoir(Drawing& drawing, const Panel& panel, const Boundary& boundary) {
  if (boundary.region.polygon.empty()) return;
  Path path{{}, true, {}, Stroke{ink::water_line, 1.2, {4, 3}}};
  Point2 centre{0, 0};
  double left = 1e300, right = -1e300;
  for (const Point2& p : boundary.region.polygon) {
    path.points.push_back(panel.at(p));
    left = std::min(left, path.points.back()[0]), right = std::max(right, path.points.back()[0]);
    centre[0] += path.points.back()[0] / static_cast<double>(boundary.region.polygon.size());
    centre[1] += path.points.back()[1] / static_cast<double>(boundary.region.polygon.size());
  }
  draw_stripes(drawing, path.points, Stroke{rgb(0x1c6aa8, 0.35), 0.9, {}});
  drawing.add(path);
  std::string text = "h = " + number_text(boundary.head(0)) + " m";
  if (!boundary.head.is_constant()) text = "h(t) from " + number_text(boundary.head(0)) + " m";
  const double width = text_width(text, tick_size);
  if (width + 8 > right - left) return;
  drawing.rectangle(centre[0] - width / 2 - 4, centre[1] - 9, width + 8, 17, rgb(0xffffff, 0.9));
  drawing.add(Text{{centre[0], centre[1] + 3.5}, text, tick_size, ink::water_line, Anchor::middle});
}

void draw_dimension(Drawing& drawing, Point2 from, Point2 to, const std::string& text) {
  const Stroke stroke{ink::soft, 0.9, {}};
  const Edge edge{from, to, {0, 0}};
  const Point2 along = edge.along(), across{along[1], -along[0]};
  drawing.line(from, to, stroke);
  for (const auto& [end, inward] : {std::pair{from, 1.0}, std::pair{to, -1.0}}) {
    drawing.add(Path{{moved(end, along, 7 * inward, across, 2.4), end, moved(end, along, 7 * inward, across, -2.4)},
                     true,
                     ink::soft,
                     {}});
    drawing.line(moved(end, along, 0, across, 5), moved(end, along, 0, across, -5), stroke);
  }
  const Point2 middle{(from[0] + to[0]) / 2, (from[1] + to[1]) / 2};
  const bool upright = std::abs(along[1]) > 0.5;
  const double half = text_width(text, tick_size) / 2 + 4;
  drawing.rectangle(middle[0] - (upright ? 7 : half), middle[1] - (upright ? half : 7), upright ? 14 : 2 * half,
                    upright ? 2 * half : 14, rgb(0xffffff));
  Text label{
      {middle[0] + (upright ? 4 : 0), middle[1] + (upright ? 0 : 4)}, text, tick_size, ink::text, Anchor::middle};
  label.angle = upright ? 90 : 0;
  drawing.add(label);
}

void swatch(Drawing& drawing, double x, double y, const Colour& colour) {
  drawing.rectangle(x, y - 6, 22, 12, colour, Stroke{rgb(0x5c5648), 0.8, {}});
}

void striped_swatch(Drawing& drawing, double x, double y, const Colour& colour) {
  const std::vector<Point2> box{{x, y - 6}, {x + 22, y - 6}, {x + 22, y + 6}, {x, y + 6}};
  draw_stripes(drawing, box, Stroke{rgb(0x1c6aa8, 0.35), 0.9, {}});
  drawing.add(Path{box, true, {}, Stroke{colour, 1.2, {4, 3}}});
}

void dashes(Drawing& drawing, double x, double y, const Colour& colour) {
  drawing.line({x, y}, {x + 22, y}, Stroke{colour, 1.4, {7, 4}});
}

void heavy_dashes(Drawing& drawing, double x, double y, const Colour& colour) {
  drawing.line({x, y}, {x + 22, y}, Stroke{colour, 3, {8, 5}});
}

void wall_sample(Drawing& drawing, double x, double y, const Colour& colour) {
  drawing.line({x, y}, {x + 22, y}, Stroke{colour, 3, {}});
}

void gate_sample(Drawing& drawing, double x, double y, const Colour& colour) {
  drawing.line({x, y}, {x + 22, y}, Stroke{colour, 3, {7, 3}});
}

void roller_sample(Drawing& drawing, double x, double y, const Colour& colour) {
  const Stroke stroke{colour, 1.1, {}};
  for (const double at : {5.0, 17.0}) drawing.add(Disc{{x + at, y}, 3.5, rgb(0xffffff), stroke});
  drawing.line({x, y + 5}, {x + 22, y + 5}, stroke);
}

void hatch_sample(Drawing& drawing, double x, double y, const Colour&) {
  draw_hatch(drawing, {{x, y - 4}, {x + 22, y - 4}, {0, 1}});
}

void absorbing_sample(Drawing& drawing, double x, double y, const Colour&) {
  draw_dashpots(drawing, {{x, y - 6}, {x + 22, y - 6}, {0, 1}});
}

void well_sample(Drawing& drawing, double x, double y, const Colour& colour) {
  drawing.add(Disc{{x + 11, y}, 4.5, rgb(0xffffff), Stroke{colour, 2, {}}});
}

void change_sample(Drawing& drawing, double x, double y, const Colour& colour) {
  drawing.rectangle(x, y - 6, 22, 12, {}, Stroke{colour, 1.4, {5, 3}});
}

}  // namespace polder
