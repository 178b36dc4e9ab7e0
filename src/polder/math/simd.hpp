#pragma once
// Four doubles at once, by the vector extension that g++ and clang share: a row of faces fits one.
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

/// Sums over the lanes of four vectors at once: {Σa, Σb, Σc, Σd}.
inline Vec4 sum_lanes(Vec4 a, Vec4 b, Vec4 c, Vec4 d) {
  const Vec4 ab = __builtin_shufflevector(a, b, 0, 4, 2, 6) + __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Vec4 cd = __builtin_shufflevector(c, d, 0, 4, 2, 6) + __builtin_shufflevector(c, d, 1, 5, 3, 7);
  return __builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
}
inline double sum_lanes(Vec4 a) { return (a[0] + a[2]) + (a[1] + a[3]); }

}  // namespace polder
