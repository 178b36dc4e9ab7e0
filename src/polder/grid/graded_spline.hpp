#pragma once
// The splines of grid/spline.hpp where cells are not all alike: the same three nodes with weights that are other
// polynomials, from tables. Lengths are counted in the axis' smallest cell u: δ = (x − middle node)/u.
#include "polder/case/grid_axis.hpp"
#include "polder/grid/spline.hpp"
#include "polder/math/array.hpp"

namespace polder {

/// Weights value + δ (slope + δ curvature) of three nodes, in four lanes as rows along x need them.
struct alignas(32) SplinePiece {
  Vec4 value{}, slope{}, curvature{};
  Vec4 node{};            ///< from the middle one, in u
  double second[3] = {};  ///< Σ w (node − point)² = second[0] + δ (second[1] + δ second[2]), in u²

  SplineRow row(double delta) const { return detail::spline_row(delta, value, slope, curvature, node); }
  double inertia(double delta) const { return second[0] + delta * (second[1] + delta * second[2]); }
};

/// All pieces of one axis.
class GradedSpline {
 public:
  explicit GradedSpline(const GridAxis& axis);
  /// Of the centres, for a point in this cell.
  const SplinePiece& centres(int cell) const { return centres_[static_cast<std::size_t>(cell)]; }
  /// Of the faces, for a point in this cell below (0) or above (1) its knot; nodes are in lanes 0 … 2 and 1 … 3.
  const SplinePiece& faces(int cell, int upper) const {
    return faces_[static_cast<std::size_t>(2 * std::ptrdiff_t{cell} + upper)];
  }
  /// ∫ of the weight of the cell centre or of the low face of cell i, m: what it stands for. From i = −1 to n + 1.
  double centre_span(int i) const { return centre_span_[static_cast<std::size_t>(std::ptrdiff_t{i} + 1)]; }
  double face_span(int i) const { return face_span_[static_cast<std::size_t>(std::ptrdiff_t{i} + 1)]; }

 private:
  AlignedVector<SplinePiece> centres_, faces_;
  std::vector<double> centre_span_, face_span_;
};

}  // namespace polder
