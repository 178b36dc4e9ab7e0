#pragma once
// The cells that a soil point of the unsaturated formulation counts for: those that its box overlaps, on its own side
// of thin walls. A cell that a body cuts keeps what is in it, and one that a body covers gives it to the most open cell
// beside it. Beyond the ends of a periodic model it counts for the ghosts there, which are to be folded, or joined.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "polder/points/tiles.hpp"
#include "polder/step/chunk.hpp"
#include "polder/step/setup.hpp"

namespace polder {

template <class Space>
class PointCells {
 public:
  PointCells() = default;
  /// `half`: of the edges of the point's box, cells.
  PointCells(const Setup<Space>& setup, const std::array<double, 3>& x, const std::array<double, 3>& half) {
    std::array<int, 3> low = setup.soil_box.low, high = setup.soil_box.high;
    if (setup.walls.any() || setup.bodies.any()) {
      const auto place = cell_of(setup.lattice, x);
      own_ = setup.lattice.index(place[0], place[1], place[2]);
      stencil_ = setup.walls.beside(own_);
      bodies_ = setup.bodies.near(own_) ? &setup.bodies : nullptr;
      whole_ = setup.bodies.open_cell(own_) < 1;
      for (int a = 0; stencil_ != nullptr && a < Space::axes; ++a) {
        if (stencil_->shut[a][0]) low[a] = place[a];
        if (stencil_->shut[a][1]) high[a] = place[a] + 1;
      }
    }
    if (!setup.periodic) {
      box_ = BoxOverlap<Space>(setup.lattice, x, half, low, high);
      return;
    }
    high[0] += 2;  // counted from the ghosts below
    box_ = BoxOverlap<Space>(setup.lattice, {x[0] + setup.lattice.spacing[0], x[1], x[2]}, half, low, high);
    box_.base -= setup.lattice.stride[0];
  }

  /// body(cell index, share)
  template <class Body>
  void over_cells(const Lattice<Space>& lattice, Body&& body) const {
    if (stencil_ == nullptr && bodies_ == nullptr) return box_.over_cells(lattice, body);
    if (whole_) return body(bodies_->open_neighbour(own_), 1.0);
    box_.over_cells(lattice, [&](std::ptrdiff_t cell, double share) {
      const bool seen =
          stencil_ == nullptr || std::find(stencil_->cell.begin(), stencil_->cell.end(),
                                           static_cast<std::int32_t>(cell - own_)) != stencil_->cell.end();
      const std::ptrdiff_t to = seen ? cell : own_;
      body(bodies_ != nullptr ? bodies_->open_neighbour(to) : to, share);
    });
  }

 private:
  BoxOverlap<Space> box_;
  const WallStencil<Space>* stencil_ = nullptr;
  const Bodies<Space>* bodies_ = nullptr;
  std::ptrdiff_t own_ = 0;
  bool whole_ = false;
};

/// The cells of all points at once, as long as they do not move.
template <class Space>
class PointBoxes {
 public:
  /// Room for `points`. Each has to be set() before it is asked for.
  void resize(const Setup<Space>& setup, std::size_t points) {
    hindered_ = setup.walls.any() || setup.bodies.any();
    cells_.resize(hindered_ ? points : 0);
    base_.resize(hindered_ ? 0 : points);
    for (Array& share : share_) share.resize(base_.size());
  }

  /// `half`: by axis and point of the chunk, of the edges of its box, cells.
  void set(const Setup<Space>& setup, const std::array<Array, Space::axes>& position, std::size_t first, int count,
           const double (&half)[Space::axes][chunk_size]) {
    if (hindered_) {
      for (int l = 0; l < count; ++l) {
        std::array<double, 3> x{0, 0, 0}, halves{0, 0, 0};
        for (int a = 0; a < Space::axes; ++a) {
          x[a] = position[a][first + static_cast<std::size_t>(l)];
          halves[a] = half[a][l];
        }
        cells_[first + static_cast<std::size_t>(l)] = PointCells<Space>(setup, x, halves);
      }
      return;
    }
    const auto& lattice = setup.lattice;
    std::int32_t* base = base_.data() + first;
    std::fill_n(base, count, static_cast<std::int32_t>(lattice.index(0, 0, 0)));
    for (int a = 0; a < Space::axes; ++a) {
      const auto stride = static_cast<std::int32_t>(lattice.stride[a]);
      const int ghost = setup.soil_box.periodic(a) ? 1 : 0;  // below which cells are counted
      const int low = setup.soil_box.low[a], high = setup.soil_box.high[a] + 2 * ghost;
      const double* x = position[a].data() + first;
      double* share = share_[a].data() + first;
      for (int l = 0; l < count; ++l) {
        const AxisOverlap on_axis(lattice.axis[a].place(x[l]) + ghost, half[a][l], low, high);
        share[l] = on_axis.share;
        base[l] += (on_axis.cell - ghost) * stride;
      }
    }
  }

  /// body(cell index, share) for point p
  template <class Body>
  [[gnu::always_inline]] void over_cells(const Lattice<Space>& lattice, std::size_t p, Body&& body) const {
    if (hindered_) return cells_[p].over_cells(lattice, body);
    const std::ptrdiff_t base = base_[p], row = lattice.stride[1];
    const double x = share_[0][p], y = share_[1][p];
    const auto plane = [&](std::ptrdiff_t at, auto&& part) {
      body(at, part(x * y));
      body(at + 1, part((1 - x) * y));
      body(at + row, part(x * (1 - y)));
      body(at + row + 1, part((1 - x) * (1 - y)));
    };
    if constexpr (Space::axes == 2) {
      plane(base, [](double share) { return share; });
    } else {
      const double z = share_[Space::axes - 1][p];
      plane(base, [z](double share) { return share * z; });
      plane(base + lattice.stride[2], [z](double share) { return share * (1 - z); });
    }
  }

 private:
  bool hindered_ = false;  // by a wall or a body
  AlignedVector<std::int32_t> base_;
  std::array<Array, Space::axes> share_;  // of the lower cell on the axis
  std::vector<PointCells<Space>> cells_;  // where there are walls or bodies
};

}  // namespace polder
