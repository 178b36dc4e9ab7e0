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
  const double* mass;               // kg
  double momentum[chunk_size];      // kg m/s
  double affine[axes][chunk_size];  // change of the momentum per spacing, kg m/s
  double force[axes][chunk_size];   // −V σ_ca/h_a, N

  /// APIC: mass × velocity and mass × its gradient.
  template <int c, class Points>
  void take_momentum(const Lattice<Space>& lattice, const Points& points, const double* mass_, std::size_t first,
                     int count) {
    mass = mass_;
    const double* velocity = points.velocity[c].data() + first;
    for (int l = 0; l < count; ++l) momentum[l] = mass_[l] * velocity[l];
    for (int a = 0; a < axes; ++a) {
      const double h = lattice.spacing[a];
      const double* gradient = points.affine[c * axes + a].data() + first;
      for (int l = 0; l < count; ++l) affine[a][l] = mass_[l] * h * gradient[l];
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
  Vec4 mass, momentum, momentum_y, force, force_y;

  template <bool with_force>
  [[gnu::always_inline]] void add_row(Vec4 weight, Vec4 offset, Vec4 derivative, std::ptrdiff_t row, double* masses,
                                      double* momenta, double* forces) const {
    store4(masses + row, load4(masses + row) + weight * mass);
    store4(momenta + row, load4(momenta + row) + (weight * momentum + offset * momentum_y));
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
  const auto &wy = chunk.weight[1][sy], &oy = chunk.offset[1][sy], &dy = chunk.derivative[1][sy];
  for (int l = 0; l < count; ++l) {
    const SplineRow x = x_row<c, graded>(chunk, l);
    const Vec4 mass = points.mass[l] * x.weight;
    const Vec4 momentum = points.momentum[l] * x.weight + points.affine[0][l] * x.offset;
    const Vec4 momentum_y = points.affine[1][l] * x.weight;
    Vec4 force{}, force_y{};
    if constexpr (with_force) {
      force = points.force[0][l] * x.derivative;
      force_y = points.force[1][l] * x.weight;
    }
    std::ptrdiff_t at = stencil_base<c>(chunk, l);
    const auto add_plane = [&](const PlaneOfRows& plane) {
      const std::ptrdiff_t rows[3] = {at, at + up, at + 2 * up};
      const auto add_row = [&](int j) {
        plane.add_row<with_force>(splat4(wy[j][l]), splat4(oy[j][l]), splat4(dy[j][l]), rows[j], mass_field,
                                  momentum_field, force_field);
      };
      add_row(0);
      add_row(1);
      add_row(2);
    };
    if constexpr (axes == 2) {
      add_plane({mass, momentum, momentum_y, force, force_y});
    } else {
      const Vec4 momentum_z = points.affine[axes - 1][l] * x.weight;
      Vec4 force_z{};
      if constexpr (with_force) force_z = points.force[axes - 1][l] * x.weight;
      for (int k = 0; k < 3; ++k, at += back) {
        const double w = chunk.weight[axes - 1][sz][k][l], o = chunk.offset[axes - 1][sz][k][l];
        PlaneOfRows plane{w * mass, w * momentum + o * momentum_z, w * momentum_y, Vec4{}, Vec4{}};
        if constexpr (with_force) {
          plane.force = w * force + chunk.derivative[axes - 1][sz][k][l] * force_z;
          plane.force_y = w * force_y;
        }
        add_plane(plane);
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
      over_rows<c>(chunk, stride, l, [&](std::ptrdiff_t at, double wy, double, double, double wz, double, double) {
        store4(base + at, load4(base + at) + (wy * wz) * row);
      });
    }
  });
}

}  // namespace polder
