#include "polder/seepage/mesher.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "polder/seepage/delaunay.hpp"
#include "polder/seepage/mesh_finish.hpp"
#include "polder/seepage/section_graph.hpp"

namespace polder {
namespace {

/// Circumradius over shortest side above which a triangle is too thin (smallest angle about 24°).
constexpr double thin = 1.25;
/// Sides shorter than this share of the wanted size are not refined for shape: input angles below 60° end there.
constexpr double floor_share = 0.2;

using Edge = std::pair<int, int>;
Edge edge(int a, int b) { return std::minmax(a, b); }

struct Refiner {
  const MeshRequest& request;
  Delaunay d = empty_delaunay();
  std::vector<Point2> position{};   ///< m, per vertex of d
  std::vector<bool> acute{};        ///< vertex at which input segments meet at less than 90°
  std::map<Edge, bool> segments{};  ///< value: part of a cut
  std::vector<Edge> segment_queue{};
  std::vector<std::array<int, 3>> triangle_queue{};
  std::vector<FinerPoint> finer{};
  Point2 origin{};
  double scale = 1;  ///< lattice units per metre

  LatticePoint lattice(const Point2& p) const {
    return {std::llround((p[0] - origin[0]) * scale), std::llround((p[1] - origin[1]) * scale)};
  }
  double distance(int a, int b) const {
    return std::hypot(position[a][0] - position[b][0], position[a][1] - position[b][1]);
  }
  double size_at(const Point2& p) const {
    double h = request.size;
    for (const auto& f : finer) h = std::min(h, f.size + request.growth * std::hypot(p[0] - f.at[0], p[1] - f.at[1]));
    return h;
  }
  bool inside(const Point2& p) const {
    return std::any_of(request.polygons.begin(), request.polygons.end(),
                       [&](const auto& polygon) { return inside_polygon(polygon, p); });
  }

  int add(const Point2& p) {
    std::vector<int> created;
    const int v = insert(d, lattice(p), &created);
    if (v < static_cast<int>(position.size())) return v;
    position.push_back(p);
    acute.push_back(false);
    for (const int t : created) {
      const auto& tri = d.triangles[t];
      triangle_queue.push_back(tri.vertex);
      // The rim of the new fan: a segment there may now see the new vertex inside its circle.
      if (const auto it = segments.find(edge(tri.vertex[1], tri.vertex[2])); it != segments.end())
        segment_queue.push_back(it->first);
    }
    return v;
  }

  /// Whether `p` lies in the closed circle over the segment.
  bool in_diametral_circle(const Edge& s, const LatticePoint& p) const {
    const LatticePoint &a = d.points[s.first], &b = d.points[s.second];
    return (a[0] - p[0]) * (b[0] - p[0]) + (a[1] - p[1]) * (b[1] - p[1]) <= 0;
  }

  void split(const Edge& s) {
    const bool cut = segments.at(s);
    segments.erase(s);
    double share = 0.5;
    if (acute[s.first] != acute[s.second]) {
      // Concentric shells about an acute vertex, so that the two sides' pieces do not encroach on each other for ever.
      const double length = distance(s.first, s.second);
      const double shell = std::exp2(std::round(std::log2(length / 2)));
      share = acute[s.first] ? shell / length : 1 - shell / length;
    }
    const Point2 &a = position[s.first], &b = position[s.second];
    const int m = add({a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])});
    if (m == s.first || m == s.second) throw std::invalid_argument("mesh: outlines closer than the mesh can resolve");
    for (const Edge& piece : {edge(s.first, m), edge(m, s.second)}) {
      bool& is_cut = segments[piece];
      is_cut = is_cut || cut;
      segment_queue.push_back(piece);
    }
  }

  void examine(const Edge& s) {
    if (!segments.contains(s)) return;
    const auto left = find_edge(d, s.first, s.second), right = find_edge(d, s.second, s.first);
    if (left[0] < 0) return split(s);
    const Point2 middle{(position[s.first][0] + position[s.second][0]) / 2,
                        (position[s.first][1] + position[s.second][1]) / 2};
    const double h = size_at(middle), length = distance(s.first, s.second);
    if (length > 1.3 * h) return split(s);
    if (length < floor_share * h) return;
    for (const auto& side : {left, right})
      if (side[0] >= 0) {
        const int apex = d.triangles[side[0]].vertex[side[1]];
        if (apex >= Delaunay::corners && in_diametral_circle(s, d.points[apex])) return split(s);
      }
  }

