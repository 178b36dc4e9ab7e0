#pragma once
// Soil in cells that a body cuts, in the unsaturated formulation: across the body's surface it is as thick as what the
// body leaves, along it the cell is what it was (docs/theory.md, "Unsaturated soil").
#include <cmath>

#include "polder/grid/bodies.hpp"

namespace polder {

/// 1 where a body's surface lies across this axis in the cell, 0 where it lies along it or where there is none.
template <class Space>
double lies_across(const Bodies<Space>& bodies, const Lattice<Space>& lattice, int axis, std::ptrdiff_t cell) {
  return std::abs(bodies.open_face(axis, cell + lattice.stride[axis]) - bodies.open_face(axis, cell));
}

/// Thickness along the axis, cells, of what is open of a cell, `share` of it.
template <class Space>
double thickness(const Bodies<Space>& bodies, const Lattice<Space>& lattice, int axis, std::ptrdiff_t cell,
                 double share) {
  return 1 - lies_across(bodies, lattice, axis, cell) * (1 - share);
}

/// What a derivative along the axis counts for of the volume of soil in this cell: across a body's surface as if it
/// filled the cell; nothing where the cell counts as covered, so that what presses is what is in its neighbour.
template <class Space>
double pressing_part(const Bodies<Space>& bodies, const Lattice<Space>& lattice, int axis, std::ptrdiff_t cell) {
  const double share = bodies.own_share(cell);
  if (share == 1) return 1;
  if (share > 0) return 1 / thickness(bodies, lattice, axis, cell, share);
  return 1 - lies_across(bodies, lattice, axis, bodies.open_neighbour(cell));
}

}  // namespace polder
