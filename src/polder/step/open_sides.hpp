#pragma once
// What open sides of the model do in a step: the pressure beyond them, and the points that come and go
// (boundary/open_side.hpp; docs/theory.md, "Open sides").
#include <cstdint>
#include <vector>

#include "polder/points/point_sets.hpp"
#include "polder/step/fields.hpp"
#include "polder/step/reservoirs.hpp"
#include "polder/step/setup.hpp"

namespace polder {

/// The pressure in the ghost cells beyond the sides with a head at `time`; cells inside, below the head, are wet. After
/// water_to_grid().
template <class Space>
void prepare_open_sides(const Setup<Space>& setup, double time, GridFields<Space>& grid);

/// Above the head water may leave and not enter: faces are closed where the water is not on its way out and its cell
/// had no pressure to drive it. After predict_faces().
template <class Space>
void close_seepage_faces(const Setup<Space>& setup, GridFields<Space>& grid);

/// After the points have moved: those beyond a side go, and layers of new points pay what has come in. Returns what was
/// exchanged.
template <class Space>
std::vector<Exchange> exchange_through_sides(const Setup<Space>& setup, double dt, GridFields<Space>& grid,
                                             std::uint64_t& next_id, WaterPoints<Space>& water);

}  // namespace polder
