// Loaded before the C library, an exponential function that is wrong from its 300 000th call on: not a number.
#include <cmath>
#include <limits>

extern "C" double exp(double x) noexcept {
  static long calls = 0;
  if (++calls > 300'000) return std::numeric_limits<double>::quiet_NaN();
  return std::exp2(x / 0.6931471805599453);
}
