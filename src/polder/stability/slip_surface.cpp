#include <algorithm>
#include <cmath>

#include "polder/stability/lines.hpp"
#include "polder/stability/slices.hpp"

namespace polder::stability {
namespace {

double arc_level(const Point& centre, double radius, double x) {
  const double dx = x - centre[0];
  return centre[1] - std::sqrt(std::max(0.0, radius * radius - dx * dx));
}

// x where the lower half of a circle meets the ground, ascending.
std::vector<double> ground_crossings(const PreparedSection& prepared, const Point& centre, double radius) {
  std::vector<double> xs;
  const double low = centre[0] - radius, high = centre[0] + radius;
  for (std::size_t i = column_at(prepared, low); i < prepared.columns.size(); ++i) {
    const Column& column = prepared.columns[i];
    if (column.left > high) break;
    const double z0 = column.pieces.front().top[0], z1 = column.pieces.front().top[1];
    const double slope = (z1 - z0) / (column.right - column.left);
    // |(x, z0 + slope (x − left)) − centre| = radius
    const double offset = z0 - slope * column.left - centre[1];
    const double a = 1 + slope * slope, b = slope * offset - centre[0];
    const double c = centre[0] * centre[0] + offset * offset - radius * radius;
    const double discriminant = b * b - a * c;
    if (discriminant <= 0) continue;
    for (const double sign : {-1.0, 1.0}) {
      const double x = (-b + sign * std::sqrt(discriminant)) / a;
      if (x < column.left || x >= column.right || slope * x + offset > 0) continue;
      xs.push_back(x);
    }
  }
  return xs;
}

SlipSurface no_surface(SurfaceKind kind, const char* problem) {
  SlipSurface surface;
  surface.kind = kind;
  surface.problem = problem;
  return surface;
}

}  // namespace

double base_level(const SlipSurface& surface, double x) {
  if (surface.kind == SurfaceKind::circle) return arc_level(surface.circle.centre, surface.circle.radius, x);
  if (surface.kind == SurfaceKind::free) return level(surface.points, x);
  const UpliftVanPlane& plane = surface.plane;
  const bool active_left = plane.active[0] <= plane.passive[0];
  const Point& left = active_left ? plane.active : plane.passive;
  const Point& right = active_left ? plane.passive : plane.active;
  if (x < left[0]) return arc_level(left, left[1] - plane.tangent, x);
  if (x > right[0]) return arc_level(right, right[1] - plane.tangent, x);
  return plane.tangent;
}

SlipSurface circle_surface(const PreparedSection& prepared, const Circle& circle) {
  SlipSurface surface;
  surface.circle = circle;
  const std::vector<double> xs = ground_crossings(prepared, circle.centre, circle.radius);
  for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
    const double middle = (xs[i] + xs[i + 1]) / 2;
    if (xs[i + 1] - xs[i] <= surface.right - surface.left) continue;
    if (arc_level(circle.centre, circle.radius, middle) < ground_level(prepared, middle))
      surface.left = xs[i], surface.right = xs[i + 1];
  }
  if (surface.right - surface.left < 1e-6) surface.problem = "the circle does not enter and leave the ground";
  return surface;
}

SlipSurface uplift_van_surface(const PreparedSection& prepared, const UpliftVanPlane& plane) {
  SlipSurface surface;
  surface.kind = SurfaceKind::uplift_van;
  surface.plane = plane;
  const bool active_left = plane.active[0] <= plane.passive[0];
  const Point& left = active_left ? plane.active : plane.passive;
  const Point& right = active_left ? plane.passive : plane.active;
  if (left[1] <= plane.tangent || right[1] <= plane.tangent)
    return no_surface(surface.kind, "a centre lies below the horizontal plane");
  if (left[0] <= prepared.left() || right[0] >= prepared.right())
    return no_surface(surface.kind, "a centre lies outside the section");
  if (ground_level(prepared, left[0]) <= plane.tangent || ground_level(prepared, right[0]) <= plane.tangent)
    return no_surface(surface.kind, "the horizontal plane lies above the ground");
  const std::vector<double> starts = ground_crossings(prepared, left, left[1] - plane.tangent);
  const std::vector<double> ends = ground_crossings(prepared, right, right[1] - plane.tangent);
  const auto start = std::upper_bound(starts.begin(), starts.end(), left[0]);
  const auto end = std::lower_bound(ends.begin(), ends.end(), right[0]);
  if (start == starts.begin() || end == ends.end())
    return no_surface(surface.kind, "a circle does not reach the ground");
  surface.left = *(start - 1);
  surface.right = *end;
  return surface;
}

SlipSurface free_surface(const PreparedSection& prepared, const Line& points) {
  if (points.size() < 2) return no_surface(SurfaceKind::free, "a free surface needs at least two points");
  for (std::size_t i = 1; i < points.size(); ++i)
    if (points[i][0] <= points[i - 1][0])
      return no_surface(SurfaceKind::free, "the points of a free surface must go from left to right");
  const double left = std::max(points.front()[0], prepared.left());
  const double right = std::min(points.back()[0], prepared.right());
  // Depth below the ground at every kink of either line; it is linear between them.
  std::vector<double> xs{left, right};
  for (const Point& p : points)
    if (p[0] > left && p[0] < right) xs.push_back(p[0]);
  for (const double x : prepared.breaks)
    if (x > left && x < right) xs.push_back(x);
  std::sort(xs.begin(), xs.end());
  const auto depth = [&](double x) { return ground_level(prepared, x) - level(points, x); };
  double deepest = 0, at = left;
  for (const double x : xs)
    if (depth(x) > deepest) deepest = depth(x), at = x;
  if (deepest < 1e-6) return no_surface(SurfaceKind::free, "the free surface lies above the ground");
  SlipSurface surface;
  surface.kind = SurfaceKind::free;
  surface.left = left, surface.right = right;
  constexpr double at_ground = 0.02;  // m; ends drawn this close to the ground count as on it
  const auto found = static_cast<std::size_t>(std::find(xs.begin(), xs.end(), at) - xs.begin());
  bool starts = depth(left) < at_ground, ends = depth(right) < at_ground;
  for (std::size_t i = found; i > 0; --i)
    if (const double d0 = depth(xs[i - 1]), d1 = depth(xs[i]); d0 < 0) {
      surface.left = xs[i - 1] - d0 / (d1 - d0) * (xs[i] - xs[i - 1]);
      starts = true;
      break;
    }
  for (std::size_t i = found; i + 1 < xs.size(); ++i)
    if (const double d0 = depth(xs[i]), d1 = depth(xs[i + 1]); d1 < 0) {
      surface.right = xs[i] + d0 / (d0 - d1) * (xs[i + 1] - xs[i]);
      ends = true;
      break;
    }
  if (!starts || !ends) return no_surface(SurfaceKind::free, "an end of the free surface lies below the ground");
  surface.points.push_back({surface.left, level(points, surface.left)});
  for (const Point& p : points)
    if (p[0] > surface.left && p[0] < surface.right) surface.points.push_back(p);
  surface.points.push_back({surface.right, level(points, surface.right)});
  return surface;
}

}  // namespace polder::stability
