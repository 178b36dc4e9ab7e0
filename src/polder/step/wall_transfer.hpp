#pragma once
// The transfers of chunks with points beside a thin wall: node by node, each at the place where the point sees it
// (grid/thin_walls.hpp). The same sums as in points_to_grid.cpp and gather.hpp, slower, for few points.
#include "polder/grid/bodies.hpp"
#include "polder/grid/thin_walls.hpp"
#include "polder/step/gather.hpp"

namespace polder {

template <class Space>
bool beside_walls(const ThinWalls<Space>& walls, const Lattice<Space>& lattice, const ChunkWeights<Space>& chunk,
                  int count) {
  if (!walls.any()) return false;
  for (int l = 0; l < count; ++l)
    if (walls.beside(cell_index(lattice, chunk, l)) != nullptr) return true;
  return false;
}

/// Whether a body cuts or covers a cell beside one of the points' own.
template <class Space>
bool beside_bodies(const Bodies<Space>& bodies, const Lattice<Space>& lattice, const ChunkWeights<Space>& chunk,
                   int count) {
  if (!bodies.any()) return false;
  for (int l = 0; l < count; ++l)
    if (bodies.near(cell_index(lattice, chunk, l))) return true;
  return false;
}

/// A node of a point's stencil: where it is seen, the sign of motion there, and per axis the spline's weight, weight ×
/// (node − point) and derivative, in spacings.
template <class Space>
struct SeenNode {
  std::ptrdiff_t at;
  double sign;
  std::array<double, 3> weight{1, 1, 1}, offset{0, 0, 0}, derivative{0, 0, 0};

  double value() const { return weight[0] * weight[1] * weight[2]; }
  double moment(int a) const { return value_with(offset[a], a); }
  double slope(int a) const { return value_with(derivative[a], a); }

