#pragma once
// What the chunks of soil points of the unsaturated formulation add to the faces, with the differences that stand for
// derivatives there (unsaturated_transfer.hpp).
#include "polder/points/point_sets.hpp"
#include "polder/step/cell_weights.hpp"
#include "polder/step/fields.hpp"
#include "polder/step/setup.hpp"
#include "polder/step/wall_transfer.hpp"

namespace polder {

/// Of the four nodes of a row of faces, the lower one of the point's own cell: 0 or 1.
inline int own_face(double delta) { return delta < 0 ? 0 : 1; }

/// Derivatives along a component's own axis (but x, whose rows are made where they are used) as cell differences.
template <class Space>
void use_cell_differences(const Lattice<Space>& lattice, ChunkWeights<Space>& chunk, int count) {
  for (int a = 1; a < Space::axes; ++a)
    for (int l = 0; l < count; ++l) {
      const int o = own_face(chunk.delta[a][1][l]);
      const double step = 1 / relative_width(lattice, a, chunk.cell[a][l]);
      for (int i = 0; i < 3; ++i) chunk.derivative[a][1][i][l] = i == o ? -step : i == o + 1 ? step : 0;
    }
}

/// The difference between the faces of a point's own cell, in a row that starts one cell before.
inline constexpr Vec4 difference_row{0, -1, 1, 0};

/// The same per smallest cell on the axis.
template <class Space>
Vec4 x_difference(const Lattice<Space>& lattice, const ChunkWeights<Space>& chunk, int l) {
  return lattice.graded ? difference_row / relative_width(lattice, 0, chunk.cell[0][l]) : difference_row;
}

/// What a point brings to the faces.
template <int axes>
struct MixtureLoad {
  double inertia[chunk_size], weight[chunk_size], held[chunk_size];
  double along[chunk_size];         // N, of gravity towards +x, where it leans
  double volume[axes][chunk_size];  // over which the stress acts, by axis of the derivative: across the surface of a
                                    // body that cuts the cell as if it filled the cell
};

/// scatter_mixture() beside thin walls.
// NOLINTBEGIN(readability-non-const-parameter): written in the lambda
template <int c, class Space>
void scatter_beside(const Setup<Space>& setup, const SoilPoints<Space>& points, const MixtureLoad<Space::axes>& load,
                    std::size_t first, int count, const ChunkWeights<Space>& chunk, GridFields<Space>& grid,
                    double* held_field) {
  const bool leans = c == 0 && setup.tilt != 0;
  double* force_field = grid.soil_force[c].data();
  const auto volume = [&](int l, int a) { return load.volume[a][l]; };
  scatter_beside_walls<c, true, true>(setup.walls, setup.lattice, points, load.inertia, volume, first, count, chunk,
                                      grid.soil_mass[c].data(), grid.soil_velocity[c].data(), force_field);
  for (int l = 0; l < count; ++l)
    over_seen_nodes<c>(setup.walls, setup.lattice, chunk, l, [&](const SeenNode<Space>& node) {
      if (held_field) held_field[node.at] += load.held[l] * node.value();
      if (c == Space::up) force_field[node.at] -= node.sign * load.weight[l] * node.value();
      if (leans) force_field[node.at] += node.sign * load.along[l] * node.value();
    });
}
// NOLINTEND(readability-non-const-parameter)

template <int c, bool graded, bool leans, class Space>
void scatter_mixture(const Lattice<Space>& lattice, const SoilPoints<Space>& points,
                     const MixtureLoad<Space::axes>& load, std::size_t first, int count,
                     const ChunkWeights<Space>& chunk, GridFields<Space>& grid, double* held_field) {
  constexpr int axes = Space::axes;
  const auto& h = lattice.spacing;
  double* mass_field = grid.soil_mass[c].data();
  double* momentum_field = grid.soil_velocity[c].data();
  double* force_field = grid.soil_force[c].data();
  for (int l = 0; l < count; ++l) {
    const std::size_t p = first + static_cast<std::size_t>(l);
    const double m = load.inertia[l];
    const auto v = [&](int a) { return -load.volume[a][l]; };
    const SplineRow row = x_row<c, graded>(chunk, l);
    const Vec4 slope = c == 0 ? x_difference(lattice, chunk, l) : row.derivative;
    const auto affine = [&](int a) { return points.affine[c * axes + a][p]; };
    const auto stress = [&](int a) { return points.stress[stress_index<Space>(c, a)][p]; };
    const Vec4 mass_row = m * row.weight, held_row = load.held[l] * row.weight;
    // the point's affine motion at the node that is the middle one along y and z, and its change per spacing along them
    Vec4 velocity = points.velocity[c][p] + (h[0] * affine(0)) * (row.node - chunk.delta[0][c == 0][l]);
    double slope_of[3] = {0, h[1] * affine(1), axes == 3 ? h[2] * affine(axes - 1) : 0};
    for (int a = 1; a < axes; ++a) velocity -= splat4(chunk.delta[a][a == c][l] * slope_of[a]);
    const auto node = [&](int a, int i) {
      if constexpr (graded) return chunk.node[a][a == c][i][l];
      return static_cast<double>(i - 1);
    };
    Vec4 force_row = (v(0) * stress(0) / h[0]) * slope;
    if (c == Space::up) force_row -= load.weight[l] * row.weight;
    if constexpr (c == 0 && leans) force_row += load.along[l] * row.weight;
    const Vec4 force_y = (v(1) * stress(1) / h[1]) * row.weight;
    Vec4 force_z{};
    if constexpr (axes == 3) force_z = (v(axes - 1) * stress(axes - 1) / h[2]) * row.weight;
    const std::ptrdiff_t base = stencil_base<c>(chunk, l);
    over_rows<c>(chunk, lattice.stride, l,
                 [&](std::ptrdiff_t at, double wy, double dy, double wz, double dz, int j, int k) {
                   const std::ptrdiff_t to = base + at;
                   const Vec4 share = (wy * wz) * mass_row;
                   double beyond = node(1, j) * slope_of[1];
                   Vec4 f = load4(force_field + to) + (wy * wz) * force_row + (dy * wz) * force_y;
                   if constexpr (axes == 3) {
                     beyond += node(axes - 1, k) * slope_of[axes - 1];
                     f += (wy * dz) * force_z;
                   }
                   store4(mass_field + to, load4(mass_field + to) + share);
                   if (held_field) store4(held_field + to, load4(held_field + to) + (wy * wz) * held_row);
                   store4(momentum_field + to, load4(momentum_field + to) + share * (velocity + beyond));
                   store4(force_field + to, f);
                 });
  }
}

/// A point's volume to the cells of its own layer along axis c, by centre splines across: the volume over which the
/// cell difference of component c is taken, of the smallest width along it.
template <int c, bool graded, class Space>
void scatter_weight(const Setup<Space>& setup, const double* volume, int count, const ChunkWeights<Space>& chunk,
                    double* field) {
  const auto& lattice = setup.lattice;
  for (int l = 0; l < count; ++l) {
    if (volume[l] == 0) continue;
    const std::ptrdiff_t cell = cell_index(lattice, chunk, l);
    const double scaled = graded ? volume[l] / relative_width(lattice, c, chunk.cell[c][l]) : volume[l];
    if (const WallStencil<Space>* stencil = setup.walls.beside(cell); stencil != nullptr) {
      for (int k = Space::axes == 3 ? -1 : 0; k <= (Space::axes == 3 ? 1 : 0); ++k)
        for (int j = -1; j <= 1; ++j)
          for (int i = -1; i <= 1; ++i) {
            const int o[3] = {i, j, k};
            double w = scaled;
            for (int a = 0; a < Space::axes; ++a) {
              double weight[3], offset[3], derivative[3];
              if constexpr (graded)
                chunk.weights(a, 0, l, weight, offset, derivative);
              else
                spline_weights(chunk.delta[a][0][l], weight, offset, derivative);
              w *= a == c ? (o[a] == 0 ? 1.0 : 0.0) : weight[o[a] + 1];
            }
            const int number = (i + 1) + 3 * (j + 1) + (Space::axes == 3 ? 9 * (k + 1) : 0);
            field[cell + stencil->cell[static_cast<std::size_t>(number)]] += w;
          }
      continue;
    }
    constexpr Vec4 own{0, 1, 0, 0};
    Vec4 row = scaled * own;
    if constexpr (c != 0) row = scaled * x_row<c, graded>(chunk, l).weight;
    double* base = field + chunk.cell_base[l];
    const auto across = [&](int a, int i) { return a == c ? (i == 1 ? 1.0 : 0.0) : chunk.weight[a][0][i][l]; };
    for (int k = 0; k < (Space::axes == 3 ? 3 : 1); ++k)
      for (int j = 0; j < 3; ++j) {
        const double w = across(1, j) * (Space::axes == 3 ? across(Space::axes - 1, k) : 1);
        double* at = base + j * lattice.stride[1] + (Space::axes == 3 ? k * lattice.stride[2] : 0);
        store4(at, load4(at) + w * row);
      }
  }
}

}  // namespace polder
