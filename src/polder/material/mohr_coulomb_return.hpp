#pragma once
// Exact return to the Mohr–Coulomb surface with a Rankine tension cut-off, in ordered principal stresses s₁ ≥ s₂ ≥ s₃
// (tension positive), perfectly plastic over the step, flow by the potential with dilation ψ:
//   F = k s₁ − s₃ − 2c√k ≤ 0, k = (1 + sin φ)/(1 − sin φ);   g = m s₁ − s₃, m = (1 + sin ψ)/(1 − sin ψ);   s₁ ≤ T.
// In the sextant of the trial stress the returned stress lies on
//   the plane F₁₃, the edge s₁ = s₂ (F₁₃, F₂₃) or the edge s₂ = s₃ (F₁₃, F₁₂), if s₁ ≤ T there;
//   else on the cut-off (s₁ = T; s₁ = s₂ = T; all T) if F ≤ 0 there;
//   else where both are active: s₁ = T, s₃ = L = kT − 2c√k, and s₂, which the plastic strain does not touch (no flow of
//   F₁₃ or of s₁ ≤ T in direction 2), from elasticity, held between L and T (the two corners).
// T never exceeds the apex c cot φ, where L = T: the apex needs no case of its own, and without dilation (when no flow
// leads there) it is still where tension ends. The plane's pairs of multipliers have a positive determinant
// (4G(λ + G) for F₁₃ with s₁ = T, Koiter's rule), so the region is unique and the map continuous.
// After: J. Clausen, L. Damkilde, L. Andersen (2006), Int. J. Numer. Meth. Engng 66, for the regions; derived anew.
#include "polder/material/elasticity.hpp"
#include "polder/material/principal.hpp"

namespace polder {

struct MohrCoulombStrength {
  double slope;    ///< k
  double offset;   ///< 2c√k, Pa
  double tension;  ///< T, Pa, at most the apex
};

/// No apex where there is no friction: tension is then unlimited unless a strength is given.
inline constexpr double no_tension_limit = 1e30;

/// cohesion Pa, friction angle rad, tension strength Pa (NaN: none given).
inline MohrCoulombStrength mohr_coulomb_strength(double cohesion, double friction_angle, double tension_strength) {
  const double sine = std::sin(friction_angle);
  const double slope = (1 + sine) / (1 - sine);
  const double apex = sine > 1e-12 ? cohesion / std::tan(friction_angle) : no_tension_limit;
  const double tension = std::isnan(tension_strength) ? apex : std::min(apex, tension_strength);
  return {slope, 2 * cohesion * std::sqrt(slope), tension};
}

/// True where the stress is outside the surface.
POLDER_INLINE bool yields(const MohrCoulombStrength& strength, const Principal& s) {
  const bool shear = strength.slope * s.major - s.minor > strength.offset;
  const bool tension = s.major > strength.tension;
  return shear | tension;
}

/// The returned stress of a trial stress that yields. `dilation` is m = (1 + sin ψ)/(1 − sin ψ).
POLDER_INLINE Principal mohr_coulomb_return(const Principal& trial, const MohrCoulombStrength& strength,
                                            double dilation, const Elasticity& elasticity) {
  const double k = strength.slope, offset = strength.offset, T = strength.tension;
  const double lambda = elasticity.lambda, G = elasticity.shear, nu = elasticity.poisson;
  const double volume = lambda * (dilation - 1), shear = G * dilation;

  // Plane: the plastic strain is (m, 0, −1) times a multiplier.
  const double step = (k * trial.major - trial.minor - offset) / ((k - 1) * volume + 2 * (k * shear + G));
  const double plane_major = trial.major - step * (volume + 2 * shear);
  const double plane_minor = k * plane_major - offset;
  const double plane_middle = trial.middle - step * volume;
  // Edge s₁ = s₂: (m, m, −2)/2.
  const double upper_mean = 0.5 * (trial.major + trial.middle);
  const double upper_step = (k * upper_mean - trial.minor - offset) / ((k - 1) * volume + k * shear + 2 * G);
  const double upper_major = upper_mean - upper_step * (volume + shear);
  const double upper_minor = k * upper_major - offset;
  // Edge s₂ = s₃: (2m, −1, −1)/2.
  const double lower_mean = 0.5 * (trial.middle + trial.minor);
  const double lower_step = (k * trial.major - lower_mean - offset) / ((k - 1) * volume + 2 * k * shear + G);
  const double lower_major = trial.major - lower_step * (volume + 2 * shear);
  const double lower_minor = k * lower_major - offset;

  const bool upper = plane_middle > plane_major, lower = plane_middle < plane_minor;
  const double major = upper ? upper_major : (lower ? lower_major : plane_major);
  const double minor = upper ? upper_minor : (lower ? lower_minor : plane_minor);
  const double middle = upper ? upper_major : (lower ? lower_minor : plane_middle);

  // Cut-off alone: one, two or three principal stresses held at T. Poisson's effect unloads the others.
  const double one = (trial.major - T) * (nu / (1 - nu)), two = (trial.major + trial.middle - 2 * T) * nu;
  const bool hold_two = trial.middle - one > T, hold_three = trial.minor - two > T;
  const double cut_middle = hold_two ? T : trial.middle - one;
  const double cut_minor = hold_two ? (hold_three ? T : trial.minor - two) : trial.minor - one;

  const double L = k * T - offset;
  const double free_middle = trial.middle - nu * ((trial.major - T) + (trial.minor - L));
  const double held_middle = free_middle > T ? T : (free_middle < L ? L : free_middle);

  const double shear_yield = k * trial.major - trial.minor - offset;
  const bool in_shear = (shear_yield > 0) & (major <= T);
  const bool cut_only = cut_minor >= L;
  return {in_shear ? major : T, in_shear ? middle : (cut_only ? cut_middle : held_middle),
          in_shear ? minor : (cut_only ? cut_minor : L)};
}

}  // namespace polder
