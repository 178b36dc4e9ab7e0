#pragma once
// Wells in a step: what they take from the pressure equation, and the points that pay it (docs/theory.md, "Wells").
#include <cstdint>
#include <vector>

#include "polder/grid/pressure_solver.hpp"
#include "polder/points/point_sets.hpp"
#include "polder/step/fields.hpp"
#include "polder/step/pore_flow.hpp"
#include "polder/step/reservoirs.hpp"
#include "polder/step/setup.hpp"

namespace polder {

/// What passes between a cell and a well: out = conductance (p − level) + rate.
struct WellFlow {
  std::ptrdiff_t cell;
  double conductance;  ///< m³/s/Pa
  double level;        ///< Pa, pressure at the cell's centre that the well's head makes
  double rate;         ///< m³/s, given
};

/// The flows of the wet cells of all wells at `time`. A drain takes nothing where the pressure of the last step was
/// below its own. After water_to_grid().
template <class Space>
std::vector<WellFlow> well_flows(const Setup<Space>& setup, double time, const GridFields<Space>& grid);

/// The same in the unsaturated formulation, as exits of the pores: of cells without suction, and a well's water is in
/// its part below its head. After prepare_cells().
template <class Space>
std::vector<PoreExit> well_exits(const Setup<Space>& setup, double time, const GridFields<Space>& grid,
                                 const PoreFields<Space>& pores);

/// Takes what has flowed in the step out of the cells' points, the smallest first, or adds it to them. Returns what was
/// exchanged; `sorted` becomes false where points have come or gone.
template <class Space>
std::vector<Exchange> exchange_with_wells(const Setup<Space>& setup, double dt, const std::vector<WellFlow>& flows,
                                          GridFields<Space>& grid, std::uint64_t& next_id, WaterPoints<Space>& water,
                                          bool& sorted);

}  // namespace polder
