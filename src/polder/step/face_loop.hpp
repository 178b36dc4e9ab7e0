#pragma once
// Loops over the faces and cells of a lattice, row by row, rows shared out over the team.
#include "polder/grid/lattice.hpp"
#include "polder/math/threads.hpp"

namespace polder {

/// Shares `rows` rows out over the team where the grid is large enough to gain by it.
template <class Space, class Body>
void share_rows(const Lattice<Space>& lattice, std::ptrdiff_t rows, Team& team, Body&& body) {
  if (lattice.cell_count() < cells_worth_sharing)
    body(std::ptrdiff_t{0}, rows);
  else
    team.share(rows, body);
}

/// body(index of the row's first face, number of faces, j, k) for every row of faces of component c, walls included.
template <class Space, class Body>
void over_face_rows(const Lattice<Space>& lattice, int c, Team& team, Body&& body) {
  const int nx = lattice.cells[0] + (c == 0), ny = lattice.cells[1] + (c == 1);
  const int nz = Space::axes == 3 ? lattice.cells[2] + (c == 2) : 1;
  share_rows(lattice, static_cast<std::ptrdiff_t>(ny) * nz, team, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    for (std::ptrdiff_t row = begin; row < end; ++row) {
      const int j = static_cast<int>(row % ny), k = static_cast<int>(row / ny);
      body(lattice.index(0, j, k), nx, j, k);
    }
  });
}

/// body(index of the row's first cell, j, k) for every row of cells.
template <class Space, class Body>
void over_cell_rows(const Lattice<Space>& lattice, Team& team, Body&& body) {
  share_rows(lattice, lattice.row_count(), team, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    for (std::ptrdiff_t row = begin; row < end; ++row) {
      const int j = static_cast<int>(row % lattice.cells[1]), k = static_cast<int>(row / lattice.cells[1]);
      body(lattice.index(0, j, k), j, k);
    }
  });
}

/// Where a face stands on its own axis: 0 … cells. `i` along x.
inline int place_on_axis(int c, int i, int j, int k) { return c == 0 ? i : c == 1 ? j : k; }

}  // namespace polder
