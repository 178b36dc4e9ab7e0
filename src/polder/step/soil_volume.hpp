#pragma once
// Volumes of single soil points.
#include "polder/points/point_sets.hpp"
#include "polder/step/setup.hpp"

namespace polder {

/// Volume of soil point p, grains and pores, m³ (per metre in plane strain).
template <class Space>
double bulk_volume(const Setup<Space>& setup, const SoilPoints<Space>& soil, std::size_t p) {
  return soil.mass[p] / (setup.materials[soil.material[p]].grain_density * (1 - soil.porosity[p]));
}

}  // namespace polder
