#pragma once
// The first points: soil and water on a regular lattice of points_per_axis per cell, jittered on request.
#include "polder/case/model.hpp"
#include "polder/points/point_sets.hpp"

namespace polder {

template <class Space>
struct SeededPoints {
  SoilPoints<Space> soil;
  WaterPoints<Space> water;
};

/// A point of the seeding lattice belongs to the last soil body that contains it, else to a body of free water that
/// does. Soil below the water table gets its pore water as points of their own. Stresses are zero.
template <class Space>
SeededPoints<Space> seed_points(const Model& model, const Lattice<Space>& lattice);

/// How many of each there will be, without making them.
struct PointCount {
  std::size_t soil = 0, water = 0;
};
PointCount count_points(const Model& model);

}  // namespace polder
