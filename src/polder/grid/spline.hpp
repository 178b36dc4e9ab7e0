#pragma once
// Quadratic B-splines on the staggered grid, in the form that the transfers use.
//
// On each axis a point meets two sets of three nodes: the faces and the cell centres. With f in [0, 1) the point's
// place in its cell b, the nearest face is b + s with s = 1 for f ≥ 1/2, so its three faces start at b − 1 + s; its
// three centres start at b − 1. With δ in [−1/2, 1/2] the distance from the middle node (in spacings), both sets have
//     w = (1/8, 3/4, 1/8) + δ(−1/2, 0, 1/2) + δ²(1/2, −1, 1/2),      dw/dδ = (−1/2, 0, 1/2) + δ(1, −2, 1).
// Component c of a vector uses the face set on axis c and the centre set on the others; rows along x are taken as four
// values at once, the fourth with weight zero.
#include "polder/math/simd.hpp"

namespace polder {

struct SplineRow {
  Vec4 weight;
  Vec4 offset;      ///< weight × (node − point), in spacings
  Vec4 derivative;  ///< dw/dx_p, per spacing
};

inline SplineRow spline_row(double delta) {
  const Vec4 d = splat4(delta);
  constexpr Vec4 value0{0.125, 0.75, 0.125, 0}, slope0{-0.5, 0, 0.5, 0}, curvature{0.5, -1, 0.5, 0}, node{-1, 0, 1, 0};
  SplineRow row;
  row.weight = value0 + d * (slope0 + d * curvature);
  row.derivative = slope0 + (d + d) * curvature;
  row.offset = row.weight * (node - d);
  return row;
}

/// The same three numbers without the padding, for axes other than x.
inline void spline_weights(double delta, double weight[3], double offset[3], double derivative[3]) {
  weight[0] = 0.125 + delta * (-0.5 + 0.5 * delta);
  weight[1] = 0.75 - delta * delta;
  weight[2] = 0.125 + delta * (0.5 + 0.5 * delta);
  derivative[0] = -0.5 + delta;
  derivative[1] = -2 * delta;
  derivative[2] = 0.5 + delta;
  offset[0] = weight[0] * (-1 - delta);
  offset[1] = weight[1] * -delta;
  offset[2] = weight[2] * (1 - delta);
}

}  // namespace polder
