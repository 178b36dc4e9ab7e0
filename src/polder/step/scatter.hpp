#pragma once
// Adding a chunk's points to a face field: the transpose of step/gather.hpp.
//
// A row of four faces along x is one vector. What the points bring is worked out for the whole chunk first; then, point
// by point, the products with the weights along z and along y are taken once per plane and per row.
#include "polder/step/chunk.hpp"

namespace polder {

/// What a chunk's points bring to one component.
template <class Space>
struct alignas(64) Contribution {
  static constexpr int axes = Space::axes;
  const double* mass;              // kg
  double velocity[chunk_size];     // of the point's affine motion at the middle node of its stencil, m/s
  double slope[axes][chunk_size];  // its change per spacing, m/s
  double force[axes][chunk_size];  // −V σ_ca/h_a, N

  /// APIC.
  template <int c, class Points>
  void take_motion(const Lattice<Space>& lattice, const ChunkWeights<Space>& chunk, const Points& points,
                   const double* mass_, std::size_t first, int count) {
    mass = mass_;
    const double* own = points.velocity[c].data() + first;
    const double* gradient[axes];
    for (int a = 0; a < axes; ++a) gradient[a] = points.affine[c * axes + a].data() + first;
    const auto h = lattice.spacing;
    POLDER_INDEPENDENT
    for (int l = 0; l < count; ++l) {
      double v = own[l];
      for (int a = 0; a < axes; ++a) {
        const double change = h[a] * gradient[a][l];
        v -= chunk.delta[a][a == c][l] * change;
        slope[a][l] = change;
      }
      velocity[l] = v;
    }
  }

  template <int c, class Points>
  void take_force(const Lattice<Space>& lattice, const Points& points, const double* volume, std::size_t first,
                  int count) {
    for (int a = 0; a < axes; ++a) {
      const double inverse = -1 / lattice.spacing[a];
      const double* stress = points.stress[stress_index<Space>(c, a)].data() + first;
      for (int l = 0; l < count; ++l) force[a][l] = volume[l] * inverse * stress[l];
    }
  }
};

/// Three rows of mass and momentum (and force), one above the other along y.
struct PlaneOfRows {
  Vec4 mass, velocity[3], force, force_y;

  template <bool with_force>
  [[gnu::always_inline]] void add_row(int j, Vec4 weight, Vec4 derivative, std::ptrdiff_t row, double* masses,
                                      double* momenta, double* forces) const {
    const Vec4 share = weight * mass;
    store4(masses + row, load4(masses + row) + share);
    store4(momenta + row, load4(momenta + row) + share * velocity[j]);
    if constexpr (with_force) store4(forces + row, load4(forces + row) + (weight * force + derivative * force_y));
  }
};

/// Adds mass and momentum of component c and, `with_force`, the internal force.
template <int c, bool with_force, bool graded, class Space>
void scatter_component(const Lattice<Space>& lattice, const ChunkWeights<Space>& chunk,
                       const Contribution<Space>& points, int count, double* mass_field, double* momentum_field,
                       double* force_field) {
  constexpr int axes = Space::axes, sy = c == 1, sz = c == 2;
  const std::ptrdiff_t up = lattice.stride[1], back = lattice.stride[2];
  const auto &wy = chunk.weight[1][sy], &dy = chunk.derivative[1][sy];
  for (int l = 0; l < count; ++l) {
    const SplineRow x = x_row<c, graded>(chunk, l);
    const Vec4 mass = points.mass[l] * x.weight;
    const Vec4 velocity = points.velocity[l] + points.slope[0][l] * x.node, slope_y = splat4(points.slope[1][l]);
    Vec4 force{}, force_y{};
    if constexpr (with_force) {
      force = points.force[0][l] * x.derivative;
      force_y = points.force[1][l] * x.weight;
    }
    std::ptrdiff_t at = stencil_base<c>(chunk, l);
    const auto add_plane = [&](Vec4 mass_, Vec4 velocity_, Vec4 force_, Vec4 force_y_) {
      PlaneOfRows plane{mass_, {}, force_, force_y_};
      chunk.template at_nodes<graded>(1, sy, l, velocity_, slope_y, plane.velocity);
      const std::ptrdiff_t rows[3] = {at, at + up, at + 2 * up};
      const auto add_row = [&](int j) {
        plane.add_row<with_force>(j, splat4(wy[j][l]), splat4(dy[j][l]), rows[j], mass_field, momentum_field,
                                  force_field);
      };
      add_row(0);
      add_row(1);
      add_row(2);
    };
    if constexpr (axes == 2) {
      add_plane(mass, velocity, force, force_y);
    } else {
      Vec4 velocities[3], force_z{};
      chunk.template at_nodes<graded>(axes - 1, sz, l, velocity, splat4(points.slope[axes - 1][l]), velocities);
      if constexpr (with_force) force_z = points.force[axes - 1][l] * x.weight;
      for (int k = 0; k < 3; ++k, at += back) {
        const double w = chunk.weight[axes - 1][sz][k][l], d = chunk.derivative[axes - 1][sz][k][l];
        add_plane(w * mass, velocities[k], w * force + d * force_z, w * force_y);
      }
    }
  }
}

/// Adds one quantity alone.
template <int c, class Space>
void scatter_value(const Lattice<Space>& lattice, const ChunkWeights<Space>& chunk, const double* value, int count,
                   double* field) {
  const auto stride = lattice.stride;  // stores to the field cannot change it
  by_spacing(lattice, [&]<bool graded>() {
    for (int l = 0; l < count; ++l) {
      const Vec4 row = value[l] * x_row<c, graded>(chunk, l).weight;
      double* base = field + stencil_base<c>(chunk, l);
      over_rows<c>(chunk, stride, l, [&](std::ptrdiff_t at, double wy, double, double wz, auto...) {
        store4(base + at, load4(base + at) + (wy * wz) * row);
      });
    }
  });
}

}  // namespace polder
