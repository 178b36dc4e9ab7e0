#pragma once
// Water points are split where they have been stretched (water that enters soil fills more bulk volume than its own)
// and merged where small ones crowd (water that leaves soil).
#include "polder/grid/bodies.hpp"
#include "polder/grid/thin_walls.hpp"
#include "polder/math/threads.hpp"
#include "polder/points/point_sets.hpp"

namespace polder {

struct ResampleRules {
  double nominal = 0;        ///< m³, bulk volume of a point at the start in the smallest cells
  int points_per_cell = 4;   ///< at the start
  double split_at = 1.6;     ///< × nominal bulk volume
  double split_edge = 0;     ///< cells, of the box of a point in free water that stretches with the flow; 0: none does
  double least = 1.0 / 32;   ///< × nominal: what is smaller is not split for its box (spray)
  double merge_below = 0.6;  ///< × nominal bulk volume, of each of the two
  double crowded = 2;        ///< × points_per_cell, in one group
  std::uint64_t seed = 1;
};

/// Splits along the velocity (at rest: in a random direction that depends on seed, id and step); in free water, along
/// the longest edge of the box. `cell_porosity` over the lattice. The halves stay on their side of `walls` and out of
/// `bodies`. New points are appended: the set must be sorted again.
template <class Space>
std::size_t split_water(const Lattice<Space>& lattice, const Array& cell_porosity, const ResampleRules& rules,
                        std::uint64_t step, std::uint64_t& next_id, WaterPoints<Space>& water, Team& team,
                        const ThinWalls<Space>& walls = {}, const Bodies<Space>& bodies = {});

/// Merges the closest pairs of small points of a crowded group, conserving volume, momentum and centre of mass. The set
/// must be sorted; it stays so.
template <class Space>
std::size_t merge_water(const Lattice<Space>& lattice, const Array& cell_porosity, const ResampleRules& rules,
                        WaterPoints<Space>& water);

}  // namespace polder
