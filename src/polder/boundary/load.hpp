#pragma once
// A pressure on the ground. It acts on the soil points that are the highest of their columns when it comes, at the
// height of the surface above them, and goes with them wherever they go; a travelling one presses on those of them that
// are under it.
#include <cmath>
#include <map>
#include <utility>

#include "polder/case/grid_sites.hpp"
#include "polder/case/ground_load.hpp"
#include "polder/points/point_sets.hpp"

namespace polder {

/// The stage with which a load comes; −1: at the start, which is also when the first stage begins.
inline int comes_with(const GroundLoad& load) { return load.from_stage > 0 ? load.from_stage : -1; }

/// As stage number `stage` begins (−1: at the start) sets `load` of the points that a load reaches which comes then, to
/// 1 + its place in model.loads, and clears it where a load goes. Points are columns of the seeding lattice.
template <class Space>
void mark_loaded_points(const Model& model, const Lattice<Space>& lattice, int stage, SoilPoints<Space>& soil) {
  bool comes = false;
  for (std::size_t k = 0; k < model.loads.size(); ++k) {
    comes = comes || comes_with(model.loads[k]) == stage;
    if (stage >= 0 && model.loads[k].until_stage == stage)
      for (auto& load : soil.load)
        if (load == k + 1) load = 0;
  }
  if (!comes) return;
  std::map<std::pair<long, long>, std::size_t> highest;
  const SiteAxis along(lattice.axis[0], model.points_per_axis), across(lattice.axis[1], model.points_per_axis);
  for (std::size_t p = 0; p < soil.size(); ++p) {
    const std::pair column{along.site_at(soil.position[0][p]),
                           Space::axes == 3 ? across.site_at(soil.position[1][p]) : 0L};
    const auto [at, is_new] = highest.try_emplace(column, p);
    if (!is_new && soil.position[Space::up][p] > soil.position[Space::up][at->second]) at->second = p;
  }
  for (std::size_t k = 0; k < model.loads.size(); ++k) {
    if (comes_with(model.loads[k]) != stage) continue;
    const auto [from, to] = reach_of(model.loads[k], model);
    for (const auto& [column, p] : highest) {
      const double x = along.middle(column.first);
      // a travelling one covers points little by little
      const double edge = model.loads[k].speed != 0 ? 0.5 * along.width(column.first) : 0;
      if (x > from - edge && x < to + edge) soil.load[p] = static_cast<std::uint8_t>(k + 1);
    }
  }
}

}  // namespace polder
