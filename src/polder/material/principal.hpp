#pragma once
// Principal stresses of a point and the way back, without a branch, so that loops over points become vector code.
//
// Both spaces are treated alike: an axis that is principal (the out-of-plane one in plane strain, the best separated
// eigenvector in three dimensions) and a plane across it in which the 2×2 problem has its closed form
//   p = m ± √(d² + o²),  m = (s₁₁ + s₂₂)/2,  d = (s₁₁ − s₂₂)/2,  o = s₁₂.
// The eigenvalue of the axis in three dimensions is the outer root of t³ − 3t = 2r, r = |det B|/2, B = dev(σ)/√(J₂/3):
// it lies in [√3, 2], where three Newton steps from a parabola reach round-off, and its distance to the other two is at
// least √3 √(J₂/3). So neither equal eigenvalues nor a hydrostatic stress cost accuracy, and no trigonometry is needed.
#include <algorithm>
#include <cmath>

namespace polder {

#define POLDER_INLINE [[gnu::always_inline]] inline

/// Principal stresses in order: major ≥ middle ≥ minor (tension positive).
struct Principal {
  double major, middle, minor;
};

/// The pair of principal values in a plane, high ≥ low, with cos 2θ and sin 2θ of the direction of `high`.
struct PlanePair {
  double high, low, cosine, sine;
};

POLDER_INLINE PlanePair principal_pair(double s11, double s22, double s12) {
  const double mean = 0.5 * (s11 + s22), half = 0.5 * (s11 - s22);
  const double radius = std::sqrt(half * half + s12 * s12);
  const bool isotropic = radius < 1e-150;
  const double inverse = 1.0 / (isotropic ? 1.0 : radius);
  return {mean + radius, mean - radius, isotropic ? 1.0 : half * inverse, s12 * inverse};
}

/// Sorted principal values, with what it takes to put returned values back in their places.
struct PrincipalOrder {
  Principal sorted;
  bool axis_is_major, axis_is_minor;
};

POLDER_INLINE PrincipalOrder sort_principal(double high, double low, double axis) {
  const bool major = axis > high, minor = axis < low;
  return {{major ? axis : high, major ? high : (minor ? low : axis), minor ? axis : low}, major, minor};
}

struct PlacedPrincipal {
  double high, low, axis;
};

POLDER_INLINE PlacedPrincipal place_principal(const PrincipalOrder& order, const Principal& s) {
  return {order.axis_is_major ? s.middle : s.major, order.axis_is_minor ? s.middle : s.minor,
          order.axis_is_major ? s.major : (order.axis_is_minor ? s.minor : s.middle)};
}

struct Vector3 {
  double x, y, z;
};

POLDER_INLINE Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
POLDER_INLINE double dot(const Vector3& a, const Vector3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
POLDER_INLINE Vector3 scaled(const Vector3& a, double factor) { return {a.x * factor, a.y * factor, a.z * factor}; }
POLDER_INLINE Vector3 choose(bool first, const Vector3& a, const Vector3& b) {
  return {first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z};
}

/// A symmetric tensor, components xx yy zz xy yz zx.
struct Tensor {
  double xx, yy, zz, xy, yz, zx;
};

POLDER_INLINE Vector3 product(const Tensor& s, const Vector3& a) {
  return {s.xx * a.x + s.xy * a.y + s.zx * a.z, s.xy * a.x + s.yy * a.y + s.yz * a.z,
          s.zx * a.x + s.yz * a.y + s.zz * a.z};
}

/// One Newton step on t³ − 3t = 2r.
POLDER_INLINE double cubic_newton(double t, double twice_r) {
  return t - (t * (t * t - 3) - twice_r) / (3 * (t * t - 1));
}

/// A deviator by its size and its outermost principal value.
struct OuterRoot {
  double mean;     ///< of the tensor
  double size;     ///< √(J₂/3)
  double inverse;  ///< 1/size; 1 where there is no deviator
  double root;  ///< t: the principal value of largest magnitude of B = dev/size, |t| in [√3, 2]; its sign says which
};

POLDER_INLINE OuterRoot outer_root(const Tensor& s) {
  const double mean = (s.xx + s.yy + s.zz) * (1.0 / 3.0);
  const double xx = s.xx - mean, yy = s.yy - mean, zz = s.zz - mean;
  const double size =
      std::sqrt((xx * xx + yy * yy + zz * zz) * (1.0 / 6.0) + (s.xy * s.xy + s.yz * s.yz + s.zx * s.zx) * (1.0 / 3.0));
  const double inverse = 1.0 / (size < 1e-100 ? 1.0 : size);
  const double determinant =
      (xx * (yy * zz - s.yz * s.yz) - s.xy * (s.xy * zz - s.yz * s.zx) + s.zx * (s.xy * s.yz - yy * s.zx)) * inverse *
      inverse * inverse;
  const double twice_r = std::abs(determinant);
  const double parabola = 1.7320508075688772 + twice_r * (0.16666666666666667 - 0.01634603522555 * twice_r);
  const double t = cubic_newton(cubic_newton(cubic_newton(parabola, twice_r), twice_r), twice_r);
  return {mean, size, inverse, determinant < 0 ? -t : t};
}

/// Largest minus smallest principal value, without directions (relative error up to 1e-8 near equal values).
POLDER_INLINE double principal_span(const Tensor& s) {
  const OuterRoot outer = outer_root(s);
  const double t = std::abs(outer.root), rest = 12 - 3 * t * t;
  return outer.size * 0.5 * (3 * t + std::sqrt(rest > 0 ? rest : 0.0));
}

/// The unit eigenvector whose eigenvalue is best separated from the others; x where all are equal.
POLDER_INLINE Vector3 separated_axis(const Tensor& s) {
  const OuterRoot outer = outer_root(s);
  const double t = outer.root, f = outer.inverse;
  const Tensor b{
      (s.xx - outer.mean) * f, (s.yy - outer.mean) * f, (s.zz - outer.mean) * f, s.xy * f, s.yz * f, s.zx * f};
  // Rows of B − tI span the plane across the eigenvector; the longest of their cross products is the safest.
  const Vector3 row_x{b.xx - t, b.xy, b.zx}, row_y{b.xy, b.yy - t, b.yz}, row_z{b.zx, b.yz, b.zz - t};
  const Vector3 xy = cross(row_x, row_y), yz = cross(row_y, row_z), zx = cross(row_z, row_x);
  const double xy2 = dot(xy, xy), yz2 = dot(yz, yz), zx2 = dot(zx, zx);
  Vector3 best = choose(yz2 > xy2, yz, xy);
  double best2 = yz2 > xy2 ? yz2 : xy2;
  best = choose(zx2 > best2, zx, best);
  best2 = zx2 > best2 ? zx2 : best2;
  const bool hydrostatic = best2 < 1e-150;
  const double length = 1.0 / std::sqrt(hydrostatic ? 1.0 : best2);
  return choose(hydrostatic, Vector3{1, 0, 0}, scaled(best, length));
}

/// A unit vector across the unit vector `axis`.
POLDER_INLINE Vector3 perpendicular(const Vector3& axis) {
  const bool use_x = std::abs(axis.x) < 0.6;
  const Vector3 across = choose(use_x, Vector3{0, axis.z, -axis.y}, Vector3{-axis.z, 0, axis.x});
  return scaled(across, 1.0 / std::sqrt(dot(across, across)));
}

/// Σ of the dyads a₁₁ u⊗u + a₂₂ w⊗w + a₁₂ (u⊗w + w⊗u) + a₃₃ v⊗v.
POLDER_INLINE Tensor assemble(const Vector3& u, const Vector3& w, const Vector3& v, double a11, double a22, double a12,
                              double a33) {
  const Vector3 fu{a11 * u.x + a12 * w.x, a11 * u.y + a12 * w.y, a11 * u.z + a12 * w.z};
  const Vector3 fw{a12 * u.x + a22 * w.x, a12 * u.y + a22 * w.y, a12 * u.z + a22 * w.z};
  const Vector3 fv = scaled(v, a33);
  return {fu.x * u.x + fw.x * w.x + fv.x * v.x, fu.y * u.y + fw.y * w.y + fv.y * v.y,
          fu.z * u.z + fw.z * w.z + fv.z * v.z, fu.x * u.y + fw.x * w.y + fv.x * v.y,
          fu.y * u.z + fw.y * w.z + fv.y * v.z, fu.z * u.x + fw.z * w.x + fv.z * v.x};
}

}  // namespace polder
