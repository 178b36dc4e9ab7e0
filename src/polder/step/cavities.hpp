#pragma once
// Water that cannot be stretched: where its pressure would fall below the cavitation pressure a void opens, and the
// pressure is that one until the void has closed (docs/theory.md, "Cavitation").
#include <vector>

#include "polder/grid/pressure_solver.hpp"
#include "polder/step/fields.hpp"
#include "polder/step/setup.hpp"

namespace polder {

/// Sets grid.cavities: the cells, ascending, whose pressure is (within a per cent) the cavitation pressure or less.
/// Those without enough water stay wet unless air has come to them. To be called when the cells' fills are known.
template <class Space>
void keep_cavities(const Setup<Space>& setup, GridFields<Space>& grid);

/// Solves the equations in `solver` for grid.pressure with no pressure below the cavitation pressure: cells that would
/// be are held at it, cells that are held are let go once their void is full and water still flows in. Begins with
/// grid.cavities; iterations are those of all solves.
template <class Space>
SolveResult solve_with_cavities(const Setup<Space>& setup, GridFields<Space>& grid, PressureSolver<Space>& solver,
                                Team& team);

}  // namespace polder
