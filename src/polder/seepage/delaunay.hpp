#pragma once
// Delaunay triangulation of points on an integer lattice, by incremental insertion (Bowyer 1981, Watson 1981).
//
// Coordinates are integers below 2^27 in magnitude, so that the orientation test is exact in 64 bits and the
// circle test, of degree four, is exact in 128. Nothing here has a tolerance, and no input can break it.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace polder {

using LatticePoint = std::array<std::int64_t, 2>;

struct Delaunay {
  static constexpr std::int64_t extent = std::int64_t{1} << 24;  ///< points lie in [0, extent]²
  static constexpr int corners = 4;  ///< vertices 0..3 are the corners of a box around all points

  struct Triangle {
    std::array<int, 3> vertex{-1, -1, -1};  ///< counter-clockwise; −1: a free slot
    std::array<int, 3> across{-1, -1, -1};  ///< the triangle beyond the edge opposite to vertex i; −1: none
    bool alive() const { return vertex[0] >= 0; }
  };

  std::vector<LatticePoint> points;
  std::vector<Triangle> triangles;
  std::vector<int> free_slots;
  std::vector<int> triangle_of;  ///< one living triangle at each vertex
  mutable int last_found = 0;
};

/// An empty triangulation: the two triangles of the surrounding box.
Delaunay empty_delaunay();

/// Twice the signed area of a, b, c: positive where they turn counter-clockwise.
std::int64_t orientation(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c);

/// The triangle that contains `p` (inside or on its edges).
int locate(const Delaunay& d, const LatticePoint& p);

/// The triangles whose circumcircle contains `p` strictly: those that an insertion of `p` would remove.
std::vector<int> cavity(const Delaunay& d, const LatticePoint& p);

/// Inserts `p` and returns its vertex (an existing one where `p` is already a vertex). `created`, if given, receives
/// the new triangles.
int insert(Delaunay& d, const LatticePoint& p, std::vector<int>* created = nullptr);

/// The triangle with the directed edge a → b, counter-clockwise, and the position of the vertex opposite to it;
/// {−1, −1} where there is no such edge.
std::array<int, 2> find_edge(const Delaunay& d, int a, int b);

/// The living triangles around a vertex.
std::vector<int> star(const Delaunay& d, int vertex);

}  // namespace polder
