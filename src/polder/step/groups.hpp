#pragma once
// Groups of soil points: those that were in one cell when the points were last sorted, hence neighbours in memory. They
// share what one cell does not resolve: their volume change in part (F-bar) and, as their grains slide, their porosity.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "polder/math/simd.hpp"
#include "polder/points/point_sets.hpp"
#include "polder/points/tiles.hpp"
#include "polder/step/chunk.hpp"

namespace polder {

inline constexpr double porosity_mixing = 48;  // of a group's porosities, per unit of plastic shear strain

/// Number of points from `first` that make up whole groups and fit a chunk; a group too large for one is cut.
template <class Space>
int whole_groups(const SoilPoints<Space>& soil, std::size_t first, std::size_t end) {
  const std::size_t room = std::min<std::size_t>(chunk_size, end - first);
  if (first + room == end) return static_cast<int>(room);
  std::size_t last = first + room;
  while (last > first && soil.home[last - 1] == soil.home[last]) --last;
  return static_cast<int>(last == first ? room : last - first);
}

/// Runs body(first point, count) over chunks of whole groups of a range.
template <class Space, class Body>
[[gnu::always_inline]] inline void over_whole_groups(const SoilPoints<Space>& soil, const TileRange& range,
                                                     Body&& body) {
  for (std::size_t first = range.first, end = first + range.count; first < end;) {
    const int count = whole_groups(soil, first, end);
    body(first, count);
    first += static_cast<std::size_t>(count);
  }
}

/// Runs take(point) and then body(begin, end) for every group of the points [first, first + count), counted from
/// `first`.
template <class Space, class Take, class Body>
void over_groups(const SoilPoints<Space>& soil, std::size_t first, int count, Take&& take, Body&& body) {
  const std::int32_t* home = soil.home.data() + first;
  for (int begin = 0, end = 0; begin < count; begin = end) {
    const std::int32_t own = home[begin];
    do take(end++);
    while (end < count && home[end] == own);
    body(begin, end);
  }
}

/// Mixes the porosity of the points [first, last) of one group as they are sheared: the bulk volume that goes with a
/// mass of grains approaches the group's mean by 1 − e^(−mixing Δε_d), Δε_d being the mean plastic shear strain of
/// this step. Differences between points of one cell are below what the grid resolves, and nothing else ends their
/// growth. Volume and mass of the group stay what they are; a group of several materials is left alone.
template <class Space>
void mix_porosity(const double* plastic_shear, std::size_t first, std::size_t last, SoilPoints<Space>& soil) {
  double mass = 0, volume = 0, sheared = 0;
  for (std::size_t p = first; p < last; ++p) {
    if (soil.material[p] != soil.material[first]) return;
    const double v = soil.mass[p] / (1 - soil.porosity[p]);
    mass += soil.mass[p];
    volume += v;
    sheared += v * plastic_shear[p - first];
  }
  if (sheared == 0) return;
  const double share = 1 - std::exp(-porosity_mixing * sheared / volume);
  const double mean = volume / mass;
  for (std::size_t p = first; p < last; ++p) {
    const double own = 1 / (1 - soil.porosity[p]);
    soil.porosity[p] = 1 - 1 / (own + share * (mean - own));
  }
}

template <class Space>
void mix_porosities(const double* plastic_shear, std::size_t first, int count, SoilPoints<Space>& soil) {
  if (largest_magnitude(plastic_shear, count) == 0) return;
  over_groups(
      soil, first, count, [](int) {},
      [&](int begin, int end) {
        mix_porosity(plastic_shear + begin, first + static_cast<std::size_t>(begin),
                     first + static_cast<std::size_t>(end), soil);
      });
}

}  // namespace polder
