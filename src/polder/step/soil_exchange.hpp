#pragma once
// Exchange of water between soil points that carry that of their pores (single-point formulation) and free water.
//
// What a soil point carries is its pore volume; what it gives or takes as that changes goes to an account per cell,
// GridFields::spare. Water that seeps into the cells at the soil's surface is moved there, and from the accounts there
// into points of free water, or the other way; where there is no free water to take, soil becomes dry, and dry soil
// becomes saturated before water leaves it. Points and accounts together hold the water to round-off.
#include <cstdint>
#include <vector>

#include "polder/points/point_sets.hpp"
#include "polder/step/fields.hpp"
#include "polder/step/setup.hpp"

namespace polder {

/// Whether the soil in a cell carries water as the step began.
template <class Space>
bool carries_water(const Setup<Space>& setup, const GridFields<Space>& grid, std::ptrdiff_t cell) {
  constexpr double least_carried = 1e-3;  // of a cell
  return setup.single_point && !setup.unsaturated &&
         grid.carried_volume[cell] > least_carried * setup.lattice.cell_volume(cell);
}

/// After the points have moved and with the discharge of the step. Returns whether there are other points of water
/// than before, which must be sorted then.
template <class Space>
bool exchange_with_soil(const Setup<Space>& setup, double dt, GridFields<Space>& grid, std::uint64_t& next_id,
                        SoilPoints<Space>& soil, WaterPoints<Space>& water);

}  // namespace polder
