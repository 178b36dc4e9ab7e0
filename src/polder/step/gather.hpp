#pragma once
// Sums of a face field over the stencils of a chunk's points.
#include "polder/step/chunk.hpp"

namespace polder {

/// Velocity, APIC moments about the middle node of the stencil (Σ w v (x_node − x_middle), in spacings) and gradient
/// (per spacing) of one component at a chunk's points.
template <class Space>
struct alignas(64) Gathered {
  double value[chunk_size];
  double moment[Space::axes][chunk_size];
  double gradient[Space::axes][chunk_size];
};

/// A field summed over the planes of point l's stencil of component c, still to be weighted along x.
template <int c, class Space>
[[gnu::always_inline]] inline Vec4 sum_rows(const ChunkWeights<Space>& chunk,
                                            const std::array<std::ptrdiff_t, 3>& stride, int l, const double* base) {
  const auto& wy = chunk.weight[1][c == 1];
  const auto plane = [&](const double* at) {
    return wy[0][l] * load4(at) + wy[1][l] * load4(at + stride[1]) + wy[2][l] * load4(at + 2 * stride[1]);
  };
  if constexpr (Space::axes == 2) {
    return plane(base);
  } else {
    const auto& wz = chunk.weight[2][c == 2];
    return wz[0][l] * plane(base) + wz[1][l] * plane(base + stride[2]) + wz[2][l] * plane(base + 2 * stride[2]);
  }
}

/// to[i][l] = Σ over the lanes of part[i]. Sums over lanes are taken four at a time.
template <int n>
[[gnu::always_inline]] inline void store_sums(const Vec4 (&part)[n], double* const (&to)[n], int l) {
  const auto at = [&](int i) { return i < n ? part[i] : Vec4{}; };
  for (int i = 0; i < n; i += 4) {
    if (i + 1 == n) {
      to[i][l] = sum_lanes(part[i]);
      continue;
    }
    const Vec4 sums = sum_lanes(at(i), at(i + 1), at(i + 2), at(i + 3));
    for (int j = i; j < std::min(n, i + 4); ++j) to[j][l] = sums[j - i];
  }
}

/// The sums of one field and, with the same weights, the values of `others` more.
template <int c, bool with_gradient, bool graded, std::size_t others = 0, class Space>
void gather_component(const Lattice<Space>& lattice, const ChunkWeights<Space>& chunk, int count, const double* field,
                      Gathered<Space>& out, const std::array<const double*, others>& other = {},
                      const std::array<double*, others>& other_value = {}) {
  constexpr int axes = Space::axes, z = axes - 1, sy = c == 1, sz = c == 2;
  constexpr int moments = 1, slopes = moments + axes, first_other = slopes + (with_gradient ? axes : 0);
  constexpr int sums = first_other + static_cast<int>(others);
  double* to[sums] = {out.value};
  for (int a = 0; a < axes; ++a) to[moments + a] = out.moment[a];
  for (int a = 0; with_gradient && a < axes; ++a) to[slopes + a] = out.gradient[a];
  std::copy_n(other_value.begin(), others, to + first_other);

  const auto stride = lattice.stride;  // stores to the points cannot change it
  const auto &wy = chunk.weight[1][sy], &dy = chunk.derivative[1][sy];
  for (int l = 0; l < count; ++l) {
    const std::ptrdiff_t base = stencil_base<c>(chunk, l);
    Vec4 sum, moment_y, slope_y, moment_z{}, slope_z{};
    const auto add_plane = [&](const double* at, Vec4& with_weight, Vec4& with_moment, Vec4& with_slope) {
      const Vec4 low = load4(at), middle = load4(at + stride[1]), high = load4(at + 2 * stride[1]);
      const Vec4 low_part = wy[0][l] * low, high_part = wy[2][l] * high;
      with_weight = low_part + wy[1][l] * middle + high_part;
      with_moment = chunk.template moment<graded>(1, sy, l, low_part, high_part);
      with_slope = dy[0][l] * low + dy[1][l] * middle + dy[2][l] * high;
    };
    if constexpr (axes == 2) {
      add_plane(field + base, sum, moment_y, slope_y);
    } else {
      const auto &wz = chunk.weight[z][sz], &dz = chunk.derivative[z][sz];
      Vec4 part[3];
      sum = moment_y = slope_y = Vec4{};
      for (int k = 0; k < 3; ++k) {
        Vec4 value, moment, slope;
        add_plane(field + base + k * stride[2], value, moment, slope);
        part[k] = wz[k][l] * value;
        sum += part[k];
        moment_y += wz[k][l] * moment;
        slope_y += wz[k][l] * slope;
        slope_z += dz[k][l] * value;
      }
      moment_z = chunk.template moment<graded>(z, sz, l, part[0], part[2]);
    }
    const SplineRow x = x_row<c, graded>(chunk, l);
    Vec4 part[sums] = {sum * x.weight};
    part[moments + z] = moment_z * x.weight;
    part[moments] = part[0] * x.node;
    part[moments + 1] = moment_y * x.weight;
    if constexpr (with_gradient) {
      part[slopes + z] = slope_z * x.weight;
      part[slopes] = sum * x.derivative;
      part[slopes + 1] = slope_y * x.weight;
    }
    for (std::size_t f = 0; f < others; ++f)
      part[first_other + f] = x.weight * sum_rows<c>(chunk, stride, l, other[f] + base);
    store_sums(part, to, l);
  }
}

/// The value of a field alone.
template <int c, bool graded, class Space>
void gather_value(const Lattice<Space>& lattice, const ChunkWeights<Space>& chunk, int count, const double* field,
                  double* value) {
  const auto stride = lattice.stride;  // stores to the points cannot change it
  for (int l = 0; l < count; ++l) {
    const Vec4 sum = sum_rows<c>(chunk, stride, l, field + stencil_base<c>(chunk, l));
    value[l] = sum_lanes(x_row<c, graded>(chunk, l).weight * sum);
  }
}

/// APIC: the point takes the grid's velocity and affine motion (B·D⁻¹, D = Σ w (node − point)², of equal cells h²/4).
template <int c, class Space, class Points>
void take_motion(const Lattice<Space>& lattice, const ChunkWeights<Space>& chunk, const Gathered<Space>& gathered,
                 std::size_t first, int count, Points& points) {
  for (int l = 0; l < count; ++l) points.velocity[c][first + l] = gathered.value[l];
  for (int a = 0; a < Space::axes; ++a) {
    const double inverse = 1 / lattice.spacing[a];
    double* affine = points.affine[c * Space::axes + a].data() + first;
    const auto about_point = [&](int l) {
      return gathered.moment[a][l] - chunk.delta[a][a == c][l] * gathered.value[l];
    };
    if (lattice.graded) {
      for (int l = 0; l < count; ++l) affine[l] = inverse / chunk.inertia[a][a == c][l] * about_point(l);
      continue;
    }
    POLDER_INDEPENDENT
    for (int l = 0; l < count; ++l) affine[l] = 4 * inverse * about_point(l);
  }
}

/// Runs body.operator()<c>() for every component of the space.
template <class Space, class Body>
void over_components(Body&& body) {
  body.template operator()<0>();
  body.template operator()<1>();
  if constexpr (Space::axes == 3) body.template operator()<2>();
}

template <class Space>
std::array<const double*, Space::axes> pointers_at(const std::array<Array, Space::axes>& arrays, std::size_t first) {
  std::array<const double*, Space::axes> p{};
  for (int a = 0; a < Space::axes; ++a) p[a] = arrays[a].data() + first;
  return p;
}

}  // namespace polder
