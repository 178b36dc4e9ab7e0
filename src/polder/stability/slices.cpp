#include "polder/stability/slices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "polder/stability/lines.hpp"
#include "polder/stability/strength.hpp"

namespace polder::stability {
namespace {

constexpr double sliver = 1e-7;     // m; edges closer than this are one
constexpr double at_bottom = 5e-3;  // m; a surface may graze the base of the section by this much

void sort_edges(std::vector<double>& edges) {
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end(), [](double a, double b) { return b - a < sliver; }), edges.end());
}

std::vector<double> slice_edges(const PreparedSection& prepared, const SlipSurface& surface, double left, double right,
                                int count) {
  std::vector<double> edges{left, right};
  const auto add = [&](double x) {
    if (x > left && x < right) edges.push_back(x);
  };
  const auto first = std::upper_bound(prepared.breaks.begin(), prepared.breaks.end(), left);
  for (auto x = first; x != prepared.breaks.end() && *x < right; ++x) edges.push_back(*x);
  for (const Point& p : surface.points) add(p[0]);
  if (surface.kind == SurfaceKind::uplift_van) {
    add(surface.plane.active[0]);
    add(surface.plane.passive[0]);
  }
  sort_edges(edges);

  const double widest = (right - left) / count;
  std::vector<double> fine;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const double span = edges[i + 1] - edges[i];
    const int parts = std::max(1, static_cast<int>(std::ceil(span / widest - 1e-9)));
    for (int k = 0; k < parts; ++k) fine.push_back(edges[i] + span * k / parts);
  }
  fine.push_back(edges.back());

  std::vector<double> crossings;
  for (std::size_t i = 0; i + 1 < fine.size(); ++i)
    append_crossings(prepared, {fine[i], base_level(surface, fine[i])}, {fine[i + 1], base_level(surface, fine[i + 1])},
                     crossings);
  fine.insert(fine.end(), crossings.begin(), crossings.end());
  sort_edges(fine);
  return fine;
}

// Where the tension crack ends the surface on its high side.
double crack_end(const PreparedSection& prepared, const SlipSurface& surface, double high, double low) {
  const double depth = prepared.section.crack.depth;
  const auto open = [&](double x) { return ground_level(prepared, x) - base_level(surface, x) < depth; };
  double shallow = high, deep = high;
  const int steps = 400;
  for (int k = 1; k <= steps && open(deep); ++k) {
    shallow = deep;
    deep = high + (low - high) * k / steps;
  }
  for (int k = 0; k < 60; ++k) {
    const double middle = (shallow + deep) / 2;
    (open(middle) ? shallow : deep) = middle;
  }
  return deep;
}

void add_forces(const PreparedSection& prepared, double direction, Slice& slice) {
  const Section& section = prepared.section;
  const double x = slice.middle(), base = std::max(slice.base(), bottom_level(prepared, slice.middle()));
  const int layer = layer_at(prepared, x, base);
  slice.weight = soil_weight(prepared, x, base) * slice.width;
  const LoadStress load = load_stress(prepared, x, base, slice.width, layer);
  slice.load = load.vertical * slice.width;
  const double water = free_water_pressure(prepared, x);
  slice.free_water = water * slice.width;
  slice.vertical = slice.weight * (1 - section.earthquake.vertical) + slice.load + slice.free_water;

  // Horizontal forces and the moment of each, gathered into one force at one height.
  double force = 0, moment = 0;
  const auto add = [&](double f, double z) { force += f, moment += f * z; };
  add(section.earthquake.horizontal * slice.weight, (slice.top() + base) / 2);
  add(direction * water * (slice.top_right - slice.top_left), slice.top());
  for (const LineLoad& line : section.line_loads) {
    if (line.at[1] < base && buried(prepared, line)) continue;
    const double reach = std::max(0.0, line.at[1] - base) * std::tan(line.spread);
    const double half = std::max(reach, slice.width / 2);
    const double share =
        (std::min(line.at[0] + half, slice.right) - std::max(line.at[0] - half, slice.left)) / (2 * half);
    if (share > 0) add(direction * share * line.force * std::sin(line.angle), line.at[1]);
  }
  slice.horizontal = force;
  slice.horizontal_level = std::abs(force) > 1e-9 ? moment / force : slice.top();

  slice.pore_pressure = pore_pressure(prepared, x, base) + load.excess_pressure;
  slice.effective_stress = slice.vertical / slice.width - slice.pore_pressure;
  const PointStrength strength = strength_at(prepared, x, base, slice.effective_stress);
  slice.cohesion = strength.cohesion;
  slice.tan_friction = strength.tan_friction;
  slice.yield_stress = strength.yield_stress;
  slice.layer = strength.layer;
}

}  // namespace

