#include "polder/report/section_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "polder/result/paint.hpp"
#include "polder/result/panel.hpp"

namespace polder {
namespace {

using stability::CentreFactor, stability::Column, stability::free_water_pressure, stability::ground_level,
    stability::Piece, stability::PreparedSection, stability::SearchResult, stability::Slice, stability::StripLoad;
using Line = stability::Line;
using Point = stability::Point;

constexpr double drawing_width = 960, margin_left = 62, margin_right = 18, margin_top = 34, margin_bottom = 46;
constexpr double bar_room = 84;

struct Bounds {
  Point2 low{1e300, 1e300}, high{-1e300, -1e300};
  void take(const Point2& p) {
    for (std::size_t k = 0; k < 2; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  }
};

// A panel of equal scales, and the drawing around it.
Panel make_panel(Drawing& drawing, const Bounds& bounds, double room_right) {
  const double width = bounds.high[0] - bounds.low[0], height = bounds.high[1] - bounds.low[1];
  Panel panel;
  panel.x = margin_left, panel.y = margin_top;
  panel.width = drawing_width - margin_left - margin_right - room_right;
  panel.height = panel.width * height / width;
  constexpr double tallest = 620;
  if (panel.height > tallest) panel.width *= tallest / panel.height, panel.height = tallest;
  panel.horizontal = {bounds.low[0], bounds.high[0]};
  panel.vertical = {bounds.low[1], bounds.high[1]};
  drawing.width = panel.x + panel.width + margin_right + room_right;
  drawing.height = panel.y + panel.height + margin_bottom;
  return panel;
}

void draw_frame_of(Drawing& drawing, const Panel& panel, const std::string& title) {
  draw_axes(drawing, panel, {"x (m)", "y (m)", true, true, false});
  drawing.add(Text{{panel.x, panel.y - 12}, title, 14, ink::text, Anchor::start, true, 0});
}

Bounds bounds_of(const PreparedSection& prepared) {
  Bounds bounds;
  for (const Column& column : prepared.columns)
    for (const int side : {0, 1}) {
      const double x = side == 0 ? column.left : column.right;
      bounds.take({x, column.pieces.front().top[side]});
      bounds.take({x, column.pieces.back().base[side]});
    }
  for (const Point& p : prepared.section.water.phreatic)
    if (p[0] >= prepared.left() && p[0] <= prepared.right()) bounds.take(p);
  const double air = 0.06 * (bounds.high[1] - bounds.low[1]);
  bounds.high[1] += air;
  return bounds;
}

Colour soil_colour(int soil) {
  static const Colour colours[] = {rgb(0xe2cfa8), rgb(0xb5c4b6), rgb(0xd9bfa9), rgb(0xc6cbb0),
                                   rgb(0xcdbfd0), rgb(0xb9c8d2), rgb(0xe6dcc2), rgb(0xc2b6a0)};
  return colours[static_cast<std::size_t>(soil) % std::size(colours)];
}

void draw_soil(Drawing& drawing, const Panel& panel, const PreparedSection& prepared) {
  for (const Column& column : prepared.columns) {
    for (const Piece& piece : column.pieces) {
      const int soil = prepared.section.layers[static_cast<std::size_t>(piece.layer)].soil;
      const Colour colour = soil_colour(soil);
      drawing.add(Path{{panel.at(column.left, piece.top[0]), panel.at(column.right, piece.top[1]),
                        panel.at(column.right, piece.base[1]), panel.at(column.left, piece.base[0])},
                       true,
                       colour,
                       Stroke{colour, 0.6, {}}});
    }
  }
  for (const Column& column : prepared.columns)
    for (const Piece& piece : column.pieces) {
      const Stroke stroke{ink::soft, 0.9, {}};
      drawing.line(panel.at(column.left, piece.top[0]), panel.at(column.right, piece.top[1]), stroke);
      drawing.line(panel.at(column.left, piece.base[0]), panel.at(column.right, piece.base[1]), stroke);
    }
}

void draw_water(Drawing& drawing, const Panel& panel, const PreparedSection& prepared) {
  const Line& phreatic = prepared.section.water.phreatic;
  if (phreatic.empty()) return;
  // Free water: where the line is over the ground.
  for (std::size_t i = 0; i + 1 < prepared.breaks.size(); ++i) {
    const double a = prepared.breaks[i], b = prepared.breaks[i + 1];
    if (a < prepared.left() || b > prepared.right()) continue;
    const double unit = prepared.section.water.unit_weight;
    const double da = free_water_pressure(prepared, a) / unit, db = free_water_pressure(prepared, b) / unit;
    const double middle = free_water_pressure(prepared, (a + b) / 2) / unit;
    if (middle <= 1e-6) continue;
    const double ga = ground_level(prepared, a), gb = ground_level(prepared, b - 1e-9);
    drawing.add(
        Path{{panel.at(a, ga), panel.at(a, ga + da), panel.at(b, gb + db), panel.at(b, gb)}, true, ink::water, {}});
  }
  Path path{{}, false, {}, Stroke{ink::water_line, 1.6, {7, 4}}};
  const auto add = [&](double x) {
    const auto right =
        std::lower_bound(phreatic.begin(), phreatic.end(), x, [](const Point& p, double v) { return p[0] < v; });
    double z = 0;
    if (right == phreatic.begin())
      z = phreatic.front()[1];
    else if (right == phreatic.end())
      z = phreatic.back()[1];
    else {
      const Point &p = *(right - 1), &q = *right;
      z = p[1] + (x - p[0]) / (q[0] - p[0]) * (q[1] - p[1]);
    }
    path.points.push_back(panel.at(x, z));
  };
  add(prepared.left());
  for (const Point& p : phreatic)
    if (p[0] > prepared.left() && p[0] < prepared.right()) path.points.push_back(panel.at(p));
  add(prepared.right());
  drawing.add(path);
}

void draw_surface(Drawing& drawing, const Panel& panel, const SearchResult& found, bool slices) {
  Path body{{}, true, rgb(0xa13127, 0.10), {}};
  Path base{{}, false, {}, Stroke{rgb(0xa13127), 2.4, {}}};
  std::vector<Slice> list = found.slices.list;
  std::sort(list.begin(), list.end(), [](const Slice& a, const Slice& b) { return a.left < b.left; });
  for (const Slice& s : list) {
    if (base.points.empty()) base.points.push_back(panel.at(s.left, s.base_left));
    base.points.push_back(panel.at(s.right, s.base_right));
  }
  body.points = base.points;
  for (auto s = list.rbegin(); s != list.rend(); ++s) {
    body.points.push_back(panel.at(s->right, s->top_right));
    body.points.push_back(panel.at(s->left, s->top_left));
  }
  drawing.add(body);
  // Every third of very many slices, so that they do not become a veil.
  const std::size_t every = list.size() > 60 ? 3 : 1;
  for (std::size_t i = 0; slices && i < list.size(); i += every)
    drawing.line(panel.at(list[i].right, list[i].base_right), panel.at(list[i].right, list[i].top_right),
                 Stroke{rgb(0xa13127, 0.45), 0.7, {}});
  drawing.add(base);
}

void draw_loads(Drawing& drawing, const Panel& panel, const PreparedSection& prepared) {
  for (const StripLoad& load : prepared.section.strip_loads) {
    const double x0 = std::max(load.from, prepared.left()), x1 = std::min(load.to, prepared.right());
    for (int k = 0; k <= 6; ++k) {
      const double x = x0 + (x1 - x0) * k / 6;
      const Point2 tip = panel.at(x, ground_level(prepared, std::min(x, prepared.right() - 1e-9)));
      const Stroke stroke{ink::text, 1.1, {}};
      drawing.line({tip[0], tip[1] - 18}, tip, stroke);
      drawing.line({tip[0] - 3, tip[1] - 5}, tip, stroke);
      drawing.line({tip[0] + 3, tip[1] - 5}, tip, stroke);
    }
  }
}

// The force stands on its point; 26 units of the drawing long.
void draw_line_loads(Drawing& drawing, const Panel& panel, const PreparedSection& prepared) {
  for (const stability::LineLoad& load : prepared.section.line_loads) {
    constexpr double length = 26, head = 6;
    const double turn = load.force < 0 ? -1 : 1, dx = turn * std::sin(load.angle), dy = turn * std::cos(load.angle);
    const Point2 tip = panel.at(load.at);
    const Stroke stroke{ink::text, 1.6, {}};
    drawing.line({tip[0] - length * dx, tip[1] - length * dy}, tip, stroke);
    for (const double side : {-0.5, 0.5})
      drawing.line({tip[0] - head * (dx + side * dy), tip[1] - head * (dy - side * dx)}, tip, stroke);
  }
}

// The tension crack in which the surface begins, and how high water stands in it.
void draw_crack(Drawing& drawing, const Panel& panel, const PreparedSection& prepared, const SearchResult& found) {
  const stability::TensionCrack& crack = prepared.section.crack;
  if (crack.depth <= 0 || found.slices.list.empty()) return;
  const Slice& first = found.slices.list.front();
  const bool to_right = found.slices.direction > 0;
  const double x = to_right ? first.left : first.right;
  const double base = to_right ? first.base_left : first.base_right, top = to_right ? first.top_left : first.top_right;
  if (crack.water > 0)
    drawing.line(panel.at(x, base), panel.at(x, std::min(top, base + crack.water * crack.depth)),
                 Stroke{ink::water_line, 5, {}});
  drawing.line(panel.at(x, base), panel.at(x, top), Stroke{rgb(0xa13127), 1.8, {4, 2}});
}

// The point of a contour line of level `v` on a side, where it crosses it.
std::optional<Point2> crossing(const Point2& a, double va, const Point2& b, double vb, double v) {
  if ((va < v) == (vb < v)) return std::nullopt;
  const double s = (v - va) / (vb - va);
  return Point2{a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])};
}

}  // namespace

