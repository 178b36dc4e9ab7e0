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

  /// ∫ from 0 to `to` ≥ 0.
  double integral(double to) const {
    double sum = 0, from = 0;
    for (std::size_t i = 0; i <= x.size() && from < to; ++i) {  // up to each point, and beyond the last
      const double end = i < x.size() ? std::min(x[i], to) : to;
      if (end <= from) continue;
      sum += 0.5 * (end - from) * ((*this)(from) + (*this)(end));
      from = end;
    }
    return sum;
  }
};

}  // namespace polder
