#pragma once
// The staggered grid: cells with pressure at their centres, velocity components on their faces.
//
// One index serves everything. Cell (i, j, k) and its low face on axis c share the index (i, j, k); face i of a row of
// n cells runs from 0 to n. Ghosts (one below, three above) take what spline weights reach beyond the box.
#include <array>
#include <cstddef>

#include "polder/case/grid_axis.hpp"
#include "polder/grid/graded_spline.hpp"
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
  std::array<double, 3> spacing{1, 1, 1};  ///< m, width of the smallest cell on each axis: of all where not graded
  std::array<GridAxis, 3> axis;
  bool graded = false;                                          ///< on any axis
  std::array<std::shared_ptr<const GradedSpline>, 3> spline{};  ///< where graded
  std::array<std::ptrdiff_t, 3> stride{1, 0, 0};
  std::ptrdiff_t size = 0;  ///< of an array over cells or faces, ghosts included

  Lattice() = default;
  Lattice(const std::array<int, 3>& n, const std::array<double, 3>& h)
      : Lattice({GridAxis(n[0], h[0]), GridAxis(n[1], h[1]), axes == 3 ? GridAxis(n[2], h[2]) : GridAxis()}) {}
  explicit Lattice(const std::array<GridAxis, 3>& divided) : axis(divided) {
    for (int a = 0; a < axes; ++a) {
      cells[a] = axis[a].cells();
      spacing[a] = axis[a].least();
      graded = graded || axis[a].graded();
    }
    for (int a = 0; graded && a < axes; ++a) spline[a] = std::make_shared<const GradedSpline>(axis[a]);
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
  /// Place on an axis of the cell (or face) with this index.
  int place(std::ptrdiff_t index_, int a) const {
    if (a + 1 < axes) index_ %= stride[a + 1];
    return static_cast<int>(index_ / stride[a]) - ghost_low;
  }
  std::array<int, 3> places(std::ptrdiff_t index_) const {
    std::array<int, 3> at{0, 0, 0};
    for (int a = 0; a < axes; ++a) at[a] = place(index_, a);
    return at;
  }
  double cell_volume() const {
    double v = 1;
    for (int a = 0; a < axes; ++a) v *= spacing[a];
    return v;
  }
  double face_area(int across) const { return cell_volume() / spacing[across]; }
  /// Of the cell at this place; of its low face on an axis.
  double cell_volume(const std::array<int, 3>& at) const {
    if (!graded) return cell_volume();
    double v = 1;
    for (int a = 0; a < axes; ++a) v *= axis[a].width(at[a]);
    return v;
  }
  double face_area(int across, const std::array<int, 3>& at) const {
    return graded ? cell_volume(at) / axis[across].width(at[across]) : face_area(across);
  }
  /// The same, by index.
  double cell_volume(std::ptrdiff_t index_) const { return graded ? cell_volume(places(index_)) : cell_volume(); }
  double face_area(int across, std::ptrdiff_t index_) const {
    return graded ? face_area(across, places(index_)) : face_area(across);
  }
  /// Middle of the cell at this place, m.
  std::array<double, 3> centre(const std::array<int, 3>& at) const {
    std::array<double, 3> x{0, 0, 0};
    for (int a = 0; a < axes; ++a) x[a] = axis[a].centre(at[a]);
    return x;
  }
  double length(int a) const { return axis[a].length(); }
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

/// body.operator()<graded>(): what loops over many points or cells is compiled for lattices of equal cells and for
/// graded ones.
template <class Space, class Body>
[[gnu::always_inline]] inline void by_spacing(const Lattice<Space>& lattice, Body&& body) {
  if (lattice.graded)
    body.template operator()<true>();
  else
    body.template operator()<false>();
}

/// Volumes of the cells of a row along x, by their number in it.
template <class Space>
class RowVolume {
 public:
  RowVolume(const Lattice<Space>& lattice, const std::array<int, 3>& first) : volume_(lattice.cell_volume(first)) {
    if (!lattice.axis[0].graded()) return;
    axis_ = &lattice.axis[0];
    first_ = first[0];
    volume_ /= axis_->width(first_);
  }
  double operator()(std::ptrdiff_t i) const {
    return axis_ == nullptr ? volume_ : volume_ * axis_->width(first_ + static_cast<int>(i));
  }

 private:
  double volume_;
  const GridAxis* axis_ = nullptr;
  int first_ = 0;
};

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
