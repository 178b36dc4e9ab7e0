#pragma once
// Loops over points, tile by tile and there chunk by chunk.
#include <type_traits>

#include "polder/points/tiles.hpp"
#include "polder/step/chunk.hpp"

namespace polder {

inline constexpr std::size_t many_points = 100000;  // that do not fit the processor's caches

/// What comes after a chunk, so that its memory can be asked for in time: a kernel walks along twenty arrays and some
/// ten fields of the grid, more than the processor's own guesses follow. Asked for into the second level of its caches:
/// the first is too small for what is worked on and what comes next. Nothing is asked for where all fits the caches.
template <class Space>
class Upcoming {
 public:
  /// After points [first, first + count) of those with these homes.
  Upcoming(const Lattice<Space>& lattice, const AlignedVector<std::int32_t>& home, std::size_t first, int count)
      : next_(first + static_cast<std::size_t>(count)), far_(home.size() >= many_points) {
    if (!far_) return;
    // The rows of the tile in which the points are that come a tile later, as far as the next chunk is into it.
    constexpr std::size_t ahead = std::size_t{in_tile} << Space::axes;
    if (next_ + ahead >= home.size()) return;
    const std::int32_t from = home[next_ + ahead - static_cast<std::size_t>(count)], to = home[next_ + ahead];
    tile_ = to / in_tile;
    first_row_ = from / in_tile == tile_ ? from % in_tile * rows / in_tile : 0;
    end_row_ = (to % in_tile + 1) * rows / in_tile;
    const auto corner = cell_of_home(lattice, tile_ * in_tile);
    corner_ = lattice.index(corner[0], corner[1], corner[2]);
  }

  /// Points: one array or several.
  template <class... Arrays>
  [[gnu::always_inline]] void ask_for_points(const Arrays&... arrays) const {
    if (!far_) return;
    const auto ask = [this](const Array& array) {
      for (std::size_t i = 0; i < chunk_size; i += line) __builtin_prefetch(array.data() + next_ + i, 0, second_level);
    };
    (each_array(arrays, ask), ...);
  }

  /// Fields on faces or in cells, `values` side by side on each.
  template <int values, class... Fields>
  [[gnu::always_inline]] void ask_for_grid(const Lattice<Space>& lattice, const Fields&... fields) const {
    for (int row = first_row_; row < end_row_; ++row) {
      const std::ptrdiff_t at = values * (corner_ - 1 + (row % across - 1) * lattice.stride[1] +
                                          (Space::axes == 3 ? row / across - 1 : 0) * lattice.stride[2]);
      const auto ask = [at](const Array& field) {
        for (int i = 0; i < values * across; i += line) __builtin_prefetch(field.data() + at + i, 0, second_level);
        __builtin_prefetch(field.data() + at + std::ptrdiff_t{values} * across - 1, 0, second_level);
      };
      (each_array(fields, ask), ...);
    }
  }

 private:
  static constexpr int width = Tiling<Space>::width, in_tile = Tiling<Space>::in_tile;
  static constexpr int across = width + 4,
                       rows = Space::axes == 2 ? across : across * across;  // with what splines reach
  static constexpr int line = 8;                                            // values of a cache line
  static constexpr int second_level = 2;

  template <class Arrays, class Ask>
  [[gnu::always_inline]] static void each_array(const Arrays& one_or_more, Ask&& ask) {
    if constexpr (std::is_same_v<Arrays, Array>)
      ask(one_or_more);
    else
      for (const Array& array : one_or_more) ask(array);
  }

  std::size_t next_;
  bool far_;  // memory from the processor
  std::int32_t tile_ = 0;
  int first_row_ = 0, end_row_ = 0;
  std::ptrdiff_t corner_ = 0;
};

/// Runs body(range) over ranges that do not touch each other, each thread beginning with its share of the points.
template <class Body>
void over_ranges(const std::vector<TileRange>& ranges, Team& team, Body&& body) {
  team.each(
      static_cast<std::ptrdiff_t>(ranges.size()), [&](std::ptrdiff_t t) { body(ranges[t]); },
      [&](std::ptrdiff_t t) { return std::ptrdiff_t{ranges[t].count}; });
}

/// Runs body(first point, count) over chunks of every range of tiles, colour after colour.
template <class Space, class Body>
void over_chunks(const Tiling<Space>& tiling, Team& team, Body&& body) {
  for (const auto& tiles : tiling.by_colour)
    over_ranges(tiles, team, [&](const TileRange& range) {
      for (std::uint32_t done = 0; done < range.count; done += chunk_size)
        body(std::size_t{range.first} + done, std::min(chunk_size, static_cast<int>(range.count - done)));
    });
}

}  // namespace polder
