#pragma once
// Isotropic linear elasticity of the soil skeleton, as every law with constant moduli uses it.
#include "polder/material/law.hpp"
#include "polder/material/principal.hpp"

namespace polder {

/// Lamé's moduli, Pa, and Poisson's ratio.
struct Elasticity {
  double lambda, shear, poisson;

  static Elasticity from_young(double young_modulus, double poisson_ratio) {
    return {young_modulus * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio)),
            young_modulus / (2 * (1 + poisson_ratio)), poisson_ratio};
  }
  double bulk() const { return lambda + 2.0 / 3.0 * shear; }
  double constrained() const { return lambda + 2 * shear; }
};

/// σ += λ tr(Δε) I + 2G Δε for every point of the batch: the trial stress.
template <int N>
void add_elastic_stress(const Elasticity& elasticity, StressBatch<N>& batch) {
  const double lambda = elasticity.lambda, twice_shear = 2 * elasticity.shear;
  for (int i = 0; i < batch.count; ++i) {
    const double volume = lambda * (batch.strain[0][i] + batch.strain[1][i] + batch.strain[2][i]);
    for (int k = 0; k < 3; ++k) batch.stress[k][i] += volume + twice_shear * batch.strain[k][i];
    for (int k = 3; k < N; ++k) batch.stress[k][i] += twice_shear * batch.strain[k][i];
  }
}

/// The stress of one point.
POLDER_INLINE Tensor tensor_at(const StressBatch<4>& batch, int i) {
  return {batch.stress[0][i], batch.stress[1][i], batch.stress[2][i], batch.stress[3][i], 0, 0};
}
POLDER_INLINE Tensor tensor_at(const StressBatch<6>& batch, int i) {
  return {batch.stress[0][i], batch.stress[1][i], batch.stress[2][i],
          batch.stress[3][i], batch.stress[4][i], batch.stress[5][i]};
}

inline constexpr Parameter young_modulus_parameter{
    "young_modulus", "E", "pressure", true, 0, 1.0, 1e13, "Young's modulus of the soil skeleton (drained)"};
inline constexpr Parameter poisson_ratio_parameter{
    "poisson_ratio", "ν", "ratio", false, 0.3, 0.0, 0.4999, "Poisson's ratio of the soil skeleton"};

}  // namespace polder
