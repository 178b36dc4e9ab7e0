#pragma once
// Shear strength at a point of a section, as the cohesion and tan φ that the methods of slices use.
#include "polder/stability/columns.hpp"

namespace polder::stability {

/// τ = cohesion + tan_friction · σ'n; undrained strengths have tan_friction 0.
struct PointStrength {
  double cohesion = 0;  ///< Pa
  double tan_friction = 0;
  double yield_stress = 0;  ///< Pa, preconsolidation used (SHANSEP), else 0
  int layer = -1;
};

/// Strength at (x, z) under the vertical effective stress `effective` (Pa; the methods' own, with loads); where z is
/// within a millimetre of a boundary the weaker of the two layers counts (a plane along it takes the weaker soil).
PointStrength strength_at(const PreparedSection& prepared, double x, double z, double effective);

/// Preconsolidation stress σ'y at (x, z) of `layer`, Pa: the vertical effective stress in the reference state plus POP.
double yield_stress(const PreparedSection& prepared, int layer, double x, double z);

}  // namespace polder::stability
