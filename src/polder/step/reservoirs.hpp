#pragma once
// Reservoirs in a step: points are added at the water's surface or taken from it so that the volume in the reservoir
// stays that of still water at the level H(t), to within a sixteenth of a point.
#include "polder/boundary/reservoir.hpp"
#include "polder/points/point_sets.hpp"
#include "polder/step/fields.hpp"
#include "polder/step/setup.hpp"

namespace polder {

/// Water that reservoirs have exchanged with the model in a step.
struct Exchange {
  std::ptrdiff_t cell;  ///< index in the lattice
  double volume;        ///< m³, positive into the model
};

/// Adds to the lowest columns and takes from the highest. Returns what was exchanged; if anything was, the points must
/// be sorted again.
template <class Space>
std::vector<Exchange> exchange_with_reservoirs(const Setup<Space>& setup, double time, const GridFields<Space>& grid,
                                               std::uint64_t& next_id, WaterPoints<Space>& water);

}  // namespace polder
