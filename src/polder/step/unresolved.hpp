#pragma once
// XPIC of second order (Hammerquist & Nairn, 2017) on top of APIC, if the case asks for it: docs/theory.md,
// "Transfers".
#include "polder/points/tiles.hpp"
#include "polder/step/fields.hpp"
#include "polder/step/setup.hpp"

namespace polder {

/// Sets grid.unresolved, m/s: what the soil points lose of their velocity on the way to the grid and back, averaged on
/// the grid once more. Its smooth part they may keep, as grid_to_soil() lets them; the noise does not survive the
/// average. To be called when grid.soil_before is that of this step and the points' velocities are still those before
/// it.
template <class Space>
void find_unresolved(const Setup<Space>& setup, const SoilPoints<Space>& soil, const Tiling<Space>& tiling,
                     GridFields<Space>& grid, Team& team);

}  // namespace polder
