#pragma once
// How large a slide is, measured in the same way on every field of displacements: python/examples/sliding_area.py does
// it on the points of a run.
#include <span>

#include "polder/seepage/mesh.hpp"

namespace polder {

/// On every vertical the ground above the level below which displacements are less than half of the largest on it, m².
/// `displacement`: x, y per node.
double sliding_area(const Mesh& mesh, std::span<const double> displacement);

}  // namespace polder
