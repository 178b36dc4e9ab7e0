#pragma once
// Cells in the midst of the water.
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

}  // namespace polder
