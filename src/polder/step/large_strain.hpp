#pragma once
// The strain of a step and the rotation that goes before it, to second order in the step: for laws that follow strains
// of any size (docs/theory.md, "Strain and rotation").
#include "polder/step/soil_stress.hpp"

namespace polder {

/// From the displacement gradient of the step, L Δt: `strain` becomes that of the stretch V in I + L Δt = V R, as log
/// V, its trace being (dilation − ½ tr L² Δt) Δt; `batch.stress` the stress of the points [first, first + count) turned
/// by R; `dilation` that rate of volume change, 1/s.
template <class Space>
void stretch_and_turn(const VelocityGradients<Space>& gradients, double dt, std::size_t first, int count,
                      const SoilPoints<Space>& soil, double* dilation, StressBatch<Space::stress>& batch);

}  // namespace polder