 private:
  double value_with(double factor, int a) const {
    for (int b = 0; b < Space::axes; ++b)
      if (b != a) factor *= weight[b];
    return factor;
  }
};

/// body(node) over the stencil of point l for component c. `own_difference`: the derivative along the component's own
/// axis is the difference of the two faces of the point's cell.
template <int c, bool own_difference = false, class Space, class Body>
void over_seen_nodes(const ThinWalls<Space>& walls, const Lattice<Space>& lattice, const ChunkWeights<Space>& chunk,
                     int l, Body&& body) {
  constexpr int axes = Space::axes;
  const std::ptrdiff_t cell = cell_index(lattice, chunk, l);
  const WallStencil<Space>* stencil = walls.beside(cell);
  double weight[3][3], offset[3][3], derivative[3][3];
  if (lattice.graded) {
    for (int a = 0; a < axes; ++a) chunk.weights(a, a == c, l, weight[a], offset[a], derivative[a]);
  } else {
    for (int a = 0; a < axes; ++a) spline_weights(chunk.delta[a][a == c][l], weight[a], offset[a], derivative[a]);
  }
  const int shift = chunk.face_shift[c][l] != 0;
  if constexpr (own_difference) {
    const double step = lattice.spacing[c] / lattice.axis[c].width(chunk.cell[c][l]);
    for (int i = 0; i < 3; ++i) derivative[c][i] = i == 1 - shift ? -step : i == 2 - shift ? step : 0;
  }
  for (int k = 0; k < (axes == 3 ? 3 : 1); ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const int number[3] = {i, j, k};
        int o[3] = {0, 0, 0};
        SeenNode<Space> node{cell, 1};
        for (int a = 0; a < axes; ++a) {
          o[a] = number[a] - 1 + (a == c ? shift : 0);
          node.weight[a] = weight[a][number[a]];
          node.offset[a] = offset[a][number[a]];
          node.derivative[a] = derivative[a][number[a]];
        }
        if (stencil != nullptr) {
          const auto& seen = stencil->of[c][WallStencil<Space>::node(o[0], o[1], o[2])];
          node.at += seen.at;
          node.sign = seen.sign;
        } else {
          for (int a = 0; a < axes; ++a) node.at += o[a] * lattice.stride[a];
        }
        body(node);
      }
}

/// Mass and momentum of component c; with `with_force`, the internal force too, of stress over volume(number of the
/// point in the chunk, axis of the derivative).
// NOLINTBEGIN(readability-non-const-parameter): they are written in the lambda
template <int c, bool with_force, bool own_difference = false, class Space, class Points, class Volume>
void scatter_beside_walls(const ThinWalls<Space>& walls, const Lattice<Space>& lattice, const Points& points,
                          const double* mass, const Volume& volume, std::size_t first, int count,
                          const ChunkWeights<Space>& chunk, double* mass_field, double* momentum_field,
                          double* force_field) {
  constexpr int axes = Space::axes;
  for (int l = 0; l < count; ++l) {
    const std::size_t p = first + static_cast<std::size_t>(l);
    over_seen_nodes<c, own_difference>(walls, lattice, chunk, l, [&](const SeenNode<Space>& node) {
      double momentum = points.velocity[c][p] * node.value();
      for (int a = 0; a < axes; ++a) momentum += points.affine[c * axes + a][p] * lattice.spacing[a] * node.moment(a);
      mass_field[node.at] += mass[l] * node.value();
      momentum_field[node.at] += node.sign * mass[l] * momentum;
      if constexpr (with_force) {
        double force = 0;
        for (int a = 0; a < axes; ++a)
          force -= volume(l, a) * points.stress[stress_index<Space>(c, a)][p] * node.slope(a) / lattice.spacing[a];
        force_field[node.at] += node.sign * force;
      }
    });
  }
}
// NOLINTEND(readability-non-const-parameter)

/// As gather_component().
template <int c, bool with_gradient, bool own_difference = false, class Space>
void gather_beside_walls(const ThinWalls<Space>& walls, const Lattice<Space>& lattice, const ChunkWeights<Space>& chunk,
                         int count, const double* field, Gathered<Space>& out,
                         double (*gradient)[chunk_room] = nullptr) {
  for (int l = 0; l < count; ++l) {
    out.value[l] = 0;
    for (int a = 0; a < Space::axes; ++a) {
      out.moment[a][l] = 0;
      if constexpr (with_gradient) gradient[a][l] = 0;
    }
    over_seen_nodes<c, own_difference>(walls, lattice, chunk, l, [&](const SeenNode<Space>& node) {
      const double v = node.sign * field[node.at];
      out.value[l] += node.value() * v;
      for (int a = 0; a < Space::axes; ++a) {
        out.moment[a][l] += (node.moment(a) + chunk.from_reference(c, a, l, lattice.graded) * node.value()) * v;
        if constexpr (with_gradient) gradient[a][l] += node.slope(a) / lattice.spacing[a] * v;
      }
    });
  }
}

/// Adds one quantity alone, of which a field's sign at the seen node is that of motion.
// NOLINTBEGIN(readability-non-const-parameter): written in the lambda
template <int c, class Space>
void scatter_value_beside_walls(const ThinWalls<Space>& walls, const Lattice<Space>& lattice,
                                const ChunkWeights<Space>& chunk, const double* value, int count, double* field) {
  for (int l = 0; l < count; ++l)
    over_seen_nodes<c>(walls, lattice, chunk, l,
                       [&](const SeenNode<Space>& node) { field[node.at] += node.sign * value[l] * node.value(); });
}
// NOLINTEND(readability-non-const-parameter)

/// The field's value alone.
template <int c, class Space>
void gather_value_beside_walls(const ThinWalls<Space>& walls, const Lattice<Space>& lattice,
                               const ChunkWeights<Space>& chunk, int count, const double* field, double* value) {
  for (int l = 0; l < count; ++l) {
    value[l] = 0;
    over_seen_nodes<c>(walls, lattice, chunk, l,
                       [&](const SeenNode<Space>& node) { value[l] += node.value() * node.sign * field[node.at]; });
  }
}

/// Shares of a point's box in cells, body(cell index, share): the box is pushed off the walls of the point's own cell,
/// and what would lie in a cell behind a corner stays in the own one.
template <class Space, class Body>
void over_seen_cells(const ThinWalls<Space>& walls, const Lattice<Space>& lattice,
                     const std::array<double, 3>& position, const std::array<int, 3>& own, double half,
                     std::array<int, 3> low, std::array<int, 3> high, Body&& body) {
  const std::ptrdiff_t cell = lattice.index(own[0], own[1], own[2]);
  const WallStencil<Space>* stencil = walls.beside(cell);
  if (stencil == nullptr) {
    BoxOverlap<Space>(lattice, position, half, low, high).over_cells(lattice, body);
    return;
  }
  for (int a = 0; a < Space::axes; ++a) {
    if (stencil->shut[a][0]) low[a] = own[a];
    if (stencil->shut[a][1]) high[a] = own[a] + 1;
  }
  BoxOverlap<Space>(lattice, position, half, low, high).over_cells(lattice, [&](std::ptrdiff_t at, double share) {
    const bool seen = std::find(stencil->cell.begin(), stencil->cell.end(), static_cast<std::int32_t>(at - cell)) !=
                      stencil->cell.end();
    body(seen ? at : cell, share);
  });
}

}  // namespace polder
