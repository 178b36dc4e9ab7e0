#pragma once
// From a model to the state at its first step: grid, walls, materials, points, initial stress.
#include "polder/case/model.hpp"
#include "polder/points/point_sets.hpp"
#include "polder/step/setup.hpp"

namespace polder {

/// Throws std::invalid_argument for what a checked case cannot contain (an unknown law).
template <class Space>
Setup<Space> make_setup(const Model& model);

/// K0 = 1 − sin φ' (Jaky) where the law has an angle of friction, else ν/(1 − ν).
double earth_pressure_at_rest(const MaterialInput& material);

/// Vertical effective stress from the weight of the grains above (submerged below the water table), horizontal stress
/// by K0: exact for level and layered ground.
template <class Space>
void set_k0_stress(const Model& model, const Setup<Space>& setup, SoilPoints<Space>& soil);

}  // namespace polder
