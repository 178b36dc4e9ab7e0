#include "polder/step/ground_water.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "polder/step/cell_beside.hpp"
#include "polder/step/point_cells.hpp"
#include "polder/step/soil_volume.hpp"
#include "polder/step/unsaturated_transfer.hpp"

namespace polder {

namespace {

constexpr double film = 0.1;        // cells of water on the ground, over which its load comes
constexpr int uneven_depth = 4;     // cells under the ground whose weights are not their own volume
constexpr double least_top = 0.05;  // of a cell's volume: soil that makes it the uppermost of its column

/// Columns of cells, numbered along the horizontal axes; body(number, x in m, lowest cell).
template <class Space, class Body>
void over_columns(const Lattice<Space>& lattice, Body&& body) {
  const int deep = Space::axes == 3 ? lattice.cells[1] : 1;
  for (int j = 0; j < deep; ++j)
    for (int i = 0; i < lattice.cells[0]; ++i)
      body(static_cast<std::size_t>(j) * lattice.cells[0] + i, lattice.axis[0].centre(i),
           Space::axes == 3 ? lattice.index(i, j, 0) : lattice.index(i, 0));
}

/// Height, m, over the centre of cell i of an axis.
double over_centre(const GridAxis& axis, double height, int i) {
  return axis.graded() ? height - axis.centre(i) : height - (i + 0.5) * axis.least();
}

struct Surface {
  int level = -1;     ///< of the uppermost cell with soil; −1: none
  double height = 0;  ///< m
};

template <class Space>
Surface surface_of(const Setup<Space>& setup, const Array& bulk, std::ptrdiff_t lowest) {
  const auto& lattice = setup.lattice;
  Surface top;
  for (int level = 0; level < lattice.cells[Space::up]; ++level) {
    const std::ptrdiff_t cell = lowest + level * lattice.stride[Space::up];
    top.height += bulk[cell] / lattice.face_area(Space::up, lowest);
    if (bulk[cell] > least_top * lattice.cell_volume(cell)) top.level = level;
  }
  for (int level = 0; setup.bodies.any() && level <= top.level; ++level)  // that the soil lies on
    top.height +=
        (1 - setup.bodies.open_cell(lowest + level * lattice.stride[Space::up])) * lattice.axis[Space::up].width(level);
  return top;
}

/// How far along the line (0 at its first point, 1 at its last) x is, of a part that is not upright; < 0 beside it.
/// Also the line's height there and its length by a unit of x.
struct OnLine {
  double share = -1, height = 0, stretch = 1;
};
OnLine on_line(const std::vector<std::array<double, 2>>& line, double x) {
  double length = 0;
  for (std::size_t i = 1; i < line.size(); ++i)
    length += std::hypot(line[i][0] - line[i - 1][0], line[i][1] - line[i - 1][1]);
  double passed = 0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double dx = line[i][0] - line[i - 1][0], dy = line[i][1] - line[i - 1][1], part = std::hypot(dx, dy);
    const double t = dx != 0 ? (x - line[i - 1][0]) / dx : -1;
    if (t >= 0 && t <= 1) return {(passed + t * part) / length, line[i - 1][1] + t * dy, part / std::abs(dx)};
    passed += part;
  }
  return {};
}

double head_of(const SeepageCondition& condition, double time, double share) {
  const double first = condition.head(time);
  return condition.head_at_end ? first + share * ((*condition.head_at_end)(time)-first) : first;
}

}  // namespace

template <class Space>
Array ground_heights(const Setup<Space>& setup, const Array& bulk) {
  const auto& lattice = setup.lattice;
  Array heights(static_cast<std::size_t>(lattice.cells[0] * (Space::axes == 3 ? lattice.cells[1] : 1)), -1.0);
  over_columns(lattice, [&](std::size_t column, double, std::ptrdiff_t lowest) {
    const Surface top = surface_of(setup, bulk, lowest);
    if (top.level >= 0) heights[column] = top.height;
  });
  return heights;
}

template <class Space>
Array ground_heights(const Setup<Space>& setup, const SoilPoints<Space>& soil) {
  Array bulk = setup.lattice.make_array();
  for (std::size_t p = 0; p < soil.size(); ++p)
    PointCells<Space>(setup, position_of(soil, p), box_half(setup, soil, p))
        .over_cells(setup.lattice,
                    [&](std::ptrdiff_t cell, double share) { bulk[cell] += share * bulk_volume(setup, soil, p); });
  if (setup.periodic) fold(bulk, -1, false, setup.soil_box, setup.lattice);
  return ground_heights(setup, bulk);
}

