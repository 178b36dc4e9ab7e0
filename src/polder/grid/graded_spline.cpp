#include "polder/grid/graded_spline.hpp"

namespace polder {

namespace {

/// On the interval [b, c] between the knots a < b < c < d; the middle node is at `middle`, its neighbours at low and
/// high.
SplinePiece piece(double a, double b, double c, double d, double low, double middle, double high, double unit,
                  int lane) {
  const double before = (middle - b) / unit, after = (c - middle) / unit;
  const double of_low = 1 / ((c - a) * (c - b)) * unit * unit, of_high = 1 / ((d - b) * (c - b)) * unit * unit;
  SplinePiece made;
  const auto set = [&](Vec4 SplinePiece::*part, double first, double last, double sum) {
    (made.*part)[lane] = first;
    (made.*part)[lane + 1] = sum - first - last;
    (made.*part)[lane + 2] = last;
  };
  set(&SplinePiece::value, after * after * of_low, before * before * of_high, 1);
  set(&SplinePiece::slope, -2 * after * of_low, 2 * before * of_high, 0);
  set(&SplinePiece::curvature, of_low, of_high, 0);
  made.node[lane] = (low - middle) / unit;
  made.node[lane + 2] = (high - middle) / unit;
  const Vec4 square = made.node * made.node;
  made.second[0] = sum_lanes(made.value * square);
  made.second[1] = sum_lanes(made.slope * square);
  made.second[2] = sum_lanes(made.curvature * square) - 1;  // Σ w node = δ
  return made;
}

}  // namespace

GradedSpline::GradedSpline(const GridAxis& axis) {
  const double u = axis.least();
  for (int i = 0; i < axis.cells(); ++i) {
    centres_.push_back(piece(axis.edge(i - 1), axis.edge(i), axis.edge(i + 1), axis.edge(i + 2), axis.centre(i - 1),
                             axis.centre(i), axis.centre(i + 1), u, 0));
    for (int upper = 0; upper < 2; ++upper) {
      const int m = i + upper;  // the middle face
      faces_.push_back(piece(axis.knot(m - 2), axis.knot(m - 1), axis.knot(m), axis.knot(m + 1), axis.edge(m - 1),
                             axis.edge(m), axis.edge(m + 1), u, upper));
    }
  }
  for (int i = -1; i <= axis.cells() + 1; ++i) {
    centre_span_.push_back((axis.edge(i + 2) - axis.edge(i - 1)) / 3);
    face_span_.push_back((axis.knot(i + 1) - axis.knot(i - 2)) / 3);
  }
}

}  // namespace polder
