#pragma once
// The staggered grid: cells with pressure at their centres, velocity components on their faces.
//
// One index serves everything. Cell (i, j, k) and its low face on axis c share the index (i, j, k); face i of a row of
// n cells runs from 0 to n. Ghosts (one below, three above) take what spline weights reach beyond the box.
#include <array>
#include <cstddef>

#include "polder/math/array.hpp"
#include "polder/math/space.hpp"

namespace polder {

/// Grids of fewer cells are worked on by one thread: the others would cost more time in barriers than they save.
inline constexpr std::ptrdiff_t cells_worth_sharing = 4000;

template <class Space>
struct Lattice {
  static constexpr int axes = Space::axes;
  static constexpr int ghost_low = 1, ghost_high = 3;

  std::array<int, 3> cells{1, 1, 1};
  std::array<double, 3> spacing{1, 1, 1};  ///< m
  std::array<std::ptrdiff_t, 3> stride{1, 0, 0};
  std::ptrdiff_t size = 0;  ///< of an array over cells or faces, ghosts included

  Lattice() = default;
  Lattice(const std::array<int, 3>& n, const std::array<double, 3>& h) {
    for (int a = 0; a < axes; ++a) {
      cells[a] = n[a];
      spacing[a] = h[a];
    }
    std::ptrdiff_t extent[3] = {1, 1, 1};
    for (int a = 0; a < axes; ++a) extent[a] = cells[a] + ghost_low + ghost_high;
    extent[0] += extent[0] % 2 == 0;  // an odd row length keeps rows off one another's cache sets
    stride = {1, extent[0], axes == 3 ? extent[0] * extent[1] : 0};
    size = extent[0] * extent[1] * extent[2] + 8;
  }

  std::ptrdiff_t index(int i, int j, int k = 0) const {
    std::ptrdiff_t at = (i + ghost_low) + (j + ghost_low) * stride[1];
    if constexpr (axes == 3) at += (k + ghost_low) * stride[2];
    return at;
  }
  /// Place on `axis` of the cell (or face) with this index.
  int place(std::ptrdiff_t index_, int axis) const {
    if (axis + 1 < axes) index_ %= stride[axis + 1];
    return static_cast<int>(index_ / stride[axis]) - ghost_low;
  }
  double cell_volume() const {
    double v = 1;
    for (int a = 0; a < axes; ++a) v *= spacing[a];
    return v;
  }
  double face_area(int axis) const { return cell_volume() / spacing[axis]; }
  double length(int axis) const { return cells[axis] * spacing[axis]; }
  double smallest_spacing() const {
    double h = spacing[0];
    for (int a = 1; a < axes; ++a) h = spacing[a] < h ? spacing[a] : h;
    return h;
  }
  std::ptrdiff_t cell_count() const {
    return static_cast<std::ptrdiff_t>(cells[0]) * cells[1] * (axes == 3 ? cells[2] : 1);
  }
  /// Rows along x of the cells; row r holds (j, k) = (r mod ny, r div ny).
  std::ptrdiff_t row_count() const { return static_cast<std::ptrdiff_t>(cells[1]) * (axes == 3 ? cells[2] : 1); }

  Array make_array() const { return Array(static_cast<std::size_t>(size), 0.0); }
};

/// body(cell, place) for every cell of the lattice, row after row, from below upwards.
template <class Space, class Body>
void over_all_cells(const Lattice<Space>& lattice, Body&& body) {
  for (std::ptrdiff_t row = 0; row < lattice.row_count(); ++row) {
    const int j = static_cast<int>(row % lattice.cells[1]), k = static_cast<int>(row / lattice.cells[1]);
    for (int i = 0; i < lattice.cells[0]; ++i) body(lattice.index(i, j, k), std::array<int, 3>{i, j, k});
  }
}

/// One array per component of a vector on the faces.
template <class Space>
using FaceField = std::array<Array, static_cast<std::size_t>(Space::axes)>;

template <class Space>
FaceField<Space> make_face_field(const Lattice<Space>& lattice) {
  FaceField<Space> field;
  for (auto& component : field) component = lattice.make_array();
  return field;
}

}  // namespace polder
