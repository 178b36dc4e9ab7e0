#pragma once
// A root between two points where a function changes sign.
#include <algorithm>
#include <cmath>

namespace polder::stability {

struct Root {
  double x = 0;
  int evaluations = 0;
  bool found = false;
};

/// Regula falsi with Illinois' correction: superlinear, and it keeps the bracket. `f_low` and `f_high` are the values
/// at the ends and have opposite signs. Ends when |f| ≤ f_tolerance or the bracket is narrower than x_tolerance.
template <class Function>
Root bracketed_root(Function&& f, double low, double f_low, double high, double f_high, double x_tolerance,
                    double f_tolerance) {
  Root root;
  int side = 0;
  for (root.evaluations = 1; root.evaluations <= 100; ++root.evaluations) {
    root.x = (low * f_high - high * f_low) / (f_high - f_low);
    if (!(root.x > std::min(low, high) && root.x < std::max(low, high))) root.x = (low + high) / 2;
    const double at = f(root.x);
    if (!std::isfinite(at)) return root;
    if (std::abs(at) <= f_tolerance || std::abs(high - low) <= x_tolerance) {
      root.found = true;
      return root;
    }
    if ((at > 0) == (f_high > 0)) {
      high = root.x, f_high = at;
      if (side == 1) f_low /= 2;
      side = 1;
    } else {
      low = root.x, f_low = at;
      if (side == -1) f_high /= 2;
      side = -1;
    }
  }
  return root;
}

}  // namespace polder::stability
