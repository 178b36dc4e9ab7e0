#pragma once
// What Bishop and Uplift-Van share: slices on an arc, with level forces between them.
#include <span>

#include "polder/stability/slices.hpp"

namespace polder::stability {

/// Σ of the moments of weights and level forces about the centre, over the radius, N/m; positive drives.
double driving_force(std::span<const Slice> slices, double direction, const Point& centre, double radius);

/// Σ of the shear resistance along the bases at the factor F, N/m, not yet divided by F: τ_f l = c l + N' tan φ with
/// the effective normal force from vertical equilibrium,
///   N' = (V − u b − c l sin α / F) / m_α,   m_α = cos α + sin α tan φ / F.
/// Soil cannot pull: N' ≥ 0. m_α, which heads for zero on steep rising bases, is not taken below its value on Rankine's
/// passive plane, α = −(45° − φ_m/2) with the mobilised friction tan φ_m = tan φ / F.
double shear_resistance(std::span<const Slice> slices, double factor);

}  // namespace polder::stability
