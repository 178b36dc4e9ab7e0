#pragma once
// Seepage of a case: the same soils, water bodies and boundaries that `polder run` simulates, as a flow problem.
#include <string>

#include "polder/case/model.hpp"
#include "polder/seepage/flow.hpp"

namespace polder {

struct ModelFlowOptions {
  double size = 0;  ///< m, sides of the triangles; 0: the case's cell
  /// Retention and conductivity of all soils, which the simulation does not ask for.
  Retention retention = VanGenuchtenRetention{};
  ConductivityCurve curve = MualemConductivity{};
};

/// A mesh and the conditions on it; keep it where it is while a solver uses it.
struct ModelFlow {
  Mesh mesh;
  std::vector<FlowMaterial> materials;
  std::vector<FlowBoundary> boundaries;  ///< one per side of the outline that is not closed
  double unit_weight = 9810;
  FlowProblem problem() const { return {&mesh, materials, boundaries, unit_weight}; }
};

/// Heads act where the soil touches a reservoir (its head) or free water (its surface at the start); sides of the model
/// and lines are what their boundaries say, closed by default; soil that borders on air may seep.
/// Throws std::invalid_argument where the case has no section, no soil or no permeability.
ModelFlow model_flow(const Model& model, const ModelFlowOptions& options = {});

/// Hydraulic conductivity (horizontal, vertical) of a material, m/s: as given, else Kozeny–Carman
/// k = ρw g D² n³ / (μ A (1 − n)²).
std::array<double, 2> conductivity(const Model& model, const MaterialInput& material);

/// Heads of the case's initial water table, hydrostatic under and over it.
FlowState initial_flow(const Model& model, const FlowSolver& solver);

}  // namespace polder