  void examine(const std::array<int, 3>& v) {
    const auto found = find_edge(d, v[0], v[1]);
    if (found[0] < 0 || d.triangles[found[0]].vertex[found[1]] != v[2]) return;  // gone meanwhile
    if (v[0] < Delaunay::corners || v[1] < Delaunay::corners || v[2] < Delaunay::corners) return;
    const Point2 &a = position[v[0]], &b = position[v[1]], &c = position[v[2]];
    const Point2 centroid{(a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3};
    const double bx = b[0] - a[0], by = b[1] - a[1], cx = c[0] - a[0], cy = c[1] - a[1];
    const double twice = bx * cy - by * cx, b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
    if (twice <= 0) return;
    const Point2 offset{(cy * b2 - by * c2) / (2 * twice), (bx * c2 - cx * b2) / (2 * twice)};
    const double radius = std::hypot(offset[0], offset[1]);
    const double shortest = std::min({distance(v[0], v[1]), distance(v[1], v[2]), distance(v[2], v[0])});
    const double h = size_at(centroid);
    const bool big = radius > 0.72 * h;
    const bool bad_shape = radius > thin * shortest && shortest > floor_share * h;
    if ((!big && !bad_shape) || !inside(centroid)) return;

    const Point2 centre{a[0] + offset[0], a[1] + offset[1]};
    const LatticePoint p = lattice(centre);
    if (p[0] < 0 || p[1] < 0 || p[0] > Delaunay::extent || p[1] > Delaunay::extent) return;
    std::vector<Edge> encroached;
    for (const int t : cavity(d, p))
      for (int i = 0; i < 3; ++i) {
        const auto& w = d.triangles[t].vertex;
        const Edge s = edge(w[i], w[(i + 1) % 3]);
        if (segments.contains(s) && in_diametral_circle(s, p) &&
            std::find(encroached.begin(), encroached.end(), s) == encroached.end())
          encroached.push_back(s);
      }
    if (encroached.empty()) {
      if (inside(centre)) add(centre);
      return;
    }
    bool any = false;
    for (const Edge& s : encroached)
      if (distance(s.first, s.second) > 2 * floor_share * h && segments.contains(s)) split(s), any = true;
    if (any) triangle_queue.push_back(v);
  }

  void load(const SectionGraph& graph) {
    Point2 low{1e300, 1e300}, high{-1e300, -1e300};
    for (const auto& p : graph.vertices)
      for (int k = 0; k < 2; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
    origin = low;
    scale = static_cast<double>(Delaunay::extent) / std::max(high[0] - low[0], high[1] - low[1]);
    position.assign(Delaunay::corners, {0, 0});
    acute.assign(Delaunay::corners, false);
    finer = request.finer;
    std::vector<int> vertex;
    for (const auto& p : graph.vertices) vertex.push_back(add(p));
    for (const auto& s : graph.segments) {
      segments[edge(vertex[s.a], vertex[s.b])] = s.cut;
      if (const double length = distance(vertex[s.a], vertex[s.b]); length < request.size)
        for (const int v : {vertex[s.a], vertex[s.b]}) finer.push_back({position[v], length});
    }
    mark_acute(graph, vertex);
    for (const auto& [s, cut] : segments) segment_queue.push_back(s);
  }

  void mark_acute(const SectionGraph& graph, const std::vector<int>& vertex) {
    for (std::size_t i = 0; i < graph.segments.size(); ++i)
      for (std::size_t j = i + 1; j < graph.segments.size(); ++j)
        for (const int apex : {graph.segments[i].a, graph.segments[i].b}) {
          const auto& s = graph.segments[i];
          const auto& r = graph.segments[j];
          if ((apex != s.a && apex != s.b) || (apex != r.a && apex != r.b)) continue;
          const Point2 &o = graph.vertices[apex], &p = graph.vertices[apex == s.a ? s.b : s.a],
                       &q = graph.vertices[apex == r.a ? r.b : r.a];
          if ((p[0] - o[0]) * (q[0] - o[0]) + (p[1] - o[1]) * (q[1] - o[1]) > 0) acute[vertex[apex]] = true;
        }
  }

  void run() {
    while (!segment_queue.empty() || !triangle_queue.empty()) {
      if (!segment_queue.empty()) {
        const Edge s = segment_queue.back();
        segment_queue.pop_back();
        examine(s);
      } else {
        const auto v = triangle_queue.back();
        triangle_queue.pop_back();
        examine(v);
      }
    }
  }
};

/// Per living triangle the polygon it belongs to (−1: outside): flooded up to the segments, so that slivers along an
/// outline go with their neighbours.
std::vector<int> regions(const Refiner& r) {
  const auto& triangles = r.d.triangles;
  std::vector<int> region(triangles.size(), -2);
  for (int seed = 0; seed < static_cast<int>(triangles.size()); ++seed) {
    if (!triangles[seed].alive() || region[seed] != -2) continue;
    std::vector<int> flood{seed};
    region[seed] = -1;
    int largest = seed;
    std::int64_t largest_area = 0;
    for (std::size_t i = 0; i < flood.size(); ++i) {
      const auto& t = triangles[flood[i]];
      const std::int64_t twice = orientation(r.d.points[t.vertex[0]], r.d.points[t.vertex[1]], r.d.points[t.vertex[2]]);
      if (twice > largest_area) largest_area = twice, largest = flood[i];
      for (int k = 0; k < 3; ++k) {
        const int n = t.across[k];
        if (n < 0 || region[n] != -2 || r.segments.contains(edge(t.vertex[(k + 1) % 3], t.vertex[(k + 2) % 3])))
          continue;
        region[n] = -1;
        flood.push_back(n);
      }
    }
    const auto& v = triangles[largest].vertex;
    if (std::any_of(v.begin(), v.end(), [](int i) { return i < Delaunay::corners; })) continue;
    Point2 centroid{0, 0};
    for (const int i : v)
      for (int k = 0; k < 2; ++k) centroid[k] += r.position[i][k] / 3;
    int polygon = -1;
    for (int k = 0; k < static_cast<int>(r.request.polygons.size()); ++k)
      if (inside_polygon(r.request.polygons[k], centroid)) polygon = k;
    for (const int t : flood) region[t] = polygon;
  }
  return region;
}

}  // namespace

Mesh make_mesh(const MeshRequest& request) {
  if (!(request.size > 0)) throw std::invalid_argument("mesh: the element size must be positive");
  Refiner refiner{request};
  refiner.load(section_graph(request));
  refiner.run();

  const std::vector<int> region = regions(refiner);
  PlainMesh plain;
  std::vector<int> number(refiner.position.size(), -1);
  const auto numbered = [&](int v) {
    if (number[v] < 0) {
      number[v] = static_cast<int>(plain.nodes.size());
      plain.nodes.push_back(refiner.position[v]);
    }
    return number[v];
  };
  for (std::size_t t = 0; t < region.size(); ++t) {
    if (region[t] < 0) continue;
    const auto& v = refiner.d.triangles[t].vertex;
    plain.triangles.push_back({numbered(v[0]), numbered(v[1]), numbered(v[2])});
    plain.region.push_back(region[t]);
  }
  if (plain.triangles.empty()) throw std::invalid_argument("mesh: the polygons enclose no soil");
  plain.fixed.assign(plain.nodes.size(), false);
  std::vector<std::array<int, 2>> cuts;
  for (const auto& [s, cut] : refiner.segments) {
    if (number[s.first] < 0 || number[s.second] < 0) continue;
    plain.fixed[number[s.first]] = plain.fixed[number[s.second]] = true;
    if (cut) cuts.push_back({number[s.first], number[s.second]});
  }
  smooth(plain, 8);
  open_cuts(plain, cuts);
  return quadratic_mesh(std::move(plain.nodes), plain.triangles, std::move(plain.region));
}

}  // namespace polder
