#pragma once
// What an engineer reads off a seepage computation.
#include "polder/seepage/flow.hpp"

namespace polder {

/// Pore pressure at the nodes, Pa, negative where there is suction.
std::vector<double> pore_pressure(const FlowSolver& solver, const FlowState& state);

/// Water leaving through a boundary, m²/s; negative where it enters.
double discharge(const FlowSolver& solver, const FlowState& state, int boundary);

/// Water crossing a polyline from its left to its right (looking along it), m²/s.
double discharge_through(const FlowSolver& solver, const FlowState& state, std::span<const Point2> section);

/// Specific discharge (m/s, outwards) along a boundary and the hydraulic gradient that drives it there.
struct ExitFlow {
  std::vector<Point2> at;             ///< nodes of the boundary
  std::vector<double> specific_flow;  ///< m/s, normal to the side, positive outwards
  std::vector<double> gradient;       ///< −∂h/∂normal, positive outwards
};
/// From the nodal outflows, which are more accurate than the gradient inside the triangles.
ExitFlow exit_flow(const FlowSolver& solver, const FlowState& state, int boundary);

/// The water table: pieces of the line p = 0.
std::vector<std::array<Point2, 2>> phreatic_line(const FlowSolver& solver, const FlowState& state);

/// Height of the water table at every x: the highest point of p = 0 there; the face of the ground where it is saturated
/// up to it, the level of water that stands on it; absent where there is none.
std::vector<std::optional<double>> phreatic_heights(const FlowSolver& solver, const FlowState& state,
                                                    std::span<const double> xs);
std::optional<double> phreatic_height(const FlowSolver& solver, const FlowState& state, double x);

/// Specific discharge (m/s) at the nodes, averaged over the triangles around them.
std::vector<Point2> specific_discharge(const FlowSolver& solver, const FlowState& state);

}  // namespace polder
