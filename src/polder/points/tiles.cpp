#include "polder/points/tiles.hpp"

#include <algorithm>
#include <cmath>

namespace polder {

template <class Space, class Points>
void sort_points(const Lattice<Space>& lattice, Points& points, Tiling<Space>& tiling, Team& team) {
  constexpr int width = Tiling<Space>::width, in_tile = Tiling<Space>::in_tile;
  const auto tiles = tiles_of(lattice);

  const std::size_t n = points.size();
  std::vector<std::uint32_t> key(n), order(n);
  team.share(static_cast<std::ptrdiff_t>(n), [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    for (std::ptrdiff_t p = begin; p < end; ++p) {
      std::array<double, 3> x{0, 0, 0};
      for (int a = 0; a < Space::axes; ++a) x[a] = points.position[a][p];
      const auto cell = cell_of(lattice, x);
      std::uint32_t tile = 0, inner = 0;
      for (int a = Space::axes - 1; a >= 0; --a) {
        tile = tile * static_cast<std::uint32_t>(tiles[a]) + static_cast<std::uint32_t>(cell[a] / width);
        inner = inner * width + static_cast<std::uint32_t>(cell[a] % width);
      }
      key[p] = tile * in_tile + inner;
      points.home[p] = static_cast<std::int32_t>(key[p]);
    }
  });

  std::vector<std::uint32_t> start(static_cast<std::size_t>(count_homes(lattice)) + 1, 0);
  for (const auto k : key) ++start[k + 1];
  for (std::size_t c = 1; c < start.size(); ++c) start[c] += start[c - 1];
  std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
  for (std::size_t p = 0; p < n; ++p) order[next[key[p]]++] = static_cast<std::uint32_t>(p);

  const auto permute = [&](auto& array) {
    auto sorted = array;
    for (std::size_t p = 0; p < n; ++p) sorted[p] = array[order[p]];
    array.swap(sorted);
  };
  std::vector<std::function<void()>> jobs;
  points.each_array([&](const char*, int, auto& array) { jobs.emplace_back([&permute, &array] { permute(array); }); });
  team.each(static_cast<std::ptrdiff_t>(jobs.size()), [&](std::ptrdiff_t j) { jobs[j](); });

  tile_points(lattice, points.home, tiling);
}

// Tiles that follow one another along x are taken together, as one range of points: a whole row of them where there are
// many rows, a part of one where there are few, so that threads find enough of them in a colour to end together. So the
// points of a range lie one after the other in memory, and ranges of a colour, two rows or parts of a row from each
// other, still do not write to the same faces. Where points write to nothing but themselves, ranges are of several
// hundred points, whatever the tiles: the last batch of a range is seldom full.
template <class Space>
void tile_points(const Lattice<Space>& lattice, const AlignedVector<std::int32_t>& home, Tiling<Space>& tiling) {
  constexpr int many_parts = 160, in_tile = Tiling<Space>::in_tile;
  constexpr std::uint32_t worth_a_range = 512;  // points, where a range may be as long as one likes
  const auto tiles = tiles_of(lattice);
  const int parts = std::clamp(many_parts / (tiles[1] * tiles[2]), 1, (tiles[0] + 1) / 2);
  for (auto& list : tiling.by_colour) list.clear();
  tiling.in_order.clear();
  std::array<int, 3> last_range{-1, -1, -1};
  for (std::size_t first = 0, last = 0; first < home.size(); first = last) {
    const int tile = home[first] / in_tile;
    while (last < home.size() && home[last] / in_tile == tile) ++last;
    const std::array<int, 3> range{tile % tiles[0] * parts / tiles[0], tile / tiles[0] % tiles[1],
                                   tile / tiles[0] / tiles[1]};
    auto& of_colour = tiling.by_colour[range[0] % 2 + 2 * (range[1] % 2) + 4 * (range[2] % 2)];
    const auto add = [&](std::vector<TileRange>& list, bool begin) {
      if (begin) list.push_back({static_cast<std::uint32_t>(first), 0});
      list.back().count += static_cast<std::uint32_t>(last - first);
    };
    add(of_colour, range != last_range);
    add(tiling.in_order, tiling.in_order.empty() || tiling.in_order.back().count >= worth_a_range);
    last_range = range;
  }
}

template <class Space>
ActiveRows<Space> rows_near(const Lattice<Space>& lattice, const AlignedVector<std::int32_t>& soil_home,
                            const AlignedVector<std::int32_t>& water_home, int threads) {
  ActiveRows<Space> rows(lattice, threads);
  std::vector<RowSpan> occupied(rows.spans.size());
  for (const auto* homes : {&soil_home, &water_home}) {
    std::int32_t last = -1;
    for (const std::int32_t home : *homes) {
      if (home == last) continue;
      last = home;
      const auto cell = cell_of_home(lattice, home);
      RowSpan& span = occupied[cell[1] + static_cast<std::size_t>(cell[2]) * lattice.cells[1]];
      span = span.joined({cell[0], cell[0] + 1});
    }
  }
  // a row takes what its neighbours within reach have, axis after axis
  for (int axis = 1; axis < Space::axes; ++axis) {
    const std::ptrdiff_t step = axis == 1 ? 1 : lattice.cells[1];
    for (std::size_t row = 0; row < occupied.size(); ++row) {
      const int place = static_cast<int>(static_cast<std::ptrdiff_t>(row) / step) % lattice.cells[axis];
      RowSpan span;
      for (int d = -std::min(reach, place); d <= std::min(reach, lattice.cells[axis] - 1 - place); ++d)
        span = span.joined(occupied[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(row) + d * step)]);
      rows.spans[row] = span;
    }
    occupied = rows.spans;
  }
  for (RowSpan& span : rows.spans)
    if (span.count() > 0) span = {std::max(0, span.begin - reach), std::min(lattice.cells[0], span.end + reach)};
  rows.finish(threads);
  return rows;
}

template ActiveRows<PlaneStrain> rows_near(const Lattice<PlaneStrain>&, const AlignedVector<std::int32_t>&,
                                           const AlignedVector<std::int32_t>&, int);
template ActiveRows<Solid> rows_near(const Lattice<Solid>&, const AlignedVector<std::int32_t>&,
                                     const AlignedVector<std::int32_t>&, int);
template void tile_points(const Lattice<PlaneStrain>&, const AlignedVector<std::int32_t>&, Tiling<PlaneStrain>&);
template void tile_points(const Lattice<Solid>&, const AlignedVector<std::int32_t>&, Tiling<Solid>&);
template void sort_points(const Lattice<PlaneStrain>&, WaterPoints<PlaneStrain>&, Tiling<PlaneStrain>&, Team&);
template void sort_points(const Lattice<PlaneStrain>&, SoilPoints<PlaneStrain>&, Tiling<PlaneStrain>&, Team&);
template void sort_points(const Lattice<Solid>&, WaterPoints<Solid>&, Tiling<Solid>&, Team&);
template void sort_points(const Lattice<Solid>&, SoilPoints<Solid>&, Tiling<Solid>&, Team&);

}  // namespace polder