template <class Space>
std::vector<int> ground_conditions(const Setup<Space>& setup, const SoilPoints<Space>& soil) {
  const auto& lattice = setup.lattice;
  Array bulk = lattice.make_array();
  for (std::size_t p = 0; p < soil.size(); ++p)
    bulk[cell_at(lattice, position_of(soil, p))] += bulk_volume(setup, soil, p);
  std::vector<int> ground(static_cast<std::size_t>(lattice.cells[0] * (Space::axes == 3 ? lattice.cells[1] : 1)), -1);
  over_columns(lattice, [&](std::size_t column, double x, std::ptrdiff_t lowest) {
    const Surface top = surface_of(setup, bulk, lowest);
    if (top.level < 0) return;
    double nearest = 1.5 * lattice.axis[Space::up].width(top.level);
    for (std::size_t i = 0; i < setup.pore_water.size(); ++i) {
      const OnLine at = on_line(setup.pore_water[i].line, x);
      if (at.share < 0 || std::abs(at.height - top.height) >= nearest) continue;
      nearest = std::abs(at.height - top.height);
      ground[column] = static_cast<int>(i);
    }
  });
  return ground;
}

namespace {

/// Where the ground rises by more than a cell from one column to the next, along `axis`, it has a side: what of it the
/// lower column leaves free is a seepage face, or under the water that stands there. `tops`: of the columns;
/// way(cell, axis, distance): a conductance.
template <class Space, class Way>
void step_exits(const Setup<Space>& setup, const std::vector<int>& ground, double dt, int axis,
                const std::vector<Surface>& tops, const PoreFields<Space>& pores, const GroundCover* cover, Way&& way,
                std::vector<PoreExit>& exits) {
  constexpr double unbounded = -std::numeric_limits<double>::infinity();
  const auto& lattice = setup.lattice;
  const GridAxis& upwards = lattice.axis[Space::up];
  const auto to_next = static_cast<std::ptrdiff_t>(axis == 0 ? 1 : lattice.cells[0]);  // column
  over_columns(lattice, [&](std::size_t column, double, std::ptrdiff_t lowest) {
    if (ground[column] >= 0 && setup.pore_water[ground[column]].kind != SeepageCondition::Kind::seepage) return;
    const int place = lattice.place(lowest, axis);
    const double half = 0.5 * lattice.axis[axis].width(place);
    for (const int way_to : {-1, 1}) {
      const std::ptrdiff_t beside = cell_beside(lattice, setup.soil_box, lowest, axis, way_to);
      if (beside < 0) continue;
      const auto lower = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(column) +
                                                  (lattice.place(beside, axis) - place) * to_next);
      const double foot = tops[lower].level < 0 ? 0 : tops[lower].height;
      for (int level = tops[column].level - 1; level >= 0 && upwards.edge(level) >= foot - 1e-6 * upwards.width(level);
           --level) {
        const std::ptrdiff_t cell = lowest + level * lattice.stride[Space::up];
        const std::ptrdiff_t face = way_to < 0 ? cell : cell + lattice.stride[axis];
        const double open = setup.shut(axis, face) ? 0 : setup.bodies.open_face(axis, face);
        if (!pores.active[cell] || pores.host[cell] >= 0 || !(open > 0)) continue;
        const double standing = pores.over_ground[cell + way_to * lattice.stride[axis]];
        PoreExit exit{cell, open * way(cell, axis, half),
                      standing - setup.water.density * setup.pull(axis) * way_to * half, 0};
        if (standing > 0) {
          exit.conductance *= 0.5 * (1 + 1 / std::max(pores.relative[cell], 1e-12));
          exit.least = cover ? -std::max(0.0, cover->available[lower]) / dt : unbounded;
        }
        if (cover) exit.column = static_cast<int>(lower);
        exits.push_back(exit);
      }
    }
  });
}

/// No more seeps in from a column's free water than there is, wherever it goes.
void share_available(std::vector<PoreExit>& exits, std::size_t columns) {
  std::vector<int> takers(columns, 0);
  for (const PoreExit& exit : exits)
    if (exit.column >= 0 && exit.least < 0) ++takers[static_cast<std::size_t>(exit.column)];
  for (PoreExit& exit : exits)
    if (exit.column >= 0 && exit.least < 0) exit.least /= takers[static_cast<std::size_t>(exit.column)];
}

}  // namespace

