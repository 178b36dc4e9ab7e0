#pragma once
// Both phases' velocities on the faces before the pressure acts, with the drag between them solved implicitly, and
// their responses to a pressure gradient. docs/theory.md, "Step 3".
#include "polder/math/threads.hpp"
#include "polder/step/fields.hpp"
#include "polder/step/setup.hpp"

namespace polder {

/// Share of a face full of water below which it has no water of its own.
inline constexpr double water_present = 1e-9;

template <class Space>
void predict_faces(const Setup<Space>& setup, const StepControl& control, double dt, GridFields<Space>& grid,
                   Team& team);

/// Cundall's damping: takes `factor` of what the step has changed a face's soil velocity by, against the motion. After
/// the pressure has acted.
template <class Space>
void damp_locally(const Setup<Space>& setup, double factor, GridFields<Space>& grid, Team& team);

/// q = n(v_w − v_s) on the faces, and |q| for the next step's quadratic drag. After the pressure has acted and ghosts
/// of the velocities are set.
template <class Space>
void update_discharge(const Setup<Space>& setup, GridFields<Space>& grid, Team& team);

}  // namespace polder
