#pragma once
// A reservoir with a prescribed level H(t): a region of cells that holds as much water as if it stood still at H. What
// leaves it is replaced and what is too much is taken away, at the surface; in between the water moves by its
// equations.
#include <array>
#include <vector>

#include "polder/case/geometry.hpp"
#include "polder/case/model.hpp"
#include "polder/grid/lattice.hpp"

namespace polder {

template <class Space>
struct Reservoir {
  std::vector<std::array<int, 3>> cells;  ///< in the order of the lattice
  Table head;                             ///< m above y = 0 (plane strain) or z = 0, of the time in s
};

/// The reservoirs of a case; cells whose centre lies in the region belong to it.
template <class Space>
std::vector<Reservoir<Space>> make_reservoirs(const Model& model, const Lattice<Space>& lattice) {
  std::vector<Reservoir<Space>> reservoirs;
  for (const Boundary& boundary : model.boundaries) {
    if (boundary.water != WaterCondition::reservoir) continue;
    Reservoir<Space> reservoir;
    reservoir.head = boundary.head;
    for (std::ptrdiff_t row = 0; row < lattice.row_count(); ++row)
      for (int i = 0; i < lattice.cells[0]; ++i) {
        const std::array<int, 3> cell{i, static_cast<int>(row % lattice.cells[1]),
                                      static_cast<int>(row / lattice.cells[1])};
        const std::array<double, 3> x = lattice.centre(cell);
        if (contains(boundary.region, x[0], Space::axes == 3 ? x[1] : 0, x[Space::up])) reservoir.cells.push_back(cell);
      }
    reservoirs.push_back(std::move(reservoir));
  }
  return reservoirs;
}

}  // namespace polder
