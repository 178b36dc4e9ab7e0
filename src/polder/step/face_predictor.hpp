#pragma once
// Both phases' velocities on the faces before the pressure acts, with the drag between them solved implicitly, and
// their responses to a pressure gradient. docs/theory.md, "Step 3".
#include "polder/math/threads.hpp"
#include "polder/step/fields.hpp"
#include "polder/step/setup.hpp"

namespace polder {

/// Adds to the water's momentum what its viscous stresses, ν∇²v at the start of the step, give in a step: on faces with
/// water, towards neighbours with water; walls stick to it or not, as their kind says.
template <class Space>
void add_viscous_stress(const Setup<Space>& setup, double dt, GridFields<Space>& grid, Team& team);

template <class Space>
void predict_faces(const Setup<Space>& setup, const StepControl& control, double dt, GridFields<Space>& grid,
                   Team& team);

/// Cundall's damping: takes `factor` of what the step has changed a face's soil velocity by, against the motion. After
/// the pressure has acted.
template <class Space>
void damp_locally(const Setup<Space>& setup, double factor, GridFields<Space>& grid, Team& team);

/// Lets the soil's velocity, relative to theirs, meet the bodies: on faces whose centre is inside one it does not go
/// further in, and friction takes of the motion along the surface what the part that was stopped allows. Faces that
/// were stopped no longer respond to a pressure, and what stopped them is added to `body_impulse`. After
/// extrapolate_soil(). `only(axis, face)`, where given: of these faces only.
template <class Space>
void meet_bodies(const Setup<Space>& setup, GridFields<Space>& grid,
                 const std::function<bool(int, std::ptrdiff_t)>& only = {});

/// The same for the water's velocity, without friction, where bodies move. After extrapolate_water().
template <class Space>
void water_meets_bodies(const Setup<Space>& setup, GridFields<Space>& grid);

/// q = n(v_w − v_s) on the faces, and |q| for the next step's quadratic drag. After the pressure has acted and ghosts
/// of the velocities are set.
template <class Space>
void update_discharge(const Setup<Space>& setup, GridFields<Space>& grid, Team& team);

}  // namespace polder
