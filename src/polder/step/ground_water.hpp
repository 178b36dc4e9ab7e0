#pragma once
// Where the pore water meets the outside in the unsaturated formulation: conditions along lines of the outline, a
// seepage face on the ground where none is given, closed base and sides.
#include "polder/points/tiles.hpp"
#include "polder/step/pore_flow.hpp"

namespace polder {

/// Free water on the ground and what passes between the two in a step, by column of cells.
struct GroundCover {
  Array pressure;   ///< Pa, at the ground; 0 where none stands on it
  Array available;  ///< m³ that may seep in; below 0: what the air takes out
  Array gained;     ///< m³ that has come out of the ground; below 0: seeped in
  Array bare;       ///< m above the model's base: surface of water that stands where there is no soil; 0: none
};

/// m above the model's base: top of the soil of each column; −1 where there is none.
template <class Space>
Array ground_heights(const Setup<Space>& setup, const Array& bulk);

/// The same by the boxes of the points.
template <class Space>
Array ground_heights(const Setup<Space>& setup, const SoilPoints<Space>& soil);

/// Which condition holds for the ground of each column (number in Setup::pore_water; −1: none given), from where the
/// ground is at the start.
template <class Space>
std::vector<int> ground_conditions(const Setup<Space>& setup, const SoilPoints<Space>& soil);

/// The exits of a step of `dt` that ends at `time`. `ground`: of ground_conditions(); `cover`: free water on the
/// ground, or nullptr. Needs the cells' volumes and resistances.
template <class Space>
std::vector<PoreExit> pore_exits(const Setup<Space>& setup, const std::vector<int>& ground, double time, double dt,
                                 double gravity, const PoreFields<Space>& pores, const GroundCover* cover);

/// Sets what `pores` has of water that stands on the ground (over_ground to flooded) at `time`; true if water stands
/// anywhere. Needs the cells' volumes.
template <class Space>
bool set_standing_water(const Setup<Space>& setup, const std::vector<int>& ground, double time, double gravity,
                        PoreFields<Space>& pores, const GroundCover* cover);

}  // namespace polder
