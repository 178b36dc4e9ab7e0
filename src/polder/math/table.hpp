#pragma once
// Piecewise-linear function of one variable, constant beyond its ends: hydrographs, ramps, tabulated laws.
#include <algorithm>
#include <cstddef>
#include <vector>

namespace polder {

struct Table {
  std::vector<double> x, y;  ///< same length ≥ 1, x strictly increasing

  static Table constant(double value) { return {{0.0}, {value}}; }
  bool is_constant() const { return y.size() <= 1; }

  double operator()(double at) const {
    if (y.empty()) return 0.0;
    if (at <= x.front() || y.size() == 1) return y.front();
    if (at >= x.back()) return y.back();
    const std::size_t i = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin());
    return y[i - 1] + (at - x[i - 1]) / (x[i] - x[i - 1]) * (y[i] - y[i - 1]);
  }
};

}  // namespace polder
