#include "polder/seepage/delaunay.hpp"

#include <algorithm>
#include <stdexcept>

namespace polder {
namespace {

__extension__ using Wide = __int128;

int next(int i) { return i == 2 ? 0 : i + 1; }
int previous(int i) { return i == 0 ? 2 : i - 1; }

/// Whether `p` lies strictly inside the circle through the counter-clockwise triangle a, b, c.
bool inside_circle(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& p) {
  const std::int64_t ax = a[0] - p[0], ay = a[1] - p[1], bx = b[0] - p[0], by = b[1] - p[1], cx = c[0] - p[0],
                     cy = c[1] - p[1];
  const std::int64_t a2 = ax * ax + ay * ay, b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
  const Wide det = Wide(a2) * (bx * cy - cx * by) + Wide(b2) * (cx * ay - ax * cy) + Wide(c2) * (ax * by - bx * ay);
  return det > 0;
}

bool in_circumcircle(const Delaunay& d, int t, const LatticePoint& p) {
  const auto& v = d.triangles[t].vertex;
  return inside_circle(d.points[v[0]], d.points[v[1]], d.points[v[2]], p);
}

int new_slot(Delaunay& d) {
  if (!d.free_slots.empty()) {
    const int t = d.free_slots.back();
    d.free_slots.pop_back();
    return t;
  }
  d.triangles.emplace_back();
  return static_cast<int>(d.triangles.size()) - 1;
}

}  // namespace

std::int64_t orientation(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

Delaunay empty_delaunay() {
  Delaunay d;
  const std::int64_t low = -2 * Delaunay::extent, high = 3 * Delaunay::extent;
  d.points = {{low, low}, {high, low}, {high, high}, {low, high}};
  d.triangles.resize(2);
  d.triangles[0] = {{0, 1, 2}, {-1, 1, -1}};
  d.triangles[1] = {{0, 2, 3}, {-1, -1, 0}};
  d.triangle_of = {0, 0, 0, 1};
  return d;
}

int locate(const Delaunay& d, const LatticePoint& p) {
  int t = d.triangles[d.last_found].alive() ? d.last_found : d.triangle_of[0];
  // A walk by visibility ends in any Delaunay triangulation (Edelsbrunner 1990).
  while (true) {
    const auto& tri = d.triangles[t];
    int beyond = -1;
    for (int i = 0; i < 3 && beyond < 0; ++i)
      if (orientation(d.points[tri.vertex[next(i)]], d.points[tri.vertex[previous(i)]], p) < 0) beyond = i;
    if (beyond < 0) return d.last_found = t;
    t = tri.across[beyond];
    if (t < 0) throw std::logic_error("delaunay: a point outside the surrounding box");
  }
}

std::vector<int> cavity(const Delaunay& d, const LatticePoint& p) {
  std::vector<int> found{locate(d, p)};
  for (std::size_t i = 0; i < found.size(); ++i)
    for (const int n : d.triangles[found[i]].across)
      if (n >= 0 && std::find(found.begin(), found.end(), n) == found.end() && in_circumcircle(d, n, p))
        found.push_back(n);
  return found;
}

int insert(Delaunay& d, const LatticePoint& p, std::vector<int>* created) {
  const int home = locate(d, p);
  for (const int v : d.triangles[home].vertex)
    if (d.points[v] == p) return v;

  const std::vector<int> removed = cavity(d, p);
  struct Rim {
    int a, b, outside;
  };
  std::vector<Rim> rim;
  for (const int t : removed)
    for (int i = 0; i < 3; ++i) {
      const auto& tri = d.triangles[t];
      const int n = tri.across[i];
      if (n < 0 || std::find(removed.begin(), removed.end(), n) == removed.end())
        rim.push_back({tri.vertex[next(i)], tri.vertex[previous(i)], n});
    }

  const int vertex = static_cast<int>(d.points.size());
  d.points.push_back(p);
  d.triangle_of.push_back(-1);
  std::vector<int> fan(rim.size());
  // Neighbours of the rim must be found before the removed triangles' slots are used again.
  std::vector<int> outside_side(rim.size(), -1);
  for (std::size_t k = 0; k < rim.size(); ++k)
    if (rim[k].outside >= 0)
      for (int i = 0; i < 3; ++i) {
        const auto& o = d.triangles[rim[k].outside];
        if (o.vertex[next(i)] == rim[k].b && o.vertex[previous(i)] == rim[k].a) outside_side[k] = i;
      }
  for (const int t : removed) {
    d.triangles[t] = {};
    d.free_slots.push_back(t);
  }
  for (std::size_t k = 0; k < rim.size(); ++k) {
    fan[k] = new_slot(d);
    d.triangles[fan[k]] = {{vertex, rim[k].a, rim[k].b}, {rim[k].outside, -1, -1}};
    if (rim[k].outside >= 0) d.triangles[rim[k].outside].across[outside_side[k]] = fan[k];
    d.triangle_of[rim[k].a] = fan[k];
  }
  d.triangle_of[vertex] = fan[0];
  for (std::size_t k = 0; k < rim.size(); ++k)
    for (std::size_t m = 0; m < rim.size(); ++m)
      if (rim[m].a == rim[k].b) {
        d.triangles[fan[k]].across[1] = fan[m];
        d.triangles[fan[m]].across[2] = fan[k];
      }
  d.last_found = fan[0];
  if (created) *created = fan;
  return vertex;
}

std::vector<int> star(const Delaunay& d, int vertex) {
  const int start = d.triangle_of[vertex];
  std::vector<int> found;
  int t = start;
  do {
    found.push_back(t);
    const auto& v = d.triangles[t].vertex;
    const int i = static_cast<int>(std::find(v.begin(), v.end(), vertex) - v.begin());
    t = d.triangles[t].across[next(i)];  // counter-clockwise about the vertex
  } while (t >= 0 && t != start);
  if (t == start) return found;
  t = start;  // a corner of the box: go round the other way too
  while (true) {
    const auto& v = d.triangles[t].vertex;
    const int i = static_cast<int>(std::find(v.begin(), v.end(), vertex) - v.begin());
    t = d.triangles[t].across[previous(i)];
    if (t < 0) return found;
    found.push_back(t);
  }
}

std::array<int, 2> find_edge(const Delaunay& d, int a, int b) {
  for (const int t : star(d, a)) {
    const auto& v = d.triangles[t].vertex;
    for (int i = 0; i < 3; ++i)
      if (v[next(i)] == a && v[previous(i)] == b) return {t, i};
  }
  return {-1, -1};
}

}  // namespace polder