Slices cut_slices(const PreparedSection& prepared, const SlipSurface& surface, int count) {
  Slices slices;
  double left = surface.left, right = surface.right;
  const double z_left = base_level(surface, left), z_right = base_level(surface, right);
  switch (prepared.section.movement) {
    case Movement::automatic:
      slices.direction = z_left >= z_right ? 1 : -1;
      break;
    case Movement::left:
      slices.direction = -1;
      break;
    case Movement::right:
      slices.direction = 1;
      break;
  }
  if (surface.kind == SurfaceKind::uplift_van)
    slices.direction = surface.plane.active[0] <= surface.plane.passive[0] ? 1 : -1;
  const TensionCrack& crack = prepared.section.crack;
  if (crack.depth > 0) {
    double& high = slices.direction > 0 ? left : right;
    high = crack_end(prepared, surface, high, slices.direction > 0 ? right : left);
    if (right - left < 1e-6) {
      slices.problem = "the surface is nowhere deeper than the tension crack";
      return slices;
    }
    const double water = crack.depth * crack.water;
    slices.entry_force = prepared.section.water.unit_weight * water * water / 2;
    slices.entry_level = base_level(surface, high) + water / 3;
  }

  const std::vector<double> edges = slice_edges(prepared, surface, left, right, count);
  slices.list.reserve(edges.size());
  double x0 = edges.front(), b0 = base_level(surface, x0), t0 = ground_level(prepared, x0);
  for (std::size_t i = 1; i < edges.size(); ++i) {
    Slice slice;
    slice.left = x0, slice.base_left = b0, slice.top_left = t0;
    slice.right = x0 = edges[i];
    slice.base_right = b0 = base_level(surface, x0);
    slice.top_right = t0 = ground_level(prepared, x0);
    slice.width = slice.right - slice.left;
    const double drop = slices.direction * (slice.base_left - slice.base_right);
    slice.length = std::hypot(slice.width, drop);
    slice.angle = std::atan2(drop, slice.width);
    if (slice.top() < slice.base() - 1e-3) {
      slices.problem = fmt::format("the surface comes out of the ground at x = {:.2f} m", slice.middle());
      return slices;
    }
    if (slice.base() < bottom_level(prepared, slice.middle()) - at_bottom) {
      slices.problem = fmt::format("the surface leaves the section at its base at x = {:.2f} m", slice.middle());
      return slices;
    }
    add_forces(prepared, slices.direction, slice);
    slices.list.push_back(slice);
  }
  if (slices.direction < 0) std::reverse(slices.list.begin(), slices.list.end());
  return slices;
}

std::string broken_limit(const PreparedSection& prepared, const SlipSurface& surface, const Slices& slices) {
  const SlipLimits& limits = prepared.section.limits;
  const bool to_right = slices.direction > 0;
  const double entry = to_right ? surface.left : surface.right, exit = to_right ? surface.right : surface.left;
  if (limits.entry && (entry < (*limits.entry)[0] || entry > (*limits.entry)[1])) return "entry";
  if (limits.exit && (exit < (*limits.exit)[0] || exit > (*limits.exit)[1])) return "exit";
  if (surface.right - surface.left < limits.minimum_length) return "minimum length";
  double deepest = 0;
  for (const Slice& slice : slices.list) deepest = std::max(deepest, slice.top() - slice.base());
  if (deepest < limits.minimum_depth) return "minimum depth";
  for (const Slice& slice : slices.list) {
    const Point a{slice.left, slice.base_left}, b{slice.right, slice.base_right};
    for (const Line& line : limits.forbidden_lines)
      for (std::size_t i = 0; i + 1 < line.size(); ++i)
        if (segments_cross(a, b, line[i], line[i + 1])) return "forbidden line";
    for (const auto& zone : limits.forbidden_zones)
      if (inside(zone, {slice.middle(), slice.base()})) return "forbidden zone";
  }
  return {};
}

}  // namespace polder::stability
