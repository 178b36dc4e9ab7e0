#pragma once
// What a plain triangulation goes through before it becomes a mesh: smoothing, and opening of cuts.
#include <array>
#include <span>
#include <vector>

#include "polder/case/model.hpp"

namespace polder {

struct PlainMesh {
  std::vector<Point2> nodes;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise
  std::vector<int> region;
  std::vector<bool> fixed;  ///< nodes that must stay where they are
};

/// Moves free nodes to the mean of their neighbours where that improves the worst triangle around them.
void smooth(PlainMesh& mesh, int sweeps);

/// Doubles the nodes along the given sides, so that the triangles on the two faces no longer share them.
void open_cuts(PlainMesh& mesh, std::span<const std::array<int, 2>> sides);

}  // namespace polder
