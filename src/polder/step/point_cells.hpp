#pragma once
// The cells that a soil point of the unsaturated formulation counts for: those that its box overlaps, on its own side
// of thin walls. A cell that a body cuts keeps what is in it, and one that a body covers gives it to the most open cell
// beside it.
#include <algorithm>

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
    box_ = BoxOverlap<Space>(setup.lattice, x, half, low, high);
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

}  // namespace polder
