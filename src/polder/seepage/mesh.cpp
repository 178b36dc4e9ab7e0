#include "polder/seepage/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

namespace polder {
namespace {

std::uint64_t edge_key(int a, int b) {
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | static_cast<std::uint32_t>(std::max(a, b));
}

double cross(const Point2& a, const Point2& b, const Point2& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

}  // namespace

Mesh quadratic_mesh(std::vector<Point2> corners, const std::vector<std::array<int, 3>>& triangles,
                    std::vector<int> region) {
  Mesh mesh{std::move(corners), {}, std::move(region)};
  std::unordered_map<std::uint64_t, int> middle;
  mesh.triangles.reserve(triangles.size());
  for (auto t : triangles) {
    if (cross(mesh.nodes[t[0]], mesh.nodes[t[1]], mesh.nodes[t[2]]) < 0) std::swap(t[1], t[2]);
    std::array<int, 6> six{t[0], t[1], t[2], 0, 0, 0};
    for (int i = 0; i < 3; ++i) {
      const int a = t[i], b = t[(i + 1) % 3];
      const auto [it, fresh] = middle.try_emplace(edge_key(a, b), static_cast<int>(mesh.nodes.size()));
      if (fresh) {
        const Point2 &p = mesh.nodes[a], &q = mesh.nodes[b];
        mesh.nodes.push_back({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2});
      }
      six[3 + i] = it->second;
    }
    mesh.triangles.push_back(six);
  }
  return mesh;
}

std::vector<MeshEdge> outline(const Mesh& mesh) {
  std::unordered_map<std::uint64_t, int> count;
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) ++count[edge_key(t[i], t[(i + 1) % 3])];
  std::vector<MeshEdge> edges;
  for (int e = 0; e < static_cast<int>(mesh.triangles.size()); ++e) {
    const auto& t = mesh.triangles[e];
    for (int i = 0; i < 3; ++i)
      if (count[edge_key(t[i], t[(i + 1) % 3])] == 1) edges.push_back({t[i], t[(i + 1) % 3], t[3 + i], e});
  }
  return edges;
}

bool side_lies_on(const Mesh& mesh, const MeshEdge& side, std::span<const Point2> line, double near) {
  for (const int n : {side.a, side.middle, side.b}) {
    bool on = false;
    for (std::size_t i = 0; i + 1 < line.size() && !on; ++i)
      on = distance_to_segment(mesh.nodes[n], line[i], line[i + 1]) < near;
    if (!on) return false;
  }
  return true;
}

double area(const Mesh& mesh, int triangle) {
  const auto& t = mesh.triangles[triangle];
  return cross(mesh.nodes[t[0]], mesh.nodes[t[1]], mesh.nodes[t[2]]) / 2;
}

double smallest_angle(const Mesh& mesh) {
  double smallest = 180;
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      const Point2 &p = mesh.nodes[t[i]], &q = mesh.nodes[t[(i + 1) % 3]], &r = mesh.nodes[t[(i + 2) % 3]];
      const double dot = (q[0] - p[0]) * (r[0] - p[0]) + (q[1] - p[1]) * (r[1] - p[1]);
      smallest = std::min(smallest, std::atan2(std::abs(cross(p, q, r)), dot) * 180 / std::numbers::pi);
    }
  return smallest;
}

MeshLocator::MeshLocator(const Mesh& mesh) : mesh_(&mesh) {
  Point2 high{-1e300, -1e300};
  low_ = {1e300, 1e300};
  for (const auto& p : mesh.nodes)
    for (int k = 0; k < 2; ++k) low_[k] = std::min(low_[k], p[k]), high[k] = std::max(high[k], p[k]);
  const double w = std::max(high[0] - low_[0], 1e-12), h = std::max(high[1] - low_[1], 1e-12);
  constexpr double most = 10000;  // columns or rows, however slender the mesh
  width_ = std::max(std::sqrt(w * h / std::max<double>(1, static_cast<double>(mesh.triangles.size()))),
                    std::max(w, h) / most);
  columns_ = static_cast<int>(w / width_) + 1;
  rows_ = static_cast<int>(h / width_) + 1;
  buckets_.resize(static_cast<std::size_t>(columns_) * rows_);
  for (int e = 0; e < static_cast<int>(mesh.triangles.size()); ++e) {
    const auto& t = mesh.triangles[e];
    std::array<int, 4> box{columns_, -1, rows_, -1};
    for (int i = 0; i < 3; ++i) {
      const int c = std::clamp(static_cast<int>((mesh.nodes[t[i]][0] - low_[0]) / width_), 0, columns_ - 1);
      const int r = std::clamp(static_cast<int>((mesh.nodes[t[i]][1] - low_[1]) / width_), 0, rows_ - 1);
      box = {std::min(box[0], c), std::max(box[1], c), std::min(box[2], r), std::max(box[3], r)};
    }
    for (int r = box[2]; r <= box[3]; ++r)
      for (int c = box[0]; c <= box[1]; ++c) buckets_[static_cast<std::size_t>(r) * columns_ + c].push_back(e);
  }
}