Drawing draw_slip(const PreparedSection& prepared, const SearchResult* found, const std::string& title) {
  Drawing drawing;
  const Panel panel = make_panel(drawing, bounds_of(prepared), 0);
  draw_soil(drawing, panel, prepared);
  draw_water(drawing, panel, prepared);
  draw_loads(drawing, panel, prepared);
  draw_line_loads(drawing, panel, prepared);
  if (found != nullptr && *found)
    draw_surface(drawing, panel, *found, true), draw_crack(drawing, panel, prepared, *found);
  draw_frame_of(drawing, panel, title);
  return drawing;
}

Drawing draw_centres(const PreparedSection& prepared, const SearchResult& found) {
  Drawing drawing;
  Bounds bounds = bounds_of(prepared);
  std::vector<double> factors;
  double spacing = 1e300;
  for (const CentreFactor& c : found.contours) {
    bounds.take(c.centre);
    factors.push_back(c.factor);
    for (const CentreFactor& other : found.contours)
      if (const double d = std::abs(other.centre[0] - c.centre[0]); d > 1e-9) spacing = std::min(spacing, d);
  }
  const Panel panel = make_panel(drawing, bounds, bar_room);
  std::sort(factors.begin(), factors.end());
  // Far from the least, factors tell nothing; the scale ends at 1.6 times it.
  Range range{factors.empty() ? 1 : factors.front(), factors.empty() ? 2 : factors.back()};
  range.high = std::min(range.high, 1.6 * range.low);
  if (range.high <= range.low) range.high = range.low * 1.01;
  draw_soil(drawing, panel, prepared);
  draw_water(drawing, panel, prepared);
  draw_surface(drawing, panel, found, false);
  draw_crack(drawing, panel, prepared, found);
  Squares squares;
  for (const CentreFactor& c : found.contours) {
    squares.centres.push_back(panel.at(c.centre));
    squares.sides.push_back(spacing * panel.scale());
    squares.colours.push_back(colour_at(ColourMap::field, (c.factor - range.low) / (range.high - range.low)));
  }
  drawing.add(Clip{panel.x, panel.y, panel.width, panel.height});
  drawing.add(squares);
  drawing.add(Unclip{});
  drawing.add(Disc{panel.at(found.surface.circle.centre), 4, rgb(0xffffff), Stroke{ink::text, 1.4, {}}});
  draw_upright_bar(drawing, {ColourMap::field, range, "", false, true}, panel.x + panel.width + 16, panel.y + 20, 14,
                   std::min(220.0, panel.height - 30));
  draw_frame_of(drawing, panel, "Least factor of safety with each centre");
  return drawing;
}

