#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "polder/points/point_sets.hpp"

namespace polder {

/// Of all soil points, from where displacement counts, m.
template <class Space>
double largest_displacement(const SoilPoints<Space>& soil) {
  double most = 0;
  for (std::size_t p = 0; p < soil.size(); ++p) {
    double square = 0;
    for (int a = 0; a < Space::axes; ++a) {
      const double way = soil.position[a][p] - soil.reference[a][p];
      square += way * way;
    }
    most = std::max(most, square);
  }
  return std::sqrt(most);
}

}  // namespace polder
