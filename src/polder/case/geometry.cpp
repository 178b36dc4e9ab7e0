#include "polder/case/geometry.hpp"

#include <algorithm>
#include <cmath>

namespace polder {
namespace {

double cross(Point2 o, Point2 a, Point2 b) { return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]); }

bool on_segment(Point2 a, Point2 b, Point2 p) {
  return cross(a, b, p) == 0 && std::min(a[0], b[0]) <= p[0] && p[0] <= std::max(a[0], b[0]) &&
         std::min(a[1], b[1]) <= p[1] && p[1] <= std::max(a[1], b[1]);
}

/// Where segments ab and cd meet, end points included.
std::optional<Point2> meeting(Point2 a, Point2 b, Point2 c, Point2 d) {
  const double c1 = cross(a, b, c), c2 = cross(a, b, d), c3 = cross(c, d, a), c4 = cross(c, d, b);
  if (((c1 > 0 && c2 < 0) || (c1 < 0 && c2 > 0)) && ((c3 > 0 && c4 < 0) || (c3 < 0 && c4 > 0))) {
    const double t = c3 / (c3 - c4);
    return Point2{a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
  }
  if (on_segment(a, b, c)) return c;
  if (on_segment(a, b, d)) return d;
  if (on_segment(c, d, a)) return a;
  if (on_segment(c, d, b)) return b;
  return {};
}

/// Heights where the vertical through x, which passes no corner, enters and leaves the polygon, from below.
std::vector<double> crossings(std::span<const Point2> polygon, double x) {
  std::vector<double> heights;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    if ((a[0] < x) != (b[0] < x)) heights.push_back(a[1] + (x - a[0]) / (b[0] - a[0]) * (b[1] - a[1]));
  }
  std::sort(heights.begin(), heights.end());
  return heights;
}

}  // namespace

bool contains(std::span<const Point2> polygon, Point2 p) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    // Each edge from its lower end upwards, whatever the sense, so that neighbours round alike.
    Point2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    if (a[1] > b[1]) std::swap(a, b);
    if (a[1] <= p[1] && p[1] < b[1] && cross(a, b, p) > 0) inside = !inside;
    // cross > 0: the point is left of the edge; a point on it counts as right of it.
  }
  return inside;
}

bool contains(const Region& region, double x, double y, double height) {
  return region.across[0] <= y && y < region.across[1] && contains(region.polygon, {x, height});
}

double signed_area(std::span<const Point2> polygon) {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) twice += cross(polygon[0], polygon[i], polygon[i + 1]);
  return 0.5 * twice;
}

double area(std::span<const Point2> polygon) { return std::abs(signed_area(polygon)); }

std::optional<Point2> self_intersection(std::span<const Point2> polygon) {
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point2 a = polygon[i], b = polygon[(i + 1) % n], after = polygon[(i + 2) % n];
    if (a == b) return a;
    const double back = (a[0] - b[0]) * (after[0] - b[0]) + (a[1] - b[1]) * (after[1] - b[1]);
    if (cross(a, b, after) == 0 && back > 0) return b;  // folds back on itself
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      if (const auto p = meeting(a, b, polygon[j], polygon[(j + 1) % n])) return p;
    }
  }
  return {};
}

Bounds bounds(std::span<const Point2> points) {
  Bounds box{points[0], points[0]};
  for (const Point2& p : points)
    for (std::size_t k = 0; k < 2; ++k) {
      box.low[k] = std::min(box.low[k], p[k]);
      box.high[k] = std::max(box.high[k], p[k]);
    }
  return box;
}

Overlap overlap(std::span<const Point2> a, std::span<const Point2> b) {
  std::vector<double> cuts;
  for (const auto& polygon : {a, b})
    for (const Point2& p : polygon) cuts.push_back(p[0]);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j)
      if (const auto p = meeting(a[i], a[(i + 1) % a.size()], b[j], b[(j + 1) % b.size()])) cuts.push_back((*p)[0]);
  std::sort(cuts.begin(), cuts.end());
  Overlap result;
  double widest = 0;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    const double width = cuts[k + 1] - cuts[k], x = 0.5 * (cuts[k] + cuts[k + 1]);
    if (!(width > 0)) continue;
    // Edges do not cross within a slab, so the common height varies linearly and its value half-way is its mean.
    const auto ya = crossings(a, x), yb = crossings(b, x);
    for (std::size_t i = 0; i + 1 < ya.size(); i += 2)
      for (std::size_t j = 0; j + 1 < yb.size(); j += 2) {
        const double low = std::max(ya[i], yb[j]), high = std::min(ya[i + 1], yb[j + 1]);
        if (high <= low) continue;
        const double piece = width * (high - low);
        result.area += piece;
        if (piece > widest) {
          widest = piece;
          result.inside = {x, 0.5 * (low + high)};
        }
      }
  }
  return result;
}

double height_at(std::span<const Point2> line, double x) {
  if (x <= line.front()[0]) return line.front()[1];
  for (std::size_t i = 1; i < line.size(); ++i)
    if (x <= line[i][0]) {
      const double t = (x - line[i - 1][0]) / (line[i][0] - line[i - 1][0]);
      return line[i - 1][1] + t * (line[i][1] - line[i - 1][1]);
    }
  return line.back()[1];
}

std::vector<Point2> clip(std::span<const Point2> polygon, Point2 normal, double d) {
  std::vector<Point2> kept;
  const auto excess = [&](Point2 p) { return normal[0] * p[0] + normal[1] * p[1] - d; };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double ea = excess(a), eb = excess(b);
    if (ea <= 0) kept.push_back(a);
    if ((ea < 0 && eb > 0) || (ea > 0 && eb < 0)) {
      const double t = ea / (ea - eb);
      kept.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
    }
  }
  return kept;
}

std::vector<Point2> clip(std::span<const Point2> polygon, const Bounds& box) {
  std::vector<Point2> part(polygon.begin(), polygon.end());
  for (std::size_t k = 0; k < 2; ++k) {
    Point2 axis{};
    axis[k] = 1;
    part = clip(part, axis, box.high[k]);
    axis[k] = -1;
    part = clip(part, axis, -box.low[k]);
  }
  return part;
}

}  // namespace polder
