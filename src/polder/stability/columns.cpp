#include "polder/stability/columns.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "polder/stability/check_section.hpp"
#include "polder/stability/lines.hpp"
#include "polder/stability/water_net.hpp"

namespace polder::stability {
namespace {

constexpr double same_x = 1e-9;  // m; vertices closer than this are one

void append_line(std::vector<double>& xs, const Line& line) {
  for (const Point& p : line) xs.push_back(p[0]);
}

void sort_unique(std::vector<double>& xs) {
  std::sort(xs.begin(), xs.end());
  xs.erase(std::unique(xs.begin(), xs.end(), [](double a, double b) { return b - a < same_x; }), xs.end());
}

// Heights at `left` and `right` where the layer's outline passes through the column, in pairs from the ground down.
void append_pieces(const Layer& layer, int index, double left, double right, std::vector<Piece>& pieces) {
  struct Edge {
    double at_left, at_right;
    double middle() const { return at_left + at_right; }
  };
  std::vector<Edge> edges;
  const double middle = (left + right) / 2;
  for (std::size_t i = 0, j = layer.polygon.size() - 1; i < layer.polygon.size(); j = i++) {
    const Point& a = layer.polygon[i];
    const Point& b = layer.polygon[j];
    if ((a[0] > middle) == (b[0] > middle)) continue;
    const double slope = (b[1] - a[1]) / (b[0] - a[0]);
    edges.push_back({a[1] + (left - a[0]) * slope, a[1] + (right - a[0]) * slope});
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.middle() > b.middle(); });
  for (std::size_t k = 0; k + 1 < edges.size(); k += 2)
    pieces.push_back({{edges[k].at_left, edges[k].at_right}, {edges[k + 1].at_left, edges[k + 1].at_right}, index});
}

// Whether every corner of `inner` lies in `outer`, or on it within a millimetre.
bool holds(const Layer& outer, const Layer& inner) {
  return std::all_of(inner.polygon.begin(), inner.polygon.end(), [&](const Point& p) {
    if (inside(outer.polygon, p)) return true;
    for (std::size_t i = 0, j = outer.polygon.size() - 1; i < outer.polygon.size(); j = i++)
      if (distance(p, outer.polygon[j], outer.polygon[i]) < 1e-3) return true;
    return false;
  });
}

// A layer drawn inside another takes its place there: the outer one's piece is split around it.
void open_for_inner(const std::vector<std::vector<bool>>& inner, std::vector<Piece>& pieces) {
  bool split = false;  // a layer that thins out to nothing is no leftover of a split
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const Piece a = pieces[i], b = pieces[k];
      if (!inner[static_cast<std::size_t>(a.layer)][static_cast<std::size_t>(b.layer)]) continue;
      const auto middle = [](const double(&ends)[2]) { return (ends[0] + ends[1]) / 2; };
      constexpr double hair = 1e-6;  // m
      if (middle(b.top) > middle(a.top) + hair || middle(b.base) < middle(a.base) - hair) continue;
      const Piece over{{a.top[0], a.top[1]}, {b.top[0], b.top[1]}, a.layer};
      const Piece under{{b.base[0], b.base[1]}, {a.base[0], a.base[1]}, a.layer};
      pieces[i] = over;
      split = true;
      if (middle(under.top) - middle(under.base) > hair) pieces.push_back(under);
    }
  if (split) std::erase_if(pieces, [](const Piece& p) { return p.top[0] + p.top[1] - p.base[0] - p.base[1] < 1e-9; });
}

// Takes away what is above the line; columns end at its corners and where it crosses boundaries.
void excavate(const Line& line, Column& column) {
  if (column.left < line.front()[0] - same_x || column.right > line.back()[0] + same_x) return;
  const double floor[2] = {level(line, column.left), level(line, column.right)};
  for (Piece& piece : column.pieces)
    for (const int side : {0, 1}) piece.top[side] = std::min(piece.top[side], std::max(floor[side], piece.base[side]));
  std::erase_if(column.pieces, [](const Piece& p) { return p.top[0] + p.top[1] - p.base[0] - p.base[1] < 1e-9; });
}

// Where an excavation's line crosses the outline of a layer.
void append_excavation(std::vector<double>& xs, const Line& line, const Section& section) {
  append_line(xs, line);
  for (std::size_t k = 0; k + 1 < line.size(); ++k)
    for (const Layer& layer : section.layers)
      for (std::size_t i = 0, j = layer.polygon.size() - 1; i < layer.polygon.size(); j = i++) {
        const Point& a = layer.polygon[j];
        const Point& b = layer.polygon[i];
        const double ux = line[k + 1][0] - line[k][0], uz = line[k + 1][1] - line[k][1];
        const double cross = ux * (b[1] - a[1]) - uz * (b[0] - a[0]);
        if (std::abs(cross) < 1e-12) continue;
        const double t = ((a[0] - line[k][0]) * (b[1] - a[1]) - (a[1] - line[k][1]) * (b[0] - a[0])) / cross;
        const double x = line[k][0] + t * ux;
        if (t >= 0 && t <= 1 && x >= std::min(a[0], b[0]) && x <= std::max(a[0], b[0])) xs.push_back(x);
      }
}

