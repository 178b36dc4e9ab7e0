#pragma once
// Sums of a face field over the stencils of a chunk's points.
#include "polder/step/chunk.hpp"

namespace polder {

/// Velocity, APIC moments (Σ w v (x_node − x_p), in spacings) and gradient (per spacing) of one component at a chunk's
/// points.
template <class Space>
struct alignas(64) Gathered {
  double value[chunk_size];
  double moment[Space::axes][chunk_size];
  double gradient[Space::axes][chunk_size];
};

template <int c, bool with_gradient, bool graded, class Space>
void gather_component(const Lattice<Space>& lattice, const ChunkWeights<Space>& chunk, int count, const double* field,
                      Gathered<Space>& out) {
  constexpr int axes = Space::axes, sy = c == 1, sz = c == 2;
  const std::ptrdiff_t up = lattice.stride[1], back = lattice.stride[2];
  const auto &wy = chunk.weight[1][sy], &oy = chunk.offset[1][sy], &dy = chunk.derivative[1][sy];
  for (int l = 0; l < count; ++l) {
    const double* base = field + stencil_base<c>(chunk, l);
    Vec4 sum, offset_y, slope_y{}, offset_z{}, slope_z{};
    const auto add_plane = [&](const double* at, Vec4& with_weight, Vec4& with_offset, Vec4& with_slope) {
      const Vec4 low = load4(at), middle = load4(at + up), high = load4(at + 2 * up);
      with_weight = wy[0][l] * low + wy[1][l] * middle + wy[2][l] * high;
      with_offset = oy[0][l] * low + oy[1][l] * middle + oy[2][l] * high;
      if constexpr (with_gradient) with_slope = dy[0][l] * low + dy[1][l] * middle + dy[2][l] * high;
    };
    if constexpr (axes == 2) {
      add_plane(base, sum, offset_y, slope_y);
    } else {
      const auto &wz = chunk.weight[axes - 1][sz], &oz = chunk.offset[axes - 1][sz];
      const auto& dz = chunk.derivative[axes - 1][sz];
      sum = offset_y = Vec4{};
      for (int k = 0; k < 3; ++k) {
        Vec4 value, offset, slope{};
        add_plane(base + k * back, value, offset, slope);
        sum += wz[k][l] * value;
        offset_y += wz[k][l] * offset;
        offset_z += oz[k][l] * value;
        if constexpr (with_gradient) {
          slope_y += wz[k][l] * slope;
          slope_z += dz[k][l] * value;
        }
      }
    }
    const SplineRow x = x_row<c, graded>(chunk, l);
    const Vec4 first =
        sum_lanes(sum * x.weight, sum * x.offset, offset_y * x.weight, with_gradient ? sum * x.derivative : Vec4{});
    out.value[l] = first[0];
    out.moment[0][l] = first[1];
    out.moment[1][l] = first[2];
    if constexpr (with_gradient) {
      out.gradient[0][l] = first[3];
      if constexpr (axes == 2) {
        out.gradient[1][l] = sum_lanes(slope_y * x.weight);
      } else {
        const Vec4 second = sum_lanes(offset_z * x.weight, slope_y * x.weight, slope_z * x.weight, Vec4{});
        out.moment[axes - 1][l] = second[0];
        out.gradient[1][l] = second[1];
        out.gradient[axes - 1][l] = second[2];
      }
    } else if constexpr (axes == 3) {
      out.moment[axes - 1][l] = sum_lanes(offset_z * x.weight);
    }
  }
}

/// The values of several fields of one component, and nothing else.
template <int c, int fields, bool graded, class Space>
void gather_values(const Lattice<Space>& lattice, const ChunkWeights<Space>& chunk, int count,
                   const std::array<const double*, fields>& field, const std::array<double*, fields>& value) {
  static_assert(fields <= 4);
  constexpr int axes = Space::axes, sy = c == 1, sz = c == 2;
  const std::ptrdiff_t up = lattice.stride[1], back = lattice.stride[2];
  const auto& wy = chunk.weight[1][sy];
  for (int l = 0; l < count; ++l) {
    const std::ptrdiff_t base = stencil_base<c>(chunk, l);
    const auto plane = [&](const double* at) {
      return wy[0][l] * load4(at) + wy[1][l] * load4(at + up) + wy[2][l] * load4(at + 2 * up);
    };
    const Vec4 x = x_row<c, graded>(chunk, l).weight;
    Vec4 weighted[4] = {};
    for (int f = 0; f < fields; ++f) {
      const double* at = field[f] + base;
      if constexpr (axes == 2) {
        weighted[f] = x * plane(at);
      } else {
        const auto& wz = chunk.weight[axes - 1][sz];
        weighted[f] = x * (wz[0][l] * plane(at) + wz[1][l] * plane(at + back) + wz[2][l] * plane(at + 2 * back));
      }
    }
    if constexpr (fields == 1) {
      value[0][l] = sum_lanes(weighted[0]);
    } else {
      const Vec4 sums = sum_lanes(weighted[0], weighted[1], weighted[2], weighted[3]);
      for (int f = 0; f < fields; ++f) value[f][l] = sums[f];
    }
  }
}

/// APIC: the point takes the grid's velocity and affine motion (B·D⁻¹, D = Σ w (node − point)², of equal cells h²/4).
template <int c, class Space, class Points>
void take_motion(const Lattice<Space>& lattice, const ChunkWeights<Space>& chunk, const Gathered<Space>& gathered,
                 std::size_t first, int count, Points& points) {
  for (int l = 0; l < count; ++l) points.velocity[c][first + l] = gathered.value[l];
  for (int a = 0; a < Space::axes; ++a) {
    const double factor = 4 / lattice.spacing[a];
    double* affine = points.affine[c * Space::axes + a].data() + first;
    if (lattice.graded) {
      const double inverse = 1 / lattice.spacing[a];
      for (int l = 0; l < count; ++l) affine[l] = inverse / chunk.inertia[a][a == c][l] * gathered.moment[a][l];
      continue;
    }
    for (int l = 0; l < count; ++l) affine[l] = factor * gathered.moment[a][l];
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
