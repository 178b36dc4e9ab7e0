#pragma once
// The Mohr–Coulomb return over a batch of points, for every law that has this surface.
// Points go in blocks; a block in which none can yield (all inside the cone that the hexagon encloses, and below the
// cut-off) is done after the elastic step, the others run the branch-free return as vector code.
#include <limits>

#include "polder/material/dilatancy.hpp"
#include "polder/material/mohr_coulomb_return.hpp"

namespace polder {

inline constexpr Parameter tension_strength_parameter{
    "tension_strength",
    "σ_t",
    "pressure",
    false,
    std::numeric_limits<double>::quiet_NaN(),
    0,
    1e9,
    "Largest tension that the skeleton bears. Left out: the apex c'/tan φ'"};

inline constexpr int block_size = 8;

/// Values beyond the last point are made harmless, so that blocks are always whole.
template <int N>
void pad_to_block(StressBatch<N>& batch) {
  static_assert(StressBatch<N>::capacity % block_size == 0);
  for (int i = batch.count; i % block_size != 0; ++i) {
    for (int k = 0; k < N; ++k) batch.stress[k][i] = batch.strain[k][i] = 0;
    batch.porosity[i] = 0;
    for (auto& row : batch.state) row[i] = 0;
  }
}

/// Whether a stress may be outside the surface, from invariants alone: with the mean m and R = 2√(J₂/3), over all Lode
/// angles k s₁ − s₃ ≤ (k − 1)m + R√(k² + k + 1) and s₁ ≤ m + R.
template <int N>
POLDER_INLINE bool may_yield(const StressBatch<N>& batch, int i, const MohrCoulombStrength& strength) {
  const double xx = batch.stress[0][i], yy = batch.stress[1][i], zz = batch.stress[2][i];
  double off = batch.stress[3][i] * batch.stress[3][i];
  if constexpr (N == 6) off += batch.stress[4][i] * batch.stress[4][i] + batch.stress[5][i] * batch.stress[5][i];
  const double mean = (xx + yy + zz) * (1.0 / 3.0);
  const double a = xx - mean, b = yy - mean, c = zz - mean;
  const double R = std::sqrt((a * a + b * b + c * c) * (2.0 / 3.0) + off * (4.0 / 3.0));
  const double k = strength.slope;
  const bool shear = (k - 1) * mean + R * std::sqrt(k * k + k + 1) > strength.offset;
  const bool tension = mean + R > strength.tension;
  return shear | tension;
}

/// Returns one point of plane strain; a point that does not yield keeps its trial stress to the last bit.
POLDER_INLINE void return_point(StressBatch<4>& batch, int i, const MohrCoulombStrength& strength, double dilation,
                                const Elasticity& elasticity) {
  const double xx = batch.stress[0][i], yy = batch.stress[1][i], zz = batch.stress[2][i], xy = batch.stress[3][i];
  const PlanePair pair = principal_pair(xx, yy, xy);
  const PrincipalOrder order = sort_principal(pair.high, pair.low, zz);
  const Principal& trial = order.sorted;
  const Principal s = mohr_coulomb_return(trial, strength, dilation, elasticity);
  const PlacedPrincipal placed = place_principal(order, s);
  const double mean = 0.5 * (placed.high + placed.low), radius = 0.5 * (placed.high - placed.low);
  const double half = radius * pair.cosine;
  const bool yielding = yields(strength, trial);
  batch.stress[0][i] = yielding ? mean + half : xx;
  batch.stress[1][i] = yielding ? mean - half : yy;
  batch.stress[2][i] = yielding ? placed.axis : zz;
  batch.stress[3][i] = yielding ? radius * pair.sine : xy;
  const double plastic = ((trial.major - trial.minor) - (s.major - s.minor)) / (2 * elasticity.shear);
  batch.state[0][i] += yielding ? plastic : 0.0;
}

/// The same in three dimensions.
POLDER_INLINE void return_point(StressBatch<6>& batch, int i, const MohrCoulombStrength& strength, double dilation,
                                const Elasticity& elasticity) {
  const Tensor trial_stress = tensor_at(batch, i);
  const Vector3 v = separated_axis(trial_stress), u = perpendicular(v), w = cross(v, u);
  const Vector3 on_u = product(trial_stress, u), on_w = product(trial_stress, w);
  const double axial = dot(v, product(trial_stress, v));
  const PlanePair pair = principal_pair(dot(u, on_u), dot(w, on_w), dot(u, on_w));
  const PrincipalOrder order = sort_principal(pair.high, pair.low, axial);
  const Principal& trial = order.sorted;
  const Principal s = mohr_coulomb_return(trial, strength, dilation, elasticity);
  const PlacedPrincipal placed = place_principal(order, s);
  const double mean = 0.5 * (placed.high + placed.low), radius = 0.5 * (placed.high - placed.low);
  const double half = radius * pair.cosine;
  const Tensor stress = assemble(u, w, v, mean + half, mean - half, radius * pair.sine, placed.axis);
  const bool yielding = yields(strength, trial);
  batch.stress[0][i] = yielding ? stress.xx : trial_stress.xx;
  batch.stress[1][i] = yielding ? stress.yy : trial_stress.yy;
  batch.stress[2][i] = yielding ? stress.zz : trial_stress.zz;
  batch.stress[3][i] = yielding ? stress.xy : trial_stress.xy;
  batch.stress[4][i] = yielding ? stress.yz : trial_stress.yz;
  batch.stress[5][i] = yielding ? stress.zx : trial_stress.zx;
  const double plastic = ((trial.major - trial.minor) - (s.major - s.minor)) / (2 * elasticity.shear);
  batch.state[0][i] += yielding ? plastic : 0.0;
}

/// Elastic step and return for every point; `strength_of(i)` is the strength of point i.
template <int N, class StrengthOf>
void update_mohr_coulomb(StressBatch<N>& batch, const Elasticity& elasticity, const Dilatancy& dilatancy,
                         const StrengthOf& strength_of) {
  pad_to_block(batch);
  add_elastic_stress(elasticity, batch);
  for (int first = 0; first < batch.count; first += block_size) {
    int suspects = 0;
    for (int i = first; i < first + block_size; ++i) suspects += may_yield(batch, i, strength_of(i));
    if (suspects == 0) continue;
    for (int i = first; i < first + block_size; ++i)
      return_point(batch, i, strength_of(i), dilatancy.ratio(batch.porosity[i]), elasticity);
  }
}

}  // namespace polder
