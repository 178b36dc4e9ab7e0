#pragma once
// Quadratic B-splines on the staggered grid, in the form that the transfers use.
//
// On each axis a point meets two sets of three nodes: the faces and the cell centres. With f in [0, 1) the point's
// place in its cell b, the nearest face is b + s with s = 1 for f ≥ 1/2, so its three faces start at b − 1 + s; its
// three centres start at b − 1. With δ in [−1/2, 1/2] the distance from the middle node (in spacings), both sets have
//     w = (1/8, 3/4, 1/8) + δ(−1/2, 0, 1/2) + δ²(1/2, −1, 1/2),      dw/dδ = (−1/2, 0, 1/2) + δ(1, −2, 1).
// Component c of a vector uses the face set on axis c and the centre set on the others. Rows along x are taken as four
// values at once, from b − 1 on: the centres leave the fourth with weight zero, the faces the fourth or, for s = 1, the
// first. So all points of a cell read and write the same four values, and a processor that has just stored them can
// hand them on.
#include "polder/math/simd.hpp"

namespace polder {

struct SplineRow {
  Vec4 weight;
  Vec4 node;        ///< from the middle one, in spacings; 0 where there is none
  Vec4 offset;      ///< weight × (node − point), in spacings
  Vec4 derivative;  ///< dw/dx_p, per spacing
};

namespace detail {

inline SplineRow spline_row(double delta, Vec4 value, Vec4 slope, Vec4 curvature, Vec4 node) {
  const Vec4 d = splat4(delta);
  SplineRow row;
  row.weight = value + d * (slope + d * curvature);
  row.derivative = slope + (d + d) * curvature;
  row.node = node;
  row.offset = row.weight * (node - d);
  return row;
}

}  // namespace detail

/// The row of the three centres.
inline SplineRow centre_row(double delta) {
  return detail::spline_row(delta, Vec4{0.125, 0.75, 0.125, 0}, Vec4{-0.5, 0, 0.5, 0}, Vec4{0.5, -1, 0.5, 0},
                            Vec4{-1, 0, 1, 0});
}

/// The row of the three faces; `upper` is s.
inline SplineRow face_row(double delta, int upper) {
  struct Piece {
    Vec4 value, slope, curvature, node;
  };
  static constexpr Piece pieces[2] = {
      {{0.125, 0.75, 0.125, 0}, {-0.5, 0, 0.5, 0}, {0.5, -1, 0.5, 0}, {-1, 0, 1, 0}},
      {{0, 0.125, 0.75, 0.125}, {0, -0.5, 0, 0.5}, {0, 0.5, -1, 0.5}, {0, -1, 0, 1}},
  };
  const Piece& piece = pieces[upper];
  return detail::spline_row(delta, piece.value, piece.slope, piece.curvature, piece.node);
}

/// The same three numbers without the padding, for axes other than x; of one point or, with vectors, of several.
template <class Number>
[[gnu::always_inline]] inline void spline_weights(Number delta, Number weight[3], Number offset[3],
                                                  Number derivative[3]) {
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