TriangleField nodal_field(const Mesh& mesh, std::span<const double> nodal) {
  TriangleField field;
  for (const auto& t : mesh.triangles)
    for (const auto& sub : sub_triangles) {
      field.pieces.push_back({t[sub[0]], t[sub[1]], t[sub[2]]});
      for (const int n : field.pieces.back()) field.per_corner.push_back(nodal[static_cast<std::size_t>(n)]);
    }
  return field;
}

TriangleField gauss_field(const Mesh& mesh, std::span<const double> gauss) {
  TriangleField field;
  for (std::size_t e = 0; e < mesh.triangles.size(); ++e) {
    field.pieces.push_back({mesh.triangles[e][0], mesh.triangles[e][1], mesh.triangles[e][2]});
    const double mean = (gauss[3 * e] + gauss[3 * e + 1] + gauss[3 * e + 2]) / 3;
    field.per_corner.insert(field.per_corner.end(), 3, mean);
  }
  return field;
}

Drawing draw_field(const Mesh& mesh, const TriangleField& field) {
  Drawing drawing;
  Bounds bounds;
  for (const Point2& p : mesh.nodes) bounds.take(p);
  bounds.high[1] += 0.04 * (bounds.high[1] - bounds.low[1]);
  const Panel panel = make_panel(drawing, bounds, bar_room);
  Range range = range_of(field.per_corner);
  bool above = false;
  if (field.from_zero) {
    std::vector<double> sorted = field.per_corner;
    const auto cut = sorted.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(sorted.size() - 1));
    std::nth_element(sorted.begin(), cut, sorted.end());
    above = range.high > *cut && *cut > 0;
    range = {0, above ? *cut : range.high};
  }
  if (!(range.high > range.low)) range.high = range.low + 1;
  range = nice_range(range, 6);
  for (std::size_t i = 0; i < field.pieces.size(); ++i) {
    const double mean = (field.per_corner[3 * i] + field.per_corner[3 * i + 1] + field.per_corner[3 * i + 2]) / 3;
    const Colour colour = colour_at(field.map, (mean - range.low) / (range.high - range.low));
    Path path{{}, true, colour, Stroke{colour, 0.6, {}}};
    for (const int n : field.pieces[i]) path.points.push_back(panel.at(mesh.nodes[static_cast<std::size_t>(n)]));
    drawing.add(path);
  }
  if (field.lines > 0) {
    for (const double level : nice_ticks(range, field.lines).at)
      for (std::size_t i = 0; i < field.pieces.size(); ++i) {
        std::vector<Point2> ends;
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t m = (k + 1) % 3;
          const auto& a = mesh.nodes[static_cast<std::size_t>(field.pieces[i][k])];
          const auto& b = mesh.nodes[static_cast<std::size_t>(field.pieces[i][m])];
          if (const auto p = crossing(a, field.per_corner[3 * i + k], b, field.per_corner[3 * i + m], level))
            ends.push_back(*p);
        }
        if (ends.size() == 2) drawing.line(panel.at(ends[0]), panel.at(ends[1]), Stroke{rgb(0xffffff, 0.75), 0.9, {}});
      }
  }
  for (const MeshEdge& side : outline(mesh))
    drawing.line(panel.at(mesh.nodes[static_cast<std::size_t>(side.a)]),
                 panel.at(mesh.nodes[static_cast<std::size_t>(side.b)]), Stroke{ink::soft, 1.1, {}});
  for (const auto& [from, to] : field.arrows) {
    const Point2 a = panel.at(from), b = panel.at(to);
    const double dx = b[0] - a[0], dy = b[1] - a[1], length = std::hypot(dx, dy);
    if (length < 2) continue;
    const Stroke stroke{ink::text, 0.9, {}};
    const double head = std::min(5.0, 0.4 * length), ux = dx / length, uy = dy / length;
    drawing.line(a, b, stroke);
    drawing.line(b, {b[0] - head * (ux - 0.5 * uy), b[1] - head * (uy + 0.5 * ux)}, stroke);
    drawing.line(b, {b[0] - head * (ux + 0.5 * uy), b[1] - head * (uy - 0.5 * ux)}, stroke);
  }
  for (const auto& [from, to] : field.overlay)
    drawing.line(panel.at(from), panel.at(to), Stroke{ink::water_line, 2, {}});
  draw_upright_bar(drawing, {field.map, range, field.unit, false, above}, panel.x + panel.width + 16, panel.y + 20, 14,
                   std::min(220.0, panel.height - 30));
  draw_frame_of(drawing, panel, field.title);
  return drawing;
}

}  // namespace polder