template <class Space>
std::vector<PoreExit> pore_exits(const Setup<Space>& setup, const std::vector<int>& ground, double time, double dt,
                                 double gravity, const PoreFields<Space>& pores, const GroundCover* cover) {
  using Kind = SeepageCondition::Kind;
  constexpr double unbounded = -std::numeric_limits<double>::infinity();
  const auto& lattice = setup.lattice;
  const GridAxis& upwards = lattice.axis[Space::up];
  const double weight = setup.water.density * gravity;
  std::vector<PoreExit> exits;
  // conductance of the way from a cell's centre to the outside at `distance` along `axis`
  const auto way = [&](std::ptrdiff_t cell, int axis, double distance) {
    return pores.relative[cell] * lattice.face_area(axis, cell) /
           (pores.resistance[axis == Space::up][cell] * distance);
  };
  std::vector<Surface> tops(ground.size());
  over_columns(lattice, [&](std::size_t column, double x, std::ptrdiff_t lowest) {
    const Surface top = tops[column] = surface_of(setup, pores.bulk, lowest);
    if (top.level < 0) return;
    const std::ptrdiff_t upper = lowest + top.level * lattice.stride[Space::up];
    const double above = over_centre(upwards, top.height, top.level);  // of the ground
    const SeepageCondition* given = ground[column] >= 0 ? &setup.pore_water[ground[column]] : nullptr;
    const Kind kind = given ? given->kind : Kind::seepage;
    const double open = setup.bodies.open_face(Space::up, upper + lattice.stride[Space::up]);  // no body lies on it
    if (kind != Kind::closed && open > 0) {
      PoreExit exit{upper, open * way(upper, Space::up, std::max(above, 0.25 * upwards.width(top.level))),
                    weight * above, 0};
      const OnLine at = given ? on_line(given->line, x) : OnLine{};
      if (kind == Kind::rain)
        exit.least = -open * given->rate(time) * at.stretch * lattice.face_area(Space::up, lowest);
      if (kind == Kind::head) {
        const double depth = head_of(*given, time, at.share) - top.height;
        if (depth > 0) exit.level += weight * depth, exit.least = unbounded;
      }
      if (cover && kind == Kind::seepage) {
        exit.column = static_cast<int>(column);
        exit.level += cover->pressure[column];
        exit.least = -cover->available[column] / dt;
        // what is under water conducts as saturated soil does, and so half of the way to the cell's centre
        if (cover->pressure[column] > 0) exit.conductance *= 0.5 * (1 + 1 / std::max(pores.relative[upper], 1e-12));
      }
      exits.push_back(exit);
    }
    const double h = upwards.width(0);
    for (const SeepageCondition& condition : setup.pore_water) {  // the base
      const OnLine at = on_line(condition.line, x);
      if (condition.kind == Kind::closed || at.share < 0 || at.height > 1e-6 * h || !pores.active[lowest]) continue;
      const double head = head_of(condition, time, at.share);
      const bool given_head = condition.kind == Kind::head;
      exits.push_back({lowest, way(lowest, Space::up, 0.5 * h),
                       given_head ? weight * (head - 0.5 * h) : -weight * 0.5 * h, given_head ? unbounded : 0});
    }
  });
  for (int axis = 0; axis < Space::up; ++axis) step_exits(setup, ground, dt, axis, tops, pores, cover, way, exits);
  if (cover) share_available(exits, cover->pressure.size());
  // the two ends of the model
  for (const SeepageCondition& condition : setup.pore_water) {
    if (condition.line.empty() || condition.kind == Kind::closed || condition.kind == Kind::rain) continue;
    const double x = condition.line.front()[0];
    const bool upright = std::all_of(condition.line.begin(), condition.line.end(),
                                     [&](const auto& p) { return std::abs(p[0] - x) < 1e-6 * lattice.spacing[0]; });
    const bool left = x<1e-6 * lattice.spacing[0], right = x> lattice.length(0) - 1e-6 * lattice.spacing[0];
    if (!upright || (!left && !right)) continue;
    double low = 1e300, high = -1e300;
    for (const auto& p : condition.line) low = std::min(low, p[1]), high = std::max(high, p[1]);
    const int deep = Space::axes == 3 ? lattice.cells[1] : 1, i = left ? 0 : lattice.cells[0] - 1;
    const double half = 0.5 * lattice.axis[0].width(i);
    const double lean = setup.water.density * setup.pull(0) * (left ? -half : half);  // Pa, from the centre to the end
    for (int j = 0; j < deep; ++j)
      for (int level = 0; level < lattice.cells[Space::up]; ++level) {
        const double y = upwards.centre(level);
        const std::ptrdiff_t cell = Space::axes == 3 ? lattice.index(i, j, level) : lattice.index(i, level);
        if (y < low || y > high || !pores.active[cell] || pores.host[cell] >= 0) continue;
        const double over = condition.kind == Kind::head ? head_of(condition, time, 0) - y : 0;
        exits.push_back({cell, way(cell, 0, half), weight * std::max(over, 0.0) - lean, over > 0 ? unbounded : 0});
      }
  }
  return exits;
}

