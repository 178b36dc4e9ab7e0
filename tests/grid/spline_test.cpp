#include "polder/grid/spline.hpp"

#include <gtest/gtest.h>

#include <random>
#include <utility>

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

}  // namespace
}  // namespace polder
