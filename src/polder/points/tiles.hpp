#pragma once
// Points sorted by cell, cells gathered in tiles, tiles coloured.
//
// Within a colour no two tiles write to the same face: a point writes from one cell below to three above its own, and
// may have drifted half a cell since the last sort, so a tile of six cells or more suffices. Tiles of a colour are
// processed by any thread in any order; the colours one after the other. So every sum has one order.
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "polder/grid/active_rows.hpp"
#include "polder/math/threads.hpp"
#include "polder/points/point_sets.hpp"

namespace polder {

struct TileRange {
  std::uint32_t first, count;
};

template <class Space>
struct Tiling {
  static constexpr int width = 6;
  static constexpr int in_tile = width * width * (Space::axes == 3 ? width : 1);  ///< cells
  static constexpr int colours = 1 << Space::axes;
  std::array<std::vector<TileRange>, colours> by_colour;
  /// All points as they lie in memory, in ranges of whole tiles; not those of the colours.
  std::vector<TileRange> in_order;
};

/// Drift since the last sort, in cells, beyond which points must be sorted again.
inline constexpr double largest_drift = 0.5;

/// Cell of a position, clamped to the lattice; that of what is no number is 0 (within a step positions may be anything:
/// the guards look at them when it is done).
template <class Space>
std::array<int, 3> cell_of(const Lattice<Space>& lattice, const std::array<double, 3>& x) {
  std::array<int, 3> cell{0, 0, 0};
  for (int a = 0; a < Space::axes; ++a)
    cell[a] = static_cast<int>(std::min(std::max(0.0, lattice.axis[a].place(x[a])), lattice.cells[a] - 1.0));
  return cell;
}

/// The same as its index in the lattice.
template <class Space>
std::ptrdiff_t cell_at(const Lattice<Space>& lattice, const std::array<double, 3>& x) {
  const auto cell = cell_of(lattice, x);
  return lattice.index(cell[0], cell[1], cell[2]);
}

/// Tiles along each axis.
template <class Space>
std::array<int, 3> tiles_of(const Lattice<Space>& lattice) {
  std::array<int, 3> tiles{1, 1, 1};
  for (int a = 0; a < Space::axes; ++a) tiles[a] = (lattice.cells[a] + Tiling<Space>::width - 1) / Tiling<Space>::width;
  return tiles;
}

/// Homes there are; some at the high ends are of cells beyond the lattice.
template <class Space>
std::int64_t count_homes(const Lattice<Space>& lattice) {
  const auto tiles = tiles_of(lattice);
  return std::int64_t{Tiling<Space>::in_tile} * tiles[0] * tiles[1] * tiles[2];
}

/// The tiles of points that are sorted, from their homes.
template <class Space>
void tile_points(const Lattice<Space>& lattice, const AlignedVector<std::int32_t>& home, Tiling<Space>& tiling);

/// The cell that a home stands for.
template <class Space>
std::array<int, 3> cell_of_home(const Lattice<Space>& lattice, std::int32_t home) {
  constexpr int width = Tiling<Space>::width, in_tile = Tiling<Space>::in_tile;
  const auto tiles = tiles_of(lattice);
  int tile = home / in_tile, inner = home % in_tile;
  std::array<int, 3> cell{0, 0, 0};
  for (int a = 0; a < Space::axes; ++a) {
    cell[a] = tile % tiles[a] * width + inner % width;
    tile /= tiles[a];
    inner /= width;
  }
  return cell;
}

/// How far from a point's home anything may happen in a step, in cells: half a cell of drift and half a cell of box
/// make its neighbours wet, the faces of those carry velocities, extrapolated two layers on, and splines read one
/// further.
inline constexpr int reach = 6;

/// The rows near points of either phase, sorted, dealt out to `threads`.
template <class Space>
ActiveRows<Space> rows_near(const Lattice<Space>& lattice, const AlignedVector<std::int32_t>& soil_home,
                            const AlignedVector<std::int32_t>& water_home, int threads);

/// Sorts the points by tile, then cell, stable within a cell; sets `home`.
template <class Space, class Points>
void sort_points(const Lattice<Space>& lattice, Points& points, Tiling<Space>& tiling, Team& team);

}  // namespace polder