MeshLocator::Place MeshLocator::find(const Point2& p) const {
  const double column = std::floor((p[0] - low_[0]) / width_), row = std::floor((p[1] - low_[1]) / width_);
  if (!(column >= -1 && column <= columns_ && row >= -1 && row <= rows_)) return {};
  const int c = std::clamp(static_cast<int>(column), 0, columns_ - 1),
            r = std::clamp(static_cast<int>(row), 0, rows_ - 1);
  for (const int e : buckets_[static_cast<std::size_t>(r) * columns_ + c]) {
    const auto& t = mesh_->triangles[e];
    const Point2 &a = mesh_->nodes[t[0]], &b = mesh_->nodes[t[1]], &d = mesh_->nodes[t[2]];
    const double whole = cross(a, b, d);
    const std::array<double, 3> l{cross(p, b, d) / whole, cross(a, p, d) / whole, cross(a, b, p) / whole};
    constexpr double on_edge = -1e-7;
    if (l[0] >= on_edge && l[1] >= on_edge && l[2] >= on_edge) return {e, l};
  }
  return {};
}

std::array<double, 6> shape(const std::array<double, 3>& l) {
  return {l[0] * (2 * l[0] - 1), l[1] * (2 * l[1] - 1), l[2] * (2 * l[2] - 1),
          4 * l[0] * l[1],       4 * l[1] * l[2],       4 * l[2] * l[0]};
}

ShapeGradient shape_gradient(const Mesh& mesh, int triangle, const std::array<double, 3>& l) {
  const auto& t = mesh.triangles[triangle];
  const Point2 &p = mesh.nodes[t[0]], &q = mesh.nodes[t[1]], &r = mesh.nodes[t[2]];
  const double twice = cross(p, q, r);
  const std::array<Point2, 3> g{{{(q[1] - r[1]) / twice, (r[0] - q[0]) / twice},
                                 {(r[1] - p[1]) / twice, (p[0] - r[0]) / twice},
                                 {(p[1] - q[1]) / twice, (q[0] - p[0]) / twice}}};
  ShapeGradient s{{}, twice / 2};
  for (int k = 0; k < 2; ++k)
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      s.gradient[i][k] = (4 * l[i] - 1) * g[i][k];
      s.gradient[3 + i][k] = 4 * (l[i] * g[j][k] + l[j] * g[i][k]);
    }
  return s;
}

double interpolate(const Mesh& mesh, std::span<const double> nodal, const MeshLocator::Place& place) {
  const auto n = shape(place.weight);
  double value = 0;
  for (int i = 0; i < 6; ++i) value += n[i] * nodal[mesh.triangles[place.triangle][i]];
  return value;
}

bool inside_polygon(std::span<const Point2> polygon, const Point2& p) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Point2 &a = polygon[i], &b = polygon[j];
    if ((a[1] > p[1]) != (b[1] > p[1]) && p[0] < (b[0] - a[0]) * (p[1] - a[1]) / (b[1] - a[1]) + a[0]) inside = !inside;
  }
  return inside;
}

double distance_to_segment(const Point2& p, const Point2& a, const Point2& b) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], l2 = dx * dx + dy * dy;
  const double s = l2 > 0 ? std::clamp(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / l2, 0.0, 1.0) : 0.0;
  return std::hypot(p[0] - a[0] - s * dx, p[1] - a[1] - s * dy);
}

}  // namespace polder
