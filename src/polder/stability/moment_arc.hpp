#pragma once
// What Bishop and Uplift-Van share: slices on an arc, with level forces between them.
#include <span>

#include "polder/stability/slices.hpp"

namespace polder::stability {

/// Σ of the moments of weights and level forces about the centre, over the radius, N/m; positive drives.
double driving_force(std::span<const Slice> slices, double direction, const Point& centre, double radius);

/// Σ of the shear resistance along the bases at the factor F, N/m, not yet divided by F. Vertical equilibrium gives
///   τ_f l = [c b + (V − u b) tan φ] / (cos α + sin α tan φ / F);
/// α is not taken below −(45° − φ/2), where the denominator heads for zero (the steepest passive plane of Rankine), and
/// no slice resists less than nothing.
double shear_resistance(std::span<const Slice> slices, double factor);

}  // namespace polder::stability
