#pragma once
// A pressure on the ground. It acts on the soil points that are the highest of their columns at the start, at the
// height of the surface above them, and goes with them wherever they go.
#include <cmath>
#include <map>
#include <utility>

#include "polder/case/model.hpp"
#include "polder/points/point_sets.hpp"

namespace polder {

/// Sets `load` of the points that carry one: 1 + its place in model.loads. Points are columns of the seeding lattice.
template <class Space>
void mark_loaded_points(const Model& model, const Lattice<Space>& lattice, SoilPoints<Space>& soil) {
  std::map<std::pair<long, long>, std::size_t> highest;
  std::array<double, 3> d{1, 1, 1};
  for (int a = 0; a < Space::axes; ++a) d[a] = lattice.spacing[a] / model.points_per_axis;
  for (std::size_t p = 0; p < soil.size(); ++p) {
    const std::pair column{static_cast<long>(soil.position[0][p] / d[0]),
                           Space::axes == 3 ? static_cast<long>(soil.position[1][p] / d[1]) : 0L};
    const auto [at, is_new] = highest.try_emplace(column, p);
    if (!is_new && soil.position[Space::up][p] > soil.position[Space::up][at->second]) at->second = p;
  }
  for (const auto& [column, p] : highest) {
    const double x = (static_cast<double>(column.first) + 0.5) * d[0];
    for (std::size_t k = 0; k < model.loads.size(); ++k)
      if (x > model.loads[k].span[0] && x < model.loads[k].span[1]) soil.load[p] = static_cast<std::uint8_t>(k + 1);
  }
}

}  // namespace polder
