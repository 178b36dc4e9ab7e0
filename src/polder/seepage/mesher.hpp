#pragma once
// Triangles for a case's polygons: conforming Delaunay refinement (Ruppert 1995) with a size field, then smoothing.
#include <vector>

#include "polder/seepage/mesh.hpp"

namespace polder {

/// Elements of `size` at `at`, growing away from it.
struct FinerPoint {
  Point2 at;
  double size;  ///< m
};

struct MeshRequest {
  std::vector<std::vector<Point2>> polygons;  ///< m; where they overlap the later one covers the earlier
  std::vector<std::vector<Point2>> lines;     ///< lines inside that sides of triangles must follow
  /// Thin walls: sides follow them and nodes are doubled along them, so that the two faces do not touch. An end inside
  /// the soil stays joined; an end on the outline opens.
  std::vector<std::vector<Point2>> cuts;
  double size = 1;      ///< m, length of the triangles' sides
  double growth = 0.3;  ///< increase of the size per metre away from where it is finer
  std::vector<FinerPoint> finer;
};

/// Regions of the mesh are indices into `polygons`. Throws std::invalid_argument where there is nothing to mesh or a
/// polygon has no area.
Mesh make_mesh(const MeshRequest& request);

}  // namespace polder
