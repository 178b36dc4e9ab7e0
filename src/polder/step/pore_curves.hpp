#pragma once
// Water in pores as a function of its pressure p: S(p)(1 + p/K), per volume of pores and as at no pressure.
#include "polder/step/setup.hpp"

namespace polder {

struct WaterRatio {
  double value, slope;  ///< –, 1/Pa
};

/// Largest error of the slope: what is released is counted by the values, never by the slope.
inline WaterRatio water_ratio(const PoreSpace& pores, double p, double bulk_modulus) {
  const double s = saturation(pores.retention, -p), squeezed = 1 + p / bulk_modulus;
  return {s * squeezed, capacity(pores.retention, -p) * squeezed + s / bulk_modulus};
}

}  // namespace polder
