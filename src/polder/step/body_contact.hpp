#pragma once
// Soil and water that meet bodies: what would go into one is stopped at its surface. docs/theory.md, "Bodies that do
// not follow the grid".
#include <functional>

#include "polder/step/fields.hpp"
#include "polder/step/setup.hpp"

namespace polder {

/// Lets the soil's velocity, relative to theirs, meet the bodies: on faces whose centre is inside one it does not go
/// further in, and the momentum that was stopped there, times tan δ, is the most that friction takes of the motion
/// along the surface in the cell before it. Faces that were stopped no longer respond to a pressure, and what stopped
/// them is added to `body_impulse`. After extrapolate_soil(). `only(axis, face)`, where given: of these faces only,
/// without friction. `by_water(axis, face)`, where given: of the velocity, m/s along the axis, what the pore water's
/// pressure gave it in this step, which does not rub.
template <class Space>
void meet_bodies(const Setup<Space>& setup, GridFields<Space>& grid,
                 const std::function<bool(int, std::ptrdiff_t)>& only = {},
                 const std::function<double(int, std::ptrdiff_t)>& by_water = {});

/// The same for the water's velocity, without friction, where bodies move. After extrapolate_water().
template <class Space>
void water_meets_bodies(const Setup<Space>& setup, GridFields<Space>& grid);

}  // namespace polder
