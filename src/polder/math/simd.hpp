#pragma once
// Four doubles at once, by the vector extension that g++ and clang share: a row of faces fits one.
#include <cstddef>
#include <cstring>

/// Before a loop: its iterations do not depend on each other.
#ifdef __clang__
#define POLDER_INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#else
#define POLDER_INDEPENDENT _Pragma("GCC ivdep")
#endif

namespace polder {

using Vec4 = double __attribute__((vector_size(32)));

inline Vec4 load4(const double* from) {
  Vec4 v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
inline void store4(double* to, Vec4 v) { std::memcpy(to, &v, sizeof v); }
inline Vec4 splat4(double a) { return Vec4{a, a, a, a}; }

/// Eight floats at once, for the preconditioner.
using Vec8f = float __attribute__((vector_size(32)));

inline Vec8f load8(const float* from) {
  Vec8f v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
inline void store8(float* to, Vec8f v) { std::memcpy(to, &v, sizeof v); }

/// Sums over the lanes of four vectors at once: {Σa, Σb, Σc, Σd}.
inline Vec4 sum_lanes(Vec4 a, Vec4 b, Vec4 c, Vec4 d) {
  const Vec4 ab = __builtin_shufflevector(a, b, 0, 4, 2, 6) + __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Vec4 cd = __builtin_shufflevector(c, d, 0, 4, 2, 6) + __builtin_shufflevector(c, d, 1, 5, 3, 7);
  return __builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
}
inline double sum_lanes(Vec4 a) { return (a[0] + a[2]) + (a[1] + a[3]); }

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
