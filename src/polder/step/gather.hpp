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

template <int c, bool with_gradient, class Space>
void gather_component(const Lattice<Space>& lattice, const ChunkWeights<Space>& chunk, int count, const double* field,
                      Gathered<Space>& out) {
  for (int l = 0; l < count; ++l) {
    const double* base = field + stencil_base<c>(chunk, l);
    Vec4 sum{}, offset_y{}, slope_y{}, offset_z{}, slope_z{};
    over_rows<c>(chunk, lattice, l,
                 [&](std::ptrdiff_t at, double wy, double oy, double dy, double wz, double oz, double dz) {
                   const Vec4 row = load4(base + at);
                   sum += (wy * wz) * row;
                   offset_y += (oy * wz) * row;
                   if constexpr (with_gradient) slope_y += (dy * wz) * row;
                   if constexpr (Space::axes == 3) {
                     offset_z += (wy * oz) * row;
                     if constexpr (with_gradient) slope_z += (wy * dz) * row;
                   }
                 });
    const SplineRow x = x_row<c>(chunk, l);
    const Vec4 first =
        sum_lanes(sum * x.weight, sum * x.offset, offset_y * x.weight, with_gradient ? sum * x.derivative : Vec4{});
    out.value[l] = first[0];
    out.moment[0][l] = first[1];
    out.moment[1][l] = first[2];
    if constexpr (with_gradient) {
      out.gradient[0][l] = first[3];
      if constexpr (Space::axes == 2) {
        out.gradient[1][l] = sum_lanes(slope_y * x.weight);
      } else {
        const Vec4 second = sum_lanes(offset_z * x.weight, slope_y * x.weight, slope_z * x.weight, Vec4{});
        out.moment[Space::axes - 1][l] = second[0];
        out.gradient[1][l] = second[1];
        out.gradient[Space::axes - 1][l] = second[2];
      }
    } else if constexpr (Space::axes == 3) {
      out.moment[Space::axes - 1][l] = sum_lanes(offset_z * x.weight);
    }
  }
}

/// The values of several fields of one component, and nothing else.
template <int c, int fields, class Space>
void gather_values(const Lattice<Space>& lattice, const ChunkWeights<Space>& chunk, int count,
                   const std::array<const double*, fields>& field, const std::array<double*, fields>& value) {
  static_assert(fields <= 4);
  for (int l = 0; l < count; ++l) {
    const std::ptrdiff_t base = stencil_base<c>(chunk, l);
    Vec4 sum[fields] = {};
    over_rows<c>(chunk, lattice, l, [&](std::ptrdiff_t at, double wy, double, double, double wz, double, double) {
      for (int f = 0; f < fields; ++f) sum[f] += (wy * wz) * load4(field[f] + base + at);
    });
    const Vec4 x = x_row<c>(chunk, l).weight;
    if constexpr (fields == 1) {
      value[0][l] = sum_lanes(sum[0] * x);
    } else {
      Vec4 weighted[4] = {};
      for (int f = 0; f < fields; ++f) weighted[f] = sum[f] * x;
      const Vec4 sums = sum_lanes(weighted[0], weighted[1], weighted[2], weighted[3]);
      for (int f = 0; f < fields; ++f) value[f][l] = sums[f];
    }
  }
}

/// APIC: the point takes the grid's velocity and affine motion (B·D⁻¹, D = h²/4).
template <int c, class Space, class Points>
void take_motion(const Lattice<Space>& lattice, const Gathered<Space>& gathered, std::size_t first, int count,
                 Points& points) {
  for (int l = 0; l < count; ++l) points.velocity[c][first + l] = gathered.value[l];
  for (int a = 0; a < Space::axes; ++a) {
    const double factor = 4 / lattice.spacing[a];
    double* affine = points.affine[c * Space::axes + a].data() + first;
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
