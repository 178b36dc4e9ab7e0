#pragma once
// The cell next to another, round the ends of a periodic model.
#include <cstddef>

#include "polder/grid/lattice.hpp"
#include "polder/grid/walls.hpp"

namespace polder {

/// On an axis, `way` −1 or 1; −1 at a side of the box that has nothing beyond it.
template <class Space>
std::ptrdiff_t cell_beside(const Lattice<Space>& lattice, const PhaseBox& box, std::ptrdiff_t cell, int axis, int way) {
  const int last = lattice.cells[axis] - 1;
  if (lattice.place(cell, axis) != (way > 0 ? last : 0)) return cell + way * lattice.stride[axis];
  return box.periodic(axis) ? cell - way * last * lattice.stride[axis] : -1;
}

}  // namespace polder
