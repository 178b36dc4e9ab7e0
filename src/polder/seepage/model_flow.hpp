#pragma once
// Seepage of a case: the same soils, water bodies and boundaries that `polder run` simulates, as a flow problem.
#include <string>

#include "polder/case/seepage_input.hpp"
#include "polder/seepage/flow.hpp"
#include "polder/seepage/mesher.hpp"

namespace polder {

/// A mesh and the conditions on it; keep it where it is while a solver uses it.
struct ModelFlow {
  Mesh mesh;
  std::vector<FlowMaterial> materials;
  std::vector<FlowBoundary> boundaries;  ///< parts of the outline that are not closed
  double unit_weight = 9810;
  FlowProblem problem() const { return {&mesh, materials, boundaries, unit_weight}; }
};

/// A mesh of the case's ground with sides of `size`, m: its bodies of soil, the lines of its boundaries, cut at its
/// walls.
MeshRequest ground_outlines(const Model& model, double size);

/// Heads act where the soil touches a reservoir (its head) or free water (its surface at the start); sides of the model
/// and lines are what their boundaries say, closed by default; soil that borders on air may seep. What `input` says of
/// a part of the outline goes before all that. Materials without a retention curve have van Genuchten's with its
/// defaults.
/// Throws std::invalid_argument where the case has no section, no soil or no permeability.
ModelFlow model_flow(const Model& model, const SeepageInput& input = {});

/// Hydraulic conductivity (horizontal, vertical) of a material, m/s: as given, else Kozeny–Carman
/// k = ρw g D² n³ / (μ A (1 − n)²).
std::array<double, 2> conductivity(const Model& model, const MaterialInput& material);

/// Heads of the case's initial water table, hydrostatic under and over it.
FlowState initial_flow(const Model& model, const FlowSolver& solver);

}  // namespace polder
