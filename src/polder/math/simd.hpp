#pragma once
// Four doubles at once, by the vector extension that g++ and clang share: a row of faces fits one.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <utility>

/// Before a loop: its iterations do not depend on each other.
#ifdef __clang__
#define POLDER_INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#else
#define POLDER_INDEPENDENT _Pragma("GCC ivdep")
#endif

/// Of a lambda in a hot loop: part of the loop, however large that becomes.
#define POLDER_INLINED __attribute__((always_inline))

namespace polder {

using Vec4 = double __attribute__((vector_size(32)));

inline Vec4 load4(const double* from) {
  Vec4 v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
inline void store4(double* to, Vec4 v) { std::memcpy(to, &v, sizeof v); }
inline Vec4 splat4(double a) { return Vec4{a, a, a, a}; }

/// body.operator()<i>() for i = 0 … n − 1, each written out by the compiler.
template <int n, class Body>
[[gnu::always_inline]] inline void unrolled(Body&& body) {
  [&]<int... i>(std::integer_sequence<int, i...>) POLDER_INLINED { (body.template operator()<i>(), ...); }
  (std::make_integer_sequence<int, n>());
}

/// As std::min and std::max, pair by pair.
inline Vec4 min4(Vec4 a, Vec4 b) { return b < a ? b : a; }
inline Vec4 max4(Vec4 a, Vec4 b) { return a < b ? b : a; }

/// Rows become columns: afterwards `a` has the first values of all four, and so on.
inline void transpose4(Vec4& a, Vec4& b, Vec4& c, Vec4& d) {
  const Vec4 ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6), ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Vec4 cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6), cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  a = __builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5);
  c = __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7);
  d = __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7);
}

/// ∛x for 1e-37 < x < 1e37, to rounding. A third of the bits of x in single precision, read as a number, is within 6 %;
/// three steps of Halley's iteration take the third power of the error (times 2/3) each.
inline Vec4 cube_root(Vec4 x) {
  using Float4 = float __attribute__((vector_size(16)));
  using Int4 = int __attribute__((vector_size(16)));
  constexpr float third = 1.0F / 3, offset = 709921077.0F;
  const Float4 single = __builtin_convertvector(x, Float4);
  Int4 bits;
  std::memcpy(&bits, &single, sizeof bits);
  bits = __builtin_convertvector(__builtin_convertvector(bits, Float4) * third + offset, Int4);
  Float4 guess;
  std::memcpy(&guess, &bits, sizeof guess);
  Vec4 y = __builtin_convertvector(guess, Vec4);
  for (int i = 0; i < 3; ++i) {
    const Vec4 cube = y * y * y;
    y *= (cube + 2 * x) / (2 * cube + x);
  }
  return y;
}

/// Eight floats at once, for the preconditioner.
using Vec8f = float __attribute__((vector_size(32)));

inline Vec8f load8(const float* from) {
  Vec8f v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
inline void store8(float* to, Vec8f v) { std::memcpy(to, &v, sizeof v); }

inline double sum_lanes(Vec4 a) { return (a[0] + a[2]) + (a[1] + a[3]); }

/// The largest of n magnitudes, at least 0; what is not a number does not count.
inline double largest_magnitude(const double* a, std::ptrdiff_t n) {
  Vec4 most{}, least{};
  std::ptrdiff_t i = 0;
  for (; i + 4 <= n; i += 4) {
    most = max4(most, load4(a + i));
    least = min4(least, load4(a + i));
  }
  most = max4(most, -least);
  double whole = std::max(std::max(most[0], most[1]), std::max(most[2], most[3]));
  for (; i < n; ++i) whole = std::max(whole, std::abs(a[i]));
  return whole;
}

/// Whether all n values are in [low, high]; what is not a number is not. Without a branch, so that it costs what
/// reading costs.
inline bool all_within(const double* a, std::ptrdiff_t n, double low, double high) {
  const auto good = [&](Vec4 v) { return (v >= splat4(low)) & (v <= splat4(high)); };
  auto all = good(splat4(low));
  std::ptrdiff_t i = 0;
  for (; i + 4 <= n; i += 4) all &= good(load4(a + i));
  bool within = (all[0] & all[1] & all[2] & all[3]) != 0;
  for (; i < n; ++i) within = within && a[i] >= low && a[i] <= high;
  return within;
}

/// Whether all n values are finite.
inline bool all_finite(const double* a, std::ptrdiff_t n) {
  Vec4 even{}, odd{};  // of their products with 0
  std::ptrdiff_t i = 0;
  for (; i + 8 <= n; i += 8) {
    even += 0.0 * load4(a + i);
    odd += 0.0 * load4(a + i + 4);
  }
  double rest = sum_lanes(even + odd);
  for (; i < n; ++i) rest += 0.0 * a[i];
  return rest == 0;
}

/// Σ a_i b_i, in an order that depends on n alone.
inline double dot(const double* a, const double* b, std::ptrdiff_t n) {
  Vec4 even{}, odd{};
  std::ptrdiff_t i = 0;
  for (; i + 8 <= n; i += 8) {
    even += load4(a + i) * load4(b + i);
    odd += load4(a + i + 4) * load4(b + i + 4);
  }
  double sum = sum_lanes(even + odd);
  for (; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace polder