template <class Space>
bool set_standing_water(const Setup<Space>& setup, const std::vector<int>& ground, double time, double gravity,
                        PoreFields<Space>& pores, const GroundCover* cover) {
  const auto& lattice = setup.lattice;
  const GridAxis& upwards = lattice.axis[Space::up];
  const double weight = setup.water.density * gravity;
  for (Array* field : pores.standing_water()) std::fill(field->begin(), field->end(), 0.0);
  // up to `level` from the cell `first` on; the ground ends in the cell `last`
  const auto stand = [&](std::ptrdiff_t lowest, int first, int last, double ground_height, double level) {
    const double flooded = last < 0 ? 1 : std::min(1.0, (level - ground_height) / (film * upwards.width(last)));
    for (int k = first; k < lattice.cells[Space::up] && (upwards.edge(k) < level || k <= last + 1); ++k) {
      const std::ptrdiff_t cell = lowest + k * lattice.stride[Space::up];
      if (setup.bodies.covered(cell)) continue;
      const double base = upwards.edge(k), top = upwards.edge(k + 1), tall = upwards.width(k);
      const double dry = k == last ? std::clamp(ground_height, base, top) : base;
      const double filled = level >= top ? 1 : std::max(0.0, (level - dry) / (top - dry));
      pores.over_ground[cell] = weight * std::max(0.0, level - upwards.centre(k));
      pores.over_side[cell] = weight * (filled == 1 ? level - upwards.centre(k) : 0.5 * tall * filled * filled);
      pores.over_face[cell] = weight * (level - base);
      pores.flooded[cell] = flooded;
    }
  };
  bool any = false;
  over_columns(lattice, [&](std::size_t column, double x, std::ptrdiff_t lowest) {
    const SeepageCondition* given = ground[column] >= 0 ? &setup.pore_water[ground[column]] : nullptr;
    const bool head = given && given->kind == SeepageCondition::Kind::head;
    if (cover && cover->bare[column] > 0) {
      any = true;
      stand(lowest, 0, -1, 0, cover->bare[column]);
      return;
    }
    if (!head && (!cover || cover->pressure[column] <= 0)) return;
    const Surface top = surface_of(setup, pores.bulk, lowest);
    const double level = head ? head_of(*given, time, on_line(given->line, x).share)
                              : top.height + cover->pressure[column] / std::max(weight, 1e-300);
    if (top.level < 0 || level <= top.height) return;
    if (setup.bodies.closed(Space::up, lowest + (top.level + 1) * lattice.stride[Space::up])) return;
    any = true;
    stand(lowest, std::max(0, top.level - uneven_depth), top.level, top.height, level);
  });
  return any;
}

#define POLDER_GROUND_WATER(Space)                                                                                   \
  template Array ground_heights(const Setup<Space>&, const Array&);                                                  \
  template Array ground_heights(const Setup<Space>&, const SoilPoints<Space>&);                                      \
  template std::vector<int> ground_conditions(const Setup<Space>&, const SoilPoints<Space>&);                        \
  template std::vector<PoreExit> pore_exits(const Setup<Space>&, const std::vector<int>&, double, double, double,    \
                                            const PoreFields<Space>&, const GroundCover*);                           \
  template bool set_standing_water(const Setup<Space>&, const std::vector<int>&, double, double, PoreFields<Space>&, \
                                   const GroundCover*);
POLDER_GROUND_WATER(PlaneStrain)
POLDER_GROUND_WATER(Solid)
#undef POLDER_GROUND_WATER

}  // namespace polder
