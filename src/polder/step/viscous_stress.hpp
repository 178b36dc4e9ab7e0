#pragma once
// Viscous stresses of free water on the faces. docs/theory.md, "Step 3".
#include "polder/math/threads.hpp"
#include "polder/step/fields.hpp"
#include "polder/step/setup.hpp"

namespace polder {

/// Adds to the water's momentum what its viscous stresses, ν∇²v at the start of the step, give in a step: on faces with
/// water, towards neighbours with water; walls stick to it or not, as their kind says.
template <class Space>
void add_viscous_stress(const Setup<Space>& setup, double dt, GridFields<Space>& grid, Team& team);

}  // namespace polder