std::vector<Column> cut(const Section& section) {
  std::vector<std::vector<bool>> inner(section.layers.size(), std::vector<bool>(section.layers.size(), false));
  for (std::size_t i = 0; i < section.layers.size(); ++i)
    for (std::size_t k = 0; k < section.layers.size(); ++k)
      inner[i][k] =
          i != k &&
          std::abs(signed_area(section.layers[i].polygon)) > std::abs(signed_area(section.layers[k].polygon)) &&
          holds(section.layers[i], section.layers[k]);
  std::vector<double> xs;
  for (const Layer& layer : section.layers) append_line(xs, layer.polygon);
  for (const Line& line : section.excavations) append_excavation(xs, line, section);
  sort_unique(xs);
  std::vector<Column> columns;
  for (std::size_t k = 0; k + 1 < xs.size(); ++k) {
    Column column{xs[k], xs[k + 1], {}};
    for (std::size_t i = 0; i < section.layers.size(); ++i)
      append_pieces(section.layers[i], static_cast<int>(i), column.left, column.right, column.pieces);
    open_for_inner(inner, column.pieces);
    for (const Line& line : section.excavations) excavate(line, column);
    std::sort(column.pieces.begin(), column.pieces.end(),
              [](const Piece& a, const Piece& b) { return a.top[0] + a.top[1] > b.top[0] + b.top[1]; });
    columns.push_back(std::move(column));
  }
  return columns;
}

std::vector<double> kinks(const Section& section, const std::vector<Column>& columns) {
  std::vector<double> xs;
  xs.reserve(columns.size() + 1);
  for (const Column& column : columns) xs.push_back(column.left);
  xs.push_back(columns.back().right);
  append_line(xs, section.water.phreatic);
  for (const ReferenceLine& reference : section.water.references) append_line(xs, reference.line);
  for (const StripLoad& load : section.strip_loads) {
    xs.push_back(load.from);
    xs.push_back(load.to);
  }
  // Where the water table meets the ground, free water begins.
  if (!section.water.phreatic.empty()) {
    sort_unique(xs);
    std::vector<double> shores;
    for (const Column& column : columns) {
      const Piece& top = column.pieces.front();
      const Point a{column.left, top.top[0]}, b{column.right, top.top[1]};
      const auto first = std::lower_bound(xs.begin(), xs.end(), column.left);
      for (auto x = first; x != xs.end() && *x < column.right && x + 1 != xs.end(); ++x) {
        const double x0 = *x, x1 = std::min(*(x + 1), column.right);
        const double g0 = a[1] + (x0 - a[0]) / (b[0] - a[0]) * (b[1] - a[1]) - level(section.water.phreatic, x0);
        const double g1 = a[1] + (x1 - a[0]) / (b[0] - a[0]) * (b[1] - a[1]) - level(section.water.phreatic, x1);
        if (g0 * g1 < 0) shores.push_back(x0 + g0 / (g0 - g1) * (x1 - x0));
      }
    }
    xs.insert(xs.end(), shores.begin(), shores.end());
  }
  sort_unique(xs);
  return xs;
}

double at(const double (&ends)[2], const Column& column, double x) {
  return ends[0] + (x - column.left) / (column.right - column.left) * (ends[1] - ends[0]);
}

}  // namespace

PreparedSection prepare(Section section) {
  std::vector<std::string> problems = check_data(section);
  PreparedSection prepared;
  if (problems.empty()) {
    prepared.columns = cut(section);
    problems = check_columns(section, prepared.columns);
  }
  if (!problems.empty()) {
    std::string message = "The section cannot be computed:";
    for (const std::string& problem : problems) message += "\n  " + problem;
    throw std::invalid_argument(message);
  }
  prepared.breaks = kinks(section, prepared.columns);
  prepared.states.resize(section.layers.size());
  for (std::size_t i = 0; i < section.state_points.size(); ++i)
    prepared.states[static_cast<std::size_t>(section.state_points[i].layer)].push_back(static_cast<int>(i));
  for (std::vector<int>& states : prepared.states)
    std::sort(states.begin(), states.end(), [&](int a, int b) {
      return section.state_points[static_cast<std::size_t>(a)].at[0] <
             section.state_points[static_cast<std::size_t>(b)].at[0];
    });
  for (Section& before : section.before) prepared.before.push_back(prepare(std::move(before)));
  section.before.clear();
  prepared.section = std::move(section);
  return prepared;
}

std::size_t column_at(const PreparedSection& prepared, double x) {
  const auto& columns = prepared.columns;
  const auto right =
      std::upper_bound(columns.begin(), columns.end(), x, [](double v, const Column& c) { return v < c.left; });
  const auto index = right - columns.begin();
  return index > 0 ? static_cast<std::size_t>(index - 1) : 0;
}

