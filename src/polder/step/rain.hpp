#pragma once
// Rain in a step: it falls on each column of cells and becomes points above the column's uppermost soil or water, in
// parcels of an eighth of a point. A negative rate is evaporation: as much is taken, likewise in parcels, from water
// that is open to the air.
#include <cstdint>
#include <vector>

#include "polder/points/point_sets.hpp"
#include "polder/step/fields.hpp"
#include "polder/step/reservoirs.hpp"
#include "polder/step/setup.hpp"

namespace polder {

/// m/s of all rains on column i of the cells along x, mean over its width.
template <class Space>
double rain_on(const Setup<Space>& setup, double time, int i);

/// Returns what has become points, and what points have lost; if there is anything, they must be sorted again.
template <class Space>
std::vector<Exchange> let_it_rain(const Setup<Space>& setup, double time, double dt, GridFields<Space>& grid,
                                  std::uint64_t& next_id, WaterPoints<Space>& water);

}  // namespace polder
