#pragma once
// A mesh of straight-sided 6-node triangles of a section (x, height), and what any computation on it asks for.
#include <array>
#include <functional>
#include <span>
#include <vector>

#include "polder/case/model.hpp"

namespace polder {

struct Mesh {
  std::vector<Point2> nodes;  ///< m
  /// Corners 0, 1, 2 counter-clockwise; 3, 4, 5 half-way 0–1, 1–2, 2–0.
  std::vector<std::array<int, 6>> triangles;
  std::vector<int> region;  ///< per triangle: index of the polygon (mesher) or of the physical group (.msh)
};

/// A side of a triangle: two corners and the node between, in the triangle's counter-clockwise order, so that the
/// outside of the triangle is to the right of a → b.
struct MeshEdge {
  int a, b, middle;
  int triangle;
};

/// The 6-node mesh over plain triangles (corner indices into `corners`, either orientation).
Mesh quadratic_mesh(std::vector<Point2> corners, const std::vector<std::array<int, 3>>& triangles,
                    std::vector<int> region);

/// Sides that belong to one triangle only: the outline, both faces of cuts.
std::vector<MeshEdge> outline(const Mesh& mesh);

/// Whether the side's ends and middle lie on the polyline within `near` (m); it may pass over the line's vertices.
bool side_lies_on(const Mesh& mesh, const MeshEdge& side, std::span<const Point2> line, double near);

/// Area of a triangle, m².
double area(const Mesh& mesh, int triangle);

/// The smallest angle of the whole mesh, degrees.
double smallest_angle(const Mesh& mesh);

/// Finds the triangles that contain points, by buckets. Keep it while the mesh lives.
class MeshLocator {
 public:
  explicit MeshLocator(const Mesh& mesh);
  struct Place {
    int triangle = -1;                      ///< −1: outside the mesh
    std::array<double, 3> weight{0, 0, 0};  ///< barycentric coordinates
  };
  Place find(const Point2& p) const;

 private:
  const Mesh* mesh_;
  Point2 low_{};
  double width_ = 1;
  int columns_ = 1, rows_ = 1;
  std::vector<std::vector<int>> buckets_;
};

/// Quadratic interpolation of nodal values at a place inside the mesh.
double interpolate(const Mesh& mesh, std::span<const double> nodal, const MeshLocator::Place& place);

/// The six quadratic shape functions at barycentric coordinates.
std::array<double, 6> shape(const std::array<double, 3>& l);

/// Gradients (1/m) of the six shape functions at barycentric coordinates, and the triangle's area.
struct ShapeGradient {
  std::array<Point2, 6> gradient;
  double area;
};
ShapeGradient shape_gradient(const Mesh& mesh, int triangle, const std::array<double, 3>& l);

/// The four plain triangles inside a 6-node triangle, as positions of its nodes.
inline constexpr std::array<std::array<int, 3>, 4> sub_triangles{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};

bool inside_polygon(std::span<const Point2> polygon, const Point2& p);
double distance_to_segment(const Point2& p, const Point2& a, const Point2& b);

}  // namespace polder
