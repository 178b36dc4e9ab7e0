#pragma once
// Where the pore water meets the outside in the unsaturated formulation: conditions along lines of the outline, a
// seepage face on the ground where none is given, closed base and sides.
#include "polder/points/tiles.hpp"
#include "polder/step/pore_flow.hpp"

namespace polder {

/// Which condition holds for the ground of each column (number in Setup::pore_water; −1: none given), from where the
/// ground is at the start.
template <class Space>
std::vector<int> ground_conditions(const Setup<Space>& setup, const SoilPoints<Space>& soil);

/// The exits of a step that ends at `time`. `ground`: of ground_conditions(). Needs the cells' volumes and resistances.
template <class Space>
std::vector<PoreExit> pore_exits(const Setup<Space>& setup, const std::vector<int>& ground, double time, double gravity,
                                 const PoreFields<Space>& pores);

/// Sets `pores.over_ground` at `time`; true if water stands anywhere. Needs the cells' volumes.
template <class Space>
bool set_standing_water(const Setup<Space>& setup, const std::vector<int>& ground, double time, double gravity,
                        PoreFields<Space>& pores);

}  // namespace polder
