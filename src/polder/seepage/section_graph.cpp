#include "polder/seepage/section_graph.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace polder {
namespace {

struct Builder {
  double tolerance;
  SectionGraph graph;

  int vertex(const Point2& p) {
    for (int i = 0; i < static_cast<int>(graph.vertices.size()); ++i)
      if (std::hypot(graph.vertices[i][0] - p[0], graph.vertices[i][1] - p[1]) <= tolerance) return i;
    graph.vertices.push_back(p);
    return static_cast<int>(graph.vertices.size()) - 1;
  }

  void chain(const std::vector<Point2>& points, bool closed, bool cut) {
    for (std::size_t i = 0; i + (closed ? 0 : 1) < points.size(); ++i) {
      const int a = vertex(points[i]), b = vertex(points[(i + 1) % points.size()]);
      if (a != b) graph.segments.push_back({a, b, cut});
    }
  }

  /// Adds a vertex wherever two segments cross.
  void cross_all() {
    const std::size_t count = graph.segments.size();
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = i + 1; j < count; ++j) {
        const Point2 p = graph.vertices[graph.segments[i].a], q = graph.vertices[graph.segments[i].b],
                     r = graph.vertices[graph.segments[j].a], s = graph.vertices[graph.segments[j].b];
        const double ux = q[0] - p[0], uy = q[1] - p[1], vx = s[0] - r[0], vy = s[1] - r[1];
        const double det = ux * vy - uy * vx;
        if (std::abs(det) <= 1e-12 * std::hypot(ux, uy) * std::hypot(vx, vy)) continue;
        const double t = ((r[0] - p[0]) * vy - (r[1] - p[1]) * vx) / det;
        const double w = ((r[0] - p[0]) * uy - (r[1] - p[1]) * ux) / det;
        if (t >= 0 && t <= 1 && w >= 0 && w <= 1) vertex({p[0] + t * ux, p[1] + t * uy});
      }
  }

  /// Splits every segment at the vertices that lie on it, and drops duplicates.
  void split_all() {
    std::map<std::pair<int, int>, bool> pieces;
    for (const auto& s : graph.segments) {
      const Point2 a = graph.vertices[s.a], b = graph.vertices[s.b];
      const double length2 = std::pow(b[0] - a[0], 2) + std::pow(b[1] - a[1], 2);
      std::vector<std::pair<double, int>> on;
      for (int v = 0; v < static_cast<int>(graph.vertices.size()); ++v) {
        const Point2& p = graph.vertices[v];
        if (distance_to_segment(p, a, b) <= tolerance)
          on.push_back({((p[0] - a[0]) * (b[0] - a[0]) + (p[1] - a[1]) * (b[1] - a[1])) / length2, v});
      }
      std::sort(on.begin(), on.end());
      for (std::size_t i = 0; i + 1 < on.size(); ++i) {
        bool& cut = pieces[std::minmax(on[i].second, on[i + 1].second)];
        cut = cut || s.cut;
      }
    }
    graph.segments.clear();
    for (const auto& [ends, cut] : pieces) graph.segments.push_back({ends.first, ends.second, cut});
  }
};

}  // namespace

SectionGraph section_graph(const MeshRequest& request) {
  Point2 low{1e300, 1e300}, high{-1e300, -1e300};
  for (const auto& polygon : request.polygons)
    for (const auto& p : polygon)
      for (int k = 0; k < 2; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  const double extent = std::max(high[0] - low[0], high[1] - low[1]);
  if (!(extent > 0)) throw std::invalid_argument("mesh: no soil polygon with an area; give at least one [[soil]]");
  Builder builder{1e-6 * extent, {}};
  for (const auto& polygon : request.polygons) builder.chain(polygon, true, false);
  for (const auto& line : request.lines) builder.chain(line, false, false);
  for (const auto& line : request.cuts) builder.chain(line, false, true);
  builder.cross_all();
  builder.split_all();
  return builder.graph;
}

}  // namespace polder
