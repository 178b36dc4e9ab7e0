#pragma once
// Pore pressures of a seepage computation, for the methods of slices.
#include "polder/seepage/flow.hpp"
#include "polder/stability/section.hpp"

namespace polder::stability {

/// Replaces the section's water by the computed one: pressures sampled every `spacing` metres, and the phreatic line of
/// the computed p = 0 (where there is none, the base of the mesh).
void take_pressures(const FlowSolver& solver, const FlowState& state, double spacing, Section& section);

}  // namespace polder::stability
