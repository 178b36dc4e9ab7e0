// Compressible neo-Hookean elasticity, τ = G (B − I) + λ ln J I with Kirchhoff's stress τ = J σ: exact at any strain,
// where the rate form of `linear-elastic` drifts. For verification, and for what is stretched and turned far.
//
// No state is needed: B follows from the stress and J = (1 − n₀)/(1 − n). The caller has turned the stress; the stretch
// of the step is B ← S B S, S = I + Δε + ½ Δε².
#include <cmath>

#include "polder/material/elasticity.hpp"

namespace polder {
namespace {

constexpr std::array parameters{young_modulus_parameter, poisson_ratio_parameter};

/// xx yy zz xy yz zx.
struct Symmetric {
  double v[6];
  double at(int i, int j) const {
    if (i == j) return v[i];
    return i + j == 1 ? v[3] : i + j == 3 ? v[4] : v[5];
  }
};

/// S B S.
Symmetric stretched(const Symmetric& s, const Symmetric& b) {
  double half[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      half[i][j] = s.at(i, 0) * b.at(0, j) + s.at(i, 1) * b.at(1, j) + s.at(i, 2) * b.at(2, j);
  const auto entry = [&](int i, int j) {
    return half[i][0] * s.at(0, j) + half[i][1] * s.at(1, j) + half[i][2] * s.at(2, j);
  };
  return {{entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(2, 0)}};
}

/// exp of a small strain, to second order.
Symmetric stretch(const Symmetric& strain) {
  Symmetric s = stretched(strain, {{1, 1, 1, 0, 0, 0}});
  for (int k = 0; k < 6; ++k) s.v[k] = (k < 3 ? 1 : 0) + strain.v[k] + 0.5 * s.v[k];
  return s;
}

class NeoHookean final : public SoilLaw {
 public:
  NeoHookean(const Elasticity& elasticity, double initial_porosity)
      : elasticity_(elasticity), solid_at_start_(1 - initial_porosity) {}
  void update(StressBatch<4>& batch) const override { update_batch(batch); }
  void update(StressBatch<6>& batch) const override { update_batch(batch); }
  bool follows_large_strains() const override { return true; }
  /// Of small strains; where a stretch grows beyond 1, stiffness grows with its square.
  double constrained_modulus(double) const override { return elasticity_.constrained(); }

 private:
  template <int N>
  void update_batch(StressBatch<N>& batch) const {
    const double shear = elasticity_.shear, lambda = elasticity_.lambda;
    for (int i = 0; i < batch.count; ++i) {
      const double volumetric = batch.strain[0][i] + batch.strain[1][i] + batch.strain[2][i];
      const double logarithm = std::log(solid_at_start_ / (1 - batch.porosity[i])), before = logarithm - volumetric;
      const double old_volume = std::exp(before), volume = std::exp(logarithm);
      Symmetric b{}, strain{};
      for (int k = 0; k < N; ++k) {
        b.v[k] = old_volume * batch.stress[k][i] / shear;
        strain.v[k] = batch.strain[k][i];
      }
      for (int k = 0; k < 3; ++k) b.v[k] += 1 - lambda * before / shear;
      b = stretched(stretch(strain), b);
      for (int k = 0; k < N; ++k)
        batch.stress[k][i] = (shear * (b.v[k] - (k < 3 ? 1 : 0)) + (k < 3 ? lambda * logarithm : 0)) / volume;
    }
  }

  Elasticity elasticity_;
  double solid_at_start_;
};

std::unique_ptr<SoilLaw> make(std::span<const double> values, const LawContext& context) {
  return std::make_unique<NeoHookean>(Elasticity::from_young(values[0], values[1]), context.initial_porosity);
}

}  // namespace

LawDescription neo_hookean_law() {
  return {"neo-hookean", "Elasticity for strains and rotations of any size, without strength", parameters, make};
}

}  // namespace polder
