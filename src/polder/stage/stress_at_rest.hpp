#pragma once
// Effective stress of the ground at rest, at the start and in soil that is placed.
#include "polder/case/model.hpp"
#include "polder/points/point_sets.hpp"
#include "polder/step/setup.hpp"

namespace polder {

/// As the case asks for: nothing, K0 by columns (set_k0_stress()), or set_sloping_k0_stress(). Soil that is `placed`
/// gets columns of its own weight where the case has K0 of either kind.
template <class Space>
void set_stress_at_rest(const Model& model, const Setup<Space>& setup, SoilPoints<Space>& soil, bool placed = false);

/// Effective stress of the soil points, Pa, tension positive: elastic equilibrium under the weight and the pore
/// pressures of the start, by finite elements, with Young's modulus of the material at rest and Poisson's ratio K0/(1 +
/// K0). On level ground that is σ'h = K0 σ'v; elsewhere it is in balance, which columns of K0 are not. Strength is not
/// asked for: an initial stage brings stresses back that are beyond it. Throws std::invalid_argument where the elements
/// cannot be made of the case's ground.
void set_sloping_k0_stress(const Model& model, const Setup<PlaneStrain>& setup, SoilPoints<PlaneStrain>& soil);

}  // namespace polder
