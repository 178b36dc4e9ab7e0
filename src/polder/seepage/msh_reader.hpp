#pragma once
// Gmsh meshes: .msh text files of versions 2.2 and 4.1.
#include <istream>
#include <map>
#include <string>

#include "polder/seepage/mesh.hpp"

namespace polder {

struct GmshMesh {
  Mesh mesh;                         ///< regions are physical groups (elementary entities where the file has none)
  std::map<int, std::string> names;  ///< physical groups by number, where named
};

/// Reads 3- and 6-node triangles (others are skipped) in the plane of x and y, y up; 3-node triangles get their
/// half-way nodes. Throws std::invalid_argument with the line of what is wrong.
GmshMesh read_msh(std::istream& in);

}  // namespace polder
