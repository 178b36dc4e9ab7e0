#pragma once
// Sums of a face field over the stencils of a chunk's points.
#include "polder/step/four_points.hpp"

namespace polder {

/// Velocity and APIC moments about a node of the stencil (Σ w v (x_node − x_reference), in spacings) of one component
/// at a chunk's points.
template <class Space>
struct alignas(64) Gathered {
  double value[chunk_room];
  double moment[Space::axes][chunk_room];
};

/// The sums of one field, its `gradient` by axis (per metre) if one is asked for and, with the same weights, the values
/// of `others` more; to arrays with a chunk's room. What is written beyond the points of a batch is written again with
/// the next.
template <int c, bool with_gradient, bool graded, bool own_difference = false, std::size_t others = 0, class Space>
void gather_component(const Lattice<Space>& lattice, const ChunkWeights<Space>& chunk, int count, const double* field,
                      Gathered<Space>& out, double (*gradient)[chunk_room] = nullptr,
                      const std::array<const double*, others>& other = {},
                      const std::array<double*, others>& other_value = {}) {
  const auto stride = lattice.stride;  // stores to the points cannot change it
  double inverse[Space::axes];
  for (int a = 0; a < Space::axes; ++a) inverse[a] = 1 / lattice.spacing[a];
  for (int batch = 0; batch < chunk.batches; ++batch) {
    const int l = chunk.batch[batch];
    const std::ptrdiff_t base = chunk.cell_base[l];
    const FourPoints<c, with_gradient, graded, own_difference, Space> points(lattice, chunk, stride, l, count);
    const auto sums = points.sums(field + base);
    store4(out.value + l, sums.value);
    for (int a = 0; a < Space::axes; ++a) {
      store4(out.moment[a] + l, sums.moment[a]);
      if constexpr (with_gradient) store4(gradient[a] + l, inverse[a] * sums.slope[a]);
    }
    for (std::size_t f = 0; f < others; ++f) store4(other_value[f] + l, points.value(other[f] + base));
  }
}

/// The value of a field alone; to an array with a chunk's room.
template <int c, bool graded, class Space>
void gather_value(const Lattice<Space>& lattice, const ChunkWeights<Space>& chunk, int count, const double* field,
                  double* value) {
  const auto stride = lattice.stride;  // stores to the points cannot change it
  for (int batch = 0; batch < chunk.batches; ++batch) {
    const int l = chunk.batch[batch];
    const FourPoints<c, false, graded, false, Space> points(lattice, chunk, stride, l, count);
    store4(value + l, points.value(field + chunk.cell_base[l]));
  }
}

/// APIC: the point takes the grid's velocity and affine motion (B·D⁻¹, D = Σ w (node − point)², of equal cells h²/4).
template <int c, class Space, class Points>
void take_motion(const Lattice<Space>& lattice, const ChunkWeights<Space>& chunk, const Gathered<Space>& gathered,
                 std::size_t first, int count, Points& points) {
  std::copy_n(gathered.value, count, points.velocity[c].data() + first);
  for (int a = 0; a < Space::axes; ++a) {
    const double inverse = 1 / lattice.spacing[a];
    double* affine = points.affine[c * Space::axes + a].data() + first;
    const auto about_point = [&](int l) {
      return gathered.moment[a][l] - chunk.from_reference(c, a, l, lattice.graded) * gathered.value[l];
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
  unrolled<Space::axes>(body);
}

template <class Space>
std::array<const double*, Space::axes> pointers_at(const std::array<Array, Space::axes>& arrays, std::size_t first) {
  std::array<const double*, Space::axes> p{};
  for (int a = 0; a < Space::axes; ++a) p[a] = arrays[a].data() + first;
  return p;
}

}  // namespace polder
