#include "polder/seepage/mesh_finish.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace polder {
namespace {

std::vector<std::vector<int>> triangles_around(const PlainMesh& mesh) {
  std::vector<std::vector<int>> around(mesh.nodes.size());
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    for (const int v : mesh.triangles[t]) around[v].push_back(t);
  return around;
}

/// Shape of a triangle: 1 equilateral, 0 flat, negative inside out.
double quality(const PlainMesh& mesh, int t) {
  const auto& v = mesh.triangles[t];
  const Point2 &a = mesh.nodes[v[0]], &b = mesh.nodes[v[1]], &c = mesh.nodes[v[2]];
  const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  double sides = 0;
  for (const auto& [p, q] : {std::pair{a, b}, {b, c}, {c, a}})
    sides += (q[0] - p[0]) * (q[0] - p[0]) + (q[1] - p[1]) * (q[1] - p[1]);
  return 2 * std::sqrt(3.0) * twice / sides;
}

double worst(const PlainMesh& mesh, const std::vector<int>& triangles) {
  double q = 1;
  for (const int t : triangles) q = std::min(q, quality(mesh, t));
  return q;
}

}  // namespace

void smooth(PlainMesh& mesh, int sweeps) {
  const auto around = triangles_around(mesh);
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (std::size_t v = 0; v < mesh.nodes.size(); ++v) {
      if (mesh.fixed[v]) continue;
      Point2 mean{0, 0};
      for (const int t : around[v])
        for (const int w : mesh.triangles[t])
          if (w != static_cast<int>(v))
            for (int k = 0; k < 2; ++k) mean[k] += mesh.nodes[w][k] / (2 * static_cast<double>(around[v].size()));
      const Point2 old = mesh.nodes[v];
      const double before = worst(mesh, around[v]);
      mesh.nodes[v] = mean;
      if (worst(mesh, around[v]) <= before) mesh.nodes[v] = old;
    }
}

void open_cuts(PlainMesh& mesh, std::span<const std::array<int, 2>> sides) {
  std::set<std::pair<int, int>> cut;
  std::set<int> vertices;
  for (const auto& s : sides) {
    cut.insert(std::minmax(s[0], s[1]));
    vertices.insert({s[0], s[1]});
  }
  const auto around = triangles_around(mesh);
  const std::vector<std::array<int, 3>> joined = mesh.triangles;
  for (const int v : vertices) {
    // Triangles around v fall into fans that the cut separates; every fan but the first gets its own node.
    const auto& fan = around[v];
    std::vector<int> group(fan.size());
    std::iota(group.begin(), group.end(), 0);
    const auto shares_open_side = [&](int s, int t) {
      for (const int w : joined[s])
        if (w != v && std::find(joined[t].begin(), joined[t].end(), w) != joined[t].end() &&
            !cut.contains(std::minmax(v, w)))
          return true;
      return false;
    };
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t i = 0; i < fan.size(); ++i)
        for (std::size_t j = 0; j < fan.size(); ++j)
          if (group[j] > group[i] && shares_open_side(fan[i], fan[j])) group[j] = group[i], changed = true;
    }
    std::set<int> groups(group.begin(), group.end());
    for (const int g : groups) {
      if (g == group.front()) continue;
      const int copy = static_cast<int>(mesh.nodes.size());
      mesh.nodes.push_back(mesh.nodes[v]);
      mesh.fixed.push_back(true);
      for (std::size_t i = 0; i < fan.size(); ++i)
        if (group[i] == g) std::replace(mesh.triangles[fan[i]].begin(), mesh.triangles[fan[i]].end(), v, copy);
    }
  }
}

}  // namespace polder
