#pragma once
// Soil and water that meet bodies: what would go into one is stopped at its surface. docs/theory.md, "Bodies that do
// not follow the grid".
#include <functional>

#include "polder/step/fields.hpp"
#include "polder/step/setup.hpp"

namespace polder {

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

}  // namespace polder
