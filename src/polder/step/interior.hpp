#pragma once
// Cells in the midst of the water.
#include <algorithm>
#include <array>

#include "polder/step/fields.hpp"
#include "polder/step/setup.hpp"

namespace polder {

/// Whether every neighbour of a cell at `place` is wet or shut off by a wall.
template <class Space>
bool is_inside_water(const Setup<Space>& setup, const GridFields<Space>& grid, std::ptrdiff_t cell,
                     const std::array<int, 3>& place) {
  for (int a = 0; a < Space::axes; ++a) {
    const std::ptrdiff_t s = setup.lattice.stride[a];
    const bool joined = setup.water_box.periodic(a);
    const bool below = grid.wet[cell - s] || (!joined && (place[a] == 0 || setup.shut(a, cell)));
    const bool above =
        grid.wet[cell + s] || (!joined && (place[a] == setup.lattice.cells[a] - 1 || setup.shut(a, cell + s)));
    if (!below || !above) return false;
  }
  return true;
}

/// Share of a face inside the model that water flows through: all of it where water stands above the cells on both
/// sides (there the pressure balances whole faces, whatever the fills scatter by), up to the surface by their fills.
template <class Space>
double flowing_share(const Setup<Space>& setup, const GridFields<Space>& grid, int axis, std::ptrdiff_t face) {
  const std::ptrdiff_t low = face - setup.lattice.stride[axis];
  const std::ptrdiff_t over = axis == Space::up ? 0 : setup.lattice.stride[Space::up];
  if (grid.wet[low] && grid.wet[face] && grid.wet[low + over] && grid.wet[face + over]) return 1;
  return 0.5 * (grid.fill[low] + grid.fill[face]);
}

}  // namespace polder