double ground_level(const PreparedSection& prepared, double x) {
  const Column& column = prepared.columns[column_at(prepared, x)];
  return at(column.pieces.front().top, column, x);
}

double bottom_level(const PreparedSection& prepared, double x) {
  const Column& column = prepared.columns[column_at(prepared, x)];
  return at(column.pieces.back().base, column, x);
}

int layer_at(const PreparedSection& prepared, double x, double z) {
  const Column& column = prepared.columns[column_at(prepared, x)];
  if (z > at(column.pieces.front().top, column, x)) return -1;
  for (const Piece& piece : column.pieces)
    if (z >= at(piece.base, column, x)) return piece.layer;
  return -1;
}

double soil_weight(const PreparedSection& prepared, double x, double z) {
  const Section& section = prepared.section;
  const Column& column = prepared.columns[column_at(prepared, x)];
  const double water = section.water.phreatic.empty() ? -1e30 : level(section.water.phreatic, x);
  double weight = 0;
  for (const Piece& piece : column.pieces) {
    const double top = at(piece.top, column, x);
    if (top <= z) break;
    const double base = std::max(at(piece.base, column, x), z);
    const double wet = std::clamp(water - base, 0.0, top - base);
    const Soil& soil =
        section.soils[static_cast<std::size_t>(section.layers[static_cast<std::size_t>(piece.layer)].soil)];
    weight += soil.saturated_unit_weight * wet + soil.unit_weight * (top - base - wet);
  }
  return weight;
}

double free_water_pressure(const PreparedSection& prepared, double x) {
  const WaterNet& water = prepared.section.water;
  if (water.phreatic.empty()) return 0;
  return water.unit_weight * std::max(0.0, level(water.phreatic, x) - ground_level(prepared, x));
}

double pore_pressure(const PreparedSection& prepared, double x, double z) {
  const Section& section = prepared.section;
  if (!section.pressures.empty()) return pore_pressure(section.pressures, section.water.max_suction, x, z);
  return pore_pressure(section.water, x, z, ground_level(prepared, x));
}

bool buried(const PreparedSection& prepared, const LineLoad& load) {
  constexpr double rounding = 0.005;  // m; drawings are rounded to millimetres
  return load.at[1] < ground_level(prepared, load.at[0]) - rounding;
}

LoadStress load_stress(const PreparedSection& prepared, double x, double z, double width, int layer) {
  LoadStress stress;
  const Line& table = prepared.section.water.phreatic;
  const bool wet = !table.empty() && z < level(table, x);  // only pores full of water can carry the load
  const auto add = [&](double from, double to, double force, const std::vector<double>& consolidation) {
    const double overlap = std::min(to, x + width / 2) - std::max(from, x - width / 2);
    if (overlap <= 0) return;
    const double vertical = force / (to - from) * overlap / width;
    stress.vertical += vertical;
    if (wet && layer >= 0 && static_cast<std::size_t>(layer) < consolidation.size())
      stress.excess_pressure += vertical * (1 - consolidation[static_cast<std::size_t>(layer)]);
  };
  for (const StripLoad& load : prepared.section.strip_loads) {
    const double depth = std::max(0.0, ground_level(prepared, std::clamp(x, load.from, load.to)) - z);
    const double reach = depth * std::tan(load.spread);
    add(load.from - reach, load.to + reach, load.pressure * (load.to - load.from), load.consolidation);
  }
  for (const LineLoad& load : prepared.section.line_loads) {
    if (load.at[1] < z && buried(prepared, load)) continue;  // it presses on what is under it
    const double reach = std::max(width / 2, std::max(0.0, load.at[1] - z) * std::tan(load.spread));
    add(load.at[0] - reach, load.at[0] + reach, load.force * std::cos(load.angle), load.consolidation);
  }
  return stress;
}

double vertical_effective_stress(const PreparedSection& prepared, double x, double z) {
  const LoadStress load = load_stress(prepared, x, z, 1e-3, layer_at(prepared, x, z));
  return soil_weight(prepared, x, z) + free_water_pressure(prepared, x) + load.vertical - load.excess_pressure -
         pore_pressure(prepared, x, z);
}

void append_crossings(const PreparedSection& prepared, const Point& a, const Point& b, std::vector<double>& crossings) {
  const Column& column = prepared.columns[column_at(prepared, (a[0] + b[0]) / 2)];
  const auto add = [&](double above_a, double above_b) {
    if (above_a * above_b < 0) crossings.push_back(a[0] + above_a / (above_a - above_b) * (b[0] - a[0]));
  };
  for (const Piece& piece : column.pieces)
    add(at(piece.base, column, a[0]) - a[1], at(piece.base, column, b[0]) - b[1]);
  const Line& phreatic = prepared.section.water.phreatic;
  if (!phreatic.empty()) add(level(phreatic, a[0]) - a[1], level(phreatic, b[0]) - b[1]);
}

}  // namespace polder::stability
