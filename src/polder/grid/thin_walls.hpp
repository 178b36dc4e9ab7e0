#pragma once
// Walls thinner than a cell: faces of the grid that nothing crosses, while the cells on both sides stay whole.
//
// A point may share a cell's neighbourhood with nodes that lie behind a wall. What its spline would write to such a
// node goes to the node's mirror image on the point's own side, and what it would read there is that image, as at the
// walls of a phase's box (grid/walls.hpp): even for masses and, at a smooth wall, tangential components, odd for the
// component normal to the wall and, at a rough one, the tangential ones too. So no node is needed twice, and reading
// stays the transpose of writing. What a point sees depends only on its cell: the cells of the 3 × 3 (× 3) around it
// that are reached step by step without crossing a wall; around the end of a wall the two sides meet.
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "polder/grid/lattice.hpp"

namespace polder {

/// What the points of one cell see instead of the nodes of their stencils. Nodes are numbered by their offsets from the
/// cell: −1 … 2 on the axis of the component, where they are faces, −1 … 1 on the others.
template <class Space>
struct WallStencil {
  static constexpr int axes = Space::axes;
  static constexpr int nodes = axes == 2 ? 16 : 64;  ///< 4 per axis
  static constexpr int block = axes == 2 ? 9 : 27;

  struct Node {
    std::int32_t at = 0;  ///< index relative to the cell's
    double sign = 1;      ///< of momentum, force and velocity; masses are always even
  };
  std::array<std::array<Node, nodes>, static_cast<std::size_t>(axes)> of;  ///< [component][node]
  std::array<std::int32_t, block> cell{};     ///< of the 3 × 3 (× 3): itself or, unreached, the own cell, relative
  std::array<std::array<bool, 2>, 3> shut{};  ///< [axis][low, high]: the own faces

  static int node(int o0, int o1, int o2) { return (o0 + 1) + 4 * (o1 + 1) + (axes == 3 ? 16 * (o2 + 1) : 0); }
};

enum class WallFaceKind : std::uint8_t { none, smooth, rough };

template <class Space>
class ThinWalls {
 public:
  ThinWalls() = default;
  explicit ThinWalls(const Lattice<Space>& lattice);

  /// Closes the low face of cell (i, j, k) on an axis. Follow the last with finish().
  void close(int axis, std::array<int, 3> cell, WallFaceKind kind);
  void finish();

  bool any() const { return any_; }
  /// Whether nothing crosses this face; false everywhere without walls.
  bool blocked(int axis, std::ptrdiff_t face) const { return any_ && faces_[axis][face] != 0; }
  /// Whether none of `count` faces that follow each other along x is blocked.
  bool open(int axis, std::ptrdiff_t face, int count) const {
    if (!any_) return true;
    const std::uint8_t* kind = faces_[axis].data() + face;
    return std::all_of(kind, kind + count, [](std::uint8_t k) { return k == 0; });
  }
  /// The stencil of a cell beside a wall, or nullptr.
  const WallStencil<Space>* beside(std::ptrdiff_t cell) const {
    return any_ && stencil_of_[cell] >= 0 ? &stencils_[static_cast<std::size_t>(stencil_of_[cell])] : nullptr;
  }

 private:
  WallStencil<Space> stencil_at(std::ptrdiff_t cell) const;

  Lattice<Space> lattice_;
  bool any_ = false;
  std::array<AlignedVector<std::uint8_t>, static_cast<std::size_t>(Space::axes)> faces_;
  AlignedVector<std::int32_t> stencil_of_;
  std::vector<WallStencil<Space>> stencils_;
};

/// Takes a point from `from` towards `to` cell by cell. Where a wall is in the way the point stays this far from it, in
/// cells, and goes on along it.
inline constexpr double wall_gap = 1e-6;
template <class Space>
void stop_at_walls(const Lattice<Space>& lattice, const ThinWalls<Space>& walls, const std::array<double, 3>& from,
                   std::array<double, 3>& to);

}  // namespace polder
