#pragma once
// Stress of the soil at the start in the unsaturated formulation.
#include "polder/case/model.hpp"
#include "polder/points/point_sets.hpp"
#include "polder/step/setup.hpp"

namespace polder {

/// Vertical total stress from the weight of grains and water above, water as the retention curves hold it, and of what
/// stands over the ground where its pressure at the start is positive there; effective by Bishop, σ'v = σv + S p;
/// horizontal by K0: exact for level and layered ground.
template <class Space>
void set_unsaturated_k0_stress(const Model& model, const Setup<Space>& setup, SoilPoints<Space>& soil);

}  // namespace polder
