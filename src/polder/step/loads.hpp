#pragma once
// What the loads on the ground bring to the grid.
#include <algorithm>
#include <cmath>

#include "polder/case/ground_load.hpp"
#include "polder/step/wall_transfer.hpp"

namespace polder {

/// A force (N, downwards) on the surface above a soil point of the given bulk volume: half the height that is left of
/// its share of a cell.
template <class Space>
void press_on(const Setup<Space>& setup, const SoilPoints<Space>& soil, std::size_t p, double volume, double force,
              double* field) {
  constexpr int up = Space::up;
  const auto& lattice = setup.lattice;
  const std::array<int, 3> own = cell_of(lattice, position_of(soil, p));
  const double half =
      0.5 * lattice.axis[up].width(own[up]) / setup.points_per_axis * volume / setup.nominal_point_volume(own);
  std::array<double, Space::axes> x{};
  std::array<const double*, Space::axes> at{};
  for (int a = 0; a < Space::axes; ++a) {
    x[a] = soil.position[a][p];
    at[a] = &x[a];
  }
  x[up] = std::min(x[up] + half, lattice.length(up) * (1 - 1e-9));
  ChunkWeights<Space> chunk;
  chunk.row[0][0] = chunk.row[1][0] = nullptr;  // for the compiler, which does not see that both ask for `graded`
  chunk.compute(lattice, at, 1);
  if (beside_walls(setup.walls, lattice, chunk, 1)) {
    over_seen_nodes<up>(setup.walls, lattice, chunk, 0,
                        [&](const SeenNode<Space>& node) { field[node.at] -= node.sign * force * node.value(); });
    return;
  }
  Vec4 row = splat4(-force);
  by_spacing(lattice, [&]<bool graded>() { row *= x_row<up, graded>(chunk, 0).weight; });
  const std::ptrdiff_t base = stencil_base<up>(chunk, 0);
  over_rows<up>(chunk, lattice.stride, 0, [&](std::ptrdiff_t offset, double wy, double, double wz, auto...) {
    store4(field + base + offset, load4(field + base + offset) + (wy * wz) * row);
  });
}

/// N, downwards, at `time`: the force of the load that a soil point carries, on its share of its column; 0: it carries
/// none.
template <class Space>
double load_on(const Setup<Space>& setup, const SoilPoints<Space>& soil, std::size_t p, double time) {
  if (soil.load[p] == 0) return 0;
  const auto& lattice = setup.lattice;
  const int ppa = setup.points_per_axis, columns = Space::axes == 3 ? ppa * ppa : ppa;  // of points in a cell
  const std::array<int, 3> column = cell_of(lattice, reference_of(soil, p));
  const double width = lattice.axis[0].width(column[0]) / ppa;
  const double pressure =
      pressure_on(setup.loads[soil.load[p] - 1], time, soil.position[0][p], soil.reference[0][p], width);
  return pressure * lattice.face_area(Space::up, column) / columns;
}

/// The forces at `time` of the loads that the points [first, first + count) carry to the vertical faces; `volume`: bulk
/// volumes of these points.
template <class Space>
void press_loads(const Setup<Space>& setup, const SoilPoints<Space>& soil, std::size_t first, int count,
                 const double* volume, double time, double* field) {
  if (setup.loads.empty()) return;
  for (int l = 0; l < count; ++l) {
    const std::size_t p = first + static_cast<std::size_t>(l);
    if (soil.load[p] > 0) press_on(setup, soil, p, volume[l], load_on(setup, soil, p, time), field);
  }
}

}  // namespace polder
