#pragma once
// What holds the ground of a case, for finite elements.
#include <vector>

#include "polder/case/model.hpp"
#include "polder/seepage/mesh.hpp"
#include "polder/stability/fem_solver.hpp"

namespace polder {

/// The level and upright sides of the outline that the case's boundaries hold, sides of the model by default smooth.
/// `near`, m: what counts as on a line. Empty where nothing holds the ground.
std::vector<FemSupport> ground_supports(const Model& model, const Mesh& mesh, double near);

}  // namespace polder
