#pragma once
// Friction of free water along sides that it sticks to, where the boundary layer is thinner than a cell.
// docs/theory.md, "Step 3".
#include "polder/math/threads.hpp"
#include "polder/step/fields.hpp"
#include "polder/step/setup.hpp"

namespace polder {

/// Shear stress, Pa, on a smooth wall along which the lowest `layer` (m) of the water flows at `speed` (m/s, its mean).
/// Werner & Wengle (1993): u⁺ = y⁺ up to y⁺ = 11.81 and 8.3 (y⁺)^(1/7) beyond, averaged over the layer.
double stress_on_smooth_wall(double speed, double layer, const WaterProperties& water);

/// Takes from the water's momentum on the faces along the setup's sticky sides what friction does in a step, at most
/// all of it. Faces with grains are left to the drag.
template <class Space>
void rub_along_smooth_walls(const Setup<Space>& setup, double dt, GridFields<Space>& grid, Team& team);

}  // namespace polder
