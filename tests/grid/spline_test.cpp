#include "polder/grid/spline.hpp"

#include <gtest/gtest.h>

#include <random>
#include <utility>

#include "polder/grid/graded_spline.hpp"

namespace polder {
namespace {

TEST(QuadraticSpline, SumsToOneAndReproducesLinearFields) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  for (int trial = 0; trial < 1000; ++trial) {
    const double delta = uniform(random);
    const SplineRow centres = centre_row(delta), low = face_row(delta, 0), high = face_row(delta, 1);
    double w[3], o[3], d[3];
    spline_weights(delta, w, o, d);
    double sum = 0, first = 0, slope = 0, slope_of_linear = 0, second = 0;
    for (int i = 0; i < 3; ++i) {
      for (const auto& [row, at] : {std::pair{centres, i}, {low, i}, {high, i + 1}}) {
        EXPECT_NEAR(row.weight[at], w[i], 1e-15);
        EXPECT_NEAR(row.offset[at], o[i], 1e-15);
        EXPECT_NEAR(row.derivative[at], d[i], 1e-15);
      }
      EXPECT_GE(w[i], 0);
      sum += w[i];
      first += o[i];
      slope += d[i];
      slope_of_linear += d[i] * (i - 1);
      second += o[i] * (i - 1 - delta);
    }
    for (const auto& [row, empty] : {std::pair{centres, 3}, {low, 3}, {high, 0}}) {
      EXPECT_EQ(row.weight[empty], 0);
      EXPECT_EQ(row.offset[empty], 0);
      EXPECT_EQ(row.derivative[empty], 0);
    }
    EXPECT_NEAR(sum, 1, 1e-15);
    EXPECT_NEAR(first, 0, 1e-15);            // Σ w (node − point) = 0
    EXPECT_NEAR(slope, 0, 1e-15);            // of a constant
    EXPECT_NEAR(slope_of_linear, 1, 1e-15);  // of a linear field
    EXPECT_NEAR(second, 0.25, 1e-14);        // D = h²/4 of APIC
  }
}

/// Across the whole axis, of either set of nodes: sums, linear fields, no jump of value or slope between pieces.
TEST(GradedSpline, SumsToOneReproducesLinearFieldsAndIsSmooth) {
  const GridAxis axis(3, 0.4, {{0, 0.05, 0.01, 1.4}, {1.4, 1.5, 0.02, 1.2}});
  const GradedSpline spline(axis);
  const double u = axis.least();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, axis.length());
  const auto check = [&](const SplinePiece& piece, double middle, double low, double high, int lane, double x) {
    const double delta = (x - middle) / u, at[3] = {low, middle, high};
    const SplineRow row = piece.row(delta);
    double sum = 0, linear = 0, slope = 0, slope_of_linear = 0, moment = 0, second = 0;
    for (int i = 0; i < 3; ++i) {
      const double w = row.weight[lane + i];
      EXPECT_GE(w, -1e-15);
      sum += w;
      linear += w * at[i];
      slope += row.derivative[lane + i];
      slope_of_linear += row.derivative[lane + i] / u * at[i];
      moment += row.offset[lane + i];
      second += row.offset[lane + i] * (at[i] - x) / u;
    }
    EXPECT_EQ(row.weight[lane == 0 ? 3 : 0], 0);
    EXPECT_NEAR(sum, 1, 1e-13);
    EXPECT_NEAR(linear, x, 1e-13);
    EXPECT_NEAR(slope, 0, 1e-12);
    EXPECT_NEAR(slope_of_linear, 1, 1e-11);
    EXPECT_NEAR(moment, 0, 1e-11);
    EXPECT_NEAR(piece.inertia(delta), second, 1e-9 * (1 + second));
    EXPECT_GT(second, 0);
  };
  for (int trial = 0; trial < 3000; ++trial) {
    const double x = uniform(random);
    const int b = axis.cell_at(x), upper = x >= axis.knot(b), m = b + upper;
    check(spline.centres(b), axis.centre(b), axis.centre(b - 1), axis.centre(b + 1), 0, x);
    check(spline.faces(b, upper), axis.edge(m), axis.edge(m - 1), axis.edge(m + 1), upper, x);
  }
  for (int b = 0; b < axis.cells(); ++b) {  // from below and from above a knot
    const double knot = axis.knot(b);
    const SplineRow low = spline.faces(b, 0).row((knot - axis.edge(b)) / u);
    const SplineRow high = spline.faces(b, 1).row((knot - axis.edge(b + 1)) / u);
    for (int i = 0; i < 4; ++i) {
      EXPECT_NEAR(low.weight[i], high.weight[i], 1e-13) << b;
      EXPECT_NEAR(low.derivative[i], high.derivative[i], 1e-12) << b;
    }
    if (b + 1 == axis.cells()) break;
    const double edge = axis.edge(b + 1);
    const SplineRow before = spline.centres(b).row((edge - axis.centre(b)) / u);
    const SplineRow after = spline.centres(b + 1).row((edge - axis.centre(b + 1)) / u);
    EXPECT_NEAR(before.weight[0], 0, 1e-13);
    for (int i = 1; i < 3; ++i) {
      EXPECT_NEAR(before.weight[i], after.weight[i - 1], 1e-13) << b;
      EXPECT_NEAR(before.derivative[i], after.derivative[i - 1], 1e-12) << b;
    }
  }
}

}  // namespace
}  // namespace polder
