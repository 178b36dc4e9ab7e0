#pragma once
// A Gmsh file in place of our own mesher: the mesh of a case's polygons, checked against them.
#include <string>
#include <vector>

#include "polder/seepage/mesher.hpp"

namespace polder {

/// Reads the file `path` as the mesh of what `request` describes; a triangle's region is the polygon in which its
/// centre lies. The request's size does not matter; its lines may be longer than the outline. Throws
/// std::invalid_argument where the file is none, where a triangle lies in no polygon, where the triangles of a polygon
/// do not fill it to a thousandth, where a line has an end or a bend on the outline between two nodes, and where there
/// are cuts.
Mesh mesh_of_file(const std::string& path, const MeshRequest& request);

/// m, side of equilateral triangles as large as the mesh's are on average.
double typical_size(const Mesh& mesh);

}  // namespace polder
