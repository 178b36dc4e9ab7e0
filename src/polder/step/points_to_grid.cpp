#include "polder/step/points_to_grid.hpp"

#include <algorithm>
#include <cmath>

#include "polder/step/face_loop.hpp"
#include "polder/step/gather.hpp"
#include "polder/step/wall_transfer.hpp"

namespace polder {

namespace {

/// |q| in a cell, from the faces below and above it.
template <class Space>
double flux_in_cell(const GridFields<Space>& grid, const Lattice<Space>& lattice, std::ptrdiff_t cell) {
  const Array& flux = grid.relative_flux[Space::up];
  return 0.5 * (flux[cell] + flux[cell + lattice.stride[Space::up]]);
}

/// Mass and momentum of component c; with `with_force`, the internal force too.
template <int c, bool with_force, class Space, class Points>
void scatter_component(const Lattice<Space>& lattice, const Points& points, const double* mass, const double* volume,
                       std::size_t first, int count, const ChunkWeights<Space>& chunk, double* mass_field,
                       double* momentum_field, double* force_field) {
  constexpr int axes = Space::axes;
  const auto& h = lattice.spacing;
  const double* velocity = points.velocity[c].data() + first;
  std::array<const double*, axes> affine{};
  for (int a = 0; a < axes; ++a) affine[a] = points.affine[c * axes + a].data() + first;
  std::array<const double*, axes> stress{};
  if constexpr (with_force)
    for (int a = 0; a < axes; ++a) stress[a] = points.stress[stress_index<Space>(c, a)].data() + first;

  for (int l = 0; l < count; ++l) {
    const SplineRow row = spline_row(chunk.delta[0][c == 0][l]);
    const double m = mass[l];
    const Vec4 mass_row = m * row.weight;
    const Vec4 momentum_row = (m * velocity[l]) * row.weight + (m * h[0] * affine[0][l]) * row.offset;
    const Vec4 momentum_y = (m * h[1] * affine[1][l]) * row.weight;
    Vec4 momentum_z{}, force_row{}, force_y{}, force_z{};
    if constexpr (axes == 3) momentum_z = (m * h[2] * affine[axes - 1][l]) * row.weight;
    if constexpr (with_force) {
      const double v = -volume[l];
      force_row = (v * stress[0][l] / h[0]) * row.derivative;
      force_y = (v * stress[1][l] / h[1]) * row.weight;
      if constexpr (axes == 3) force_z = (v * stress[axes - 1][l] / h[2]) * row.weight;
    }
    const std::ptrdiff_t base = stencil_base<c>(chunk, l);
    over_rows<c>(chunk, lattice, l,
                 [&](std::ptrdiff_t at, double wy, double oy, double dy, double wz, double oz, double dz) {
                   const std::ptrdiff_t node = base + at;
                   store4(mass_field + node, load4(mass_field + node) + (wy * wz) * mass_row);
                   Vec4 p = load4(momentum_field + node) + (wy * wz) * momentum_row + (oy * wz) * momentum_y;
                   if constexpr (axes == 3) p += (wy * oz) * momentum_z;
                   store4(momentum_field + node, p);
                   if constexpr (with_force) {
                     Vec4 f = load4(force_field + node) + (wy * wz) * force_row + (dy * wz) * force_y;
                     if constexpr (axes == 3) f += (wy * dz) * force_z;
                     store4(force_field + node, f);
                   }
                 });
  }
}

/// A force (N, downwards) on the surface above a soil point of the given bulk volume: half the height that is left of
/// its share of a cell.
template <class Space>
void press_on(const Setup<Space>& setup, const SoilPoints<Space>& soil, std::size_t p, double volume, double force,
              double* field) {
  constexpr int up = Space::up;
  const auto& lattice = setup.lattice;
  const double half = 0.5 * lattice.spacing[up] / setup.points_per_axis * volume / setup.nominal_point_volume();
  std::array<double, Space::axes> x{};
  std::array<const double*, Space::axes> at{};
  for (int a = 0; a < Space::axes; ++a) {
    x[a] = soil.position[a][p];
    at[a] = &x[a];
  }
  x[up] = std::min(x[up] + half, lattice.length(up) * (1 - 1e-9));
  ChunkWeights<Space> chunk;
  chunk.compute(lattice, at, 1);
  const Vec4 row = splat4(-force) * spline_row(chunk.delta[0][0][0]).weight;
  const std::ptrdiff_t base = stencil_base<up>(chunk, 0);
  over_rows<up>(chunk, lattice, 0, [&](std::ptrdiff_t offset, double wy, double, double, double wz, double, double) {
    store4(field + base + offset, load4(field + base + offset) + (wy * wz) * row);
  });
}

/// Mass alone of component c.
template <int c, class Space>
void scatter_mass(const Lattice<Space>& lattice, const double* mass, int count, const ChunkWeights<Space>& chunk,
                  double* field) {
  for (int l = 0; l < count; ++l) {
    const Vec4 row = mass[l] * spline_row(chunk.delta[0][c == 0][l]).weight;
    const std::ptrdiff_t base = stencil_base<c>(chunk, l);
    over_rows<c>(chunk, lattice, l, [&](std::ptrdiff_t offset, double wy, double, double, double wz, double, double) {
      store4(field + base + offset, load4(field + base + offset) + (wy * wz) * row);
    });
  }
}

/// Clears face fields where points may write.
template <class Space>
void clear_faces(const Lattice<Space>& lattice, const ActiveRows<Space>& rows, const PhaseBox& box,
                 std::initializer_list<FaceField<Space>*> fields, Team& team) {
  for (int c = 0; c < Space::axes; ++c) {
    over_face_rows(lattice, rows, c, team, [&](std::ptrdiff_t first, int count, const auto&) {
      for (auto* field : fields) std::fill_n((*field)[c].begin() + first, count, 0.0);
    });
    for (auto* field : fields) clear_beyond((*field)[c], c, box, lattice);
  }
}

/// Runs body(first point, count) over chunks of every tile, colour after colour.
template <class Space, class Body>
void over_chunks(const Tiling<Space>& tiling, Team& team, Body&& body) {
  for (const auto& tiles : tiling.by_colour)
    team.each(static_cast<std::ptrdiff_t>(tiles.size()), [&](std::ptrdiff_t t) {
      const TileRange range = tiles[t];
      for (std::uint32_t done = 0; done < range.count; done += chunk_size)
        body(static_cast<std::size_t>(range.first + done), std::min(chunk_size, static_cast<int>(range.count - done)));
    });
}

constexpr double thinnest_half = 0.02;  // spacings, of a flattened box

/// Half the edges, in spacings, of a water point's box that would have `half` if it were shaped as a cell.
template <class Space>
std::array<double, 3> elongated(const WaterPoints<Space>& water, std::size_t p, double half) {
  std::array<double, 3> halves{half, half, half};
  for (int a = 0; a < Space::axes; ++a) halves[a] = std::max(thinnest_half, half * (1 + water.elongation[a][p]));
  return halves;
}

/// Water in the pores of the soil that the soil points carry: mass to the faces, volume to the cells.
template <class Space>
void carried_to_grid(const Setup<Space>& setup, const SoilPoints<Space>& soil, const Tiling<Space>& tiling,
                     GridFields<Space>& grid, Team& team) {
  const auto& lattice = setup.lattice;
  const double cell_volume = lattice.cell_volume();
  clear_faces<Space>(lattice, grid.rows, setup.soil_box, {&grid.carried_mass}, team);
  std::fill(grid.saturated_solid.begin(), grid.saturated_solid.end(), 0.0);
  over_chunks(tiling, team, [&](std::size_t first, int count) {
    ChunkWeights<Space> chunk;
    chunk.compute(lattice, pointers_at<Space>(soil.position, first), count);
    double mass[chunk_size];
    for (int l = 0; l < count; ++l) {
      const std::size_t p = first + l;
      const double n = soil.porosity[p];
      const double bulk = soil.mass[p] / (setup.materials[soil.material[p]].grain_density * (1 - n));
      const double water = soil.saturated[p] ? n * bulk : 0, solid = soil.saturated[p] ? (1 - n) * bulk : 0;
      mass[l] = setup.water.density * water;
      std::array<double, 3> x{0, 0, 0};
      for (int d = 0; d < Space::axes; ++d) x[d] = soil.position[d][p];
      const BoxOverlap<Space> box(lattice, x, half_edge<Space>(bulk, cell_volume), setup.soil_box.low,
                                  setup.soil_box.high);
      box.over_cells(lattice, [&](std::ptrdiff_t cell, double share) {
        grid.water_volume[cell] += share * water;
        grid.saturated_solid[cell] += share * solid;
      });
    }
    over_components<Space>([&]<int c>() { scatter_mass<c>(lattice, mass, count, chunk, grid.carried_mass[c].data()); });
  });
  for (int c = 0; c < Space::axes; ++c) fold(grid.carried_mass[c], c, false, setup.soil_box, lattice);
}

}  // namespace

template <class Space>
void soil_to_grid(const Setup<Space>& setup, const SoilPoints<Space>& soil, const Tiling<Space>& tiling, double time,
                  GridFields<Space>& grid, Team& team) {
  const auto& lattice = setup.lattice;
  clear_faces<Space>(lattice, grid.rows, setup.soil_box, {&grid.soil_mass, &grid.soil_velocity, &grid.soil_force},
                     team);
  over_cell_rows(lattice, grid.rows, team, [&](std::ptrdiff_t first, int count, const auto&) {
    for (auto* field : {&grid.solid_volume, &grid.soil_cell_mass, &grid.linear_drag[0], &grid.linear_drag[1],
                        &grid.quadratic_drag[0], &grid.quadratic_drag[1]})
      std::fill_n(field->begin() + first, count, 0.0);
  });
  const double cell_volume = lattice.cell_volume();
  std::vector<double> load;  // N on one point
  for (const Table& pressure : setup.loads)
    load.push_back(pressure(time) * lattice.face_area(Space::up) / std::pow(setup.points_per_axis, Space::axes - 1));

  over_chunks(tiling, team, [&](std::size_t first, int count) {
    ChunkWeights<Space> chunk;
    chunk.compute(lattice, pointers_at<Space>(soil.position, first), count);
    const bool walled = beside_walls(setup.walls, lattice, chunk, count);
    double volume[chunk_size];
    for (int l = 0; l < count; ++l) {
      const std::size_t p = first + l;
      const SoilMaterial& material = setup.materials[soil.material[p]];
      const double solid = soil.mass[p] / material.grain_density, n = soil.porosity[p];
      volume[l] = solid / (1 - n);
      const std::ptrdiff_t own = cell_index(lattice, chunk, l);
      double a[2], b[2];
      for (int d = 0; d < (setup.anisotropic ? 2 : 1); ++d) {
        const Drag& drag = material.drag[d];
        const bool plain = drag.law == DragLaw::ergun || drag.law == DragLaw::darcy;
        a[d] = volume[l] *
               (plain ? linear_resistance(drag, n) : drag_coefficient(drag, n, flux_in_cell(grid, lattice, own)));
        b[d] = plain ? volume[l] * quadratic_resistance(drag, n) : 0;
      }
      std::array<double, 3> x{0, 0, 0};
      for (int d = 0; d < Space::axes; ++d) x[d] = soil.position[d][p];
      const auto add = [&](std::ptrdiff_t cell, double share) {
        cell = setup.bodies.open_neighbour(cell);
        grid.solid_volume[cell] += share * solid;
        grid.soil_cell_mass[cell] += share * soil.mass[p];
        grid.linear_drag[0][cell] += share * a[0];
        grid.quadratic_drag[0][cell] += share * b[0];
        if (setup.anisotropic) {
          grid.linear_drag[1][cell] += share * a[1];
          grid.quadratic_drag[1][cell] += share * b[1];
        }
      };
      const double half = half_edge<Space>(volume[l], cell_volume);
      if (setup.bodies.open_cell(own) < 1)
        add(own, 1);  // a cell that a body cuts keeps what is in it
      else if (walled)
        over_seen_cells(setup.walls, lattice, x, cell_places(chunk, l), half, setup.soil_box.low, setup.soil_box.high,
                        add);
      else
        BoxOverlap<Space>(lattice, x, half, setup.soil_box.low, setup.soil_box.high).over_cells(lattice, add);
    }
    over_components<Space>([&]<int c>() {
      if (walled)
        scatter_beside_walls<c, true>(setup.walls, lattice, soil, soil.mass.data() + first, volume, first, count, chunk,
                                      grid.soil_mass[c].data(), grid.soil_velocity[c].data(),
                                      grid.soil_force[c].data());
      else
        scatter_component<c, true>(lattice, soil, soil.mass.data() + first, volume, first, count, chunk,
                                   grid.soil_mass[c].data(), grid.soil_velocity[c].data(), grid.soil_force[c].data());
    });
    for (int l = 0; l < count && !load.empty(); ++l)
      if (soil.load[first + l] > 0)
        press_on(setup, soil, first + l, volume[l], load[soil.load[first + l] - 1], grid.soil_force[Space::up].data());
  });

  for (int c = 0; c < Space::axes; ++c) {
    fold(grid.soil_mass[c], c, false, setup.soil_box, lattice);
    fold(grid.soil_velocity[c], c, true, setup.soil_box, lattice);
    fold(grid.soil_force[c], c, true, setup.soil_box, lattice);
  }
  over_cell_rows(lattice, grid.rows, team, [&](std::ptrdiff_t first, int count, const auto&) {
    for (std::ptrdiff_t cell = first; cell < first + count; ++cell) {
      const double open = setup.bodies.open_cell(cell);
      grid.cell_porosity[cell] = open > 0 ? std::max(0.2, 1 - grid.solid_volume[cell] / (cell_volume * open)) : 1;
    }
  });
}

template <class Space>
void water_to_grid(const Setup<Space>& setup, const SoilPoints<Space>& soil, const Tiling<Space>& soil_tiling,
                   const WaterPoints<Space>& water, const Tiling<Space>& tiling, GridFields<Space>& grid, Team& team) {
  const auto& lattice = setup.lattice;
  clear_faces<Space>(lattice, grid.rows, setup.water_box, {&grid.water_mass, &grid.water_velocity}, team);
  over_cell_rows(lattice, grid.rows, team, [&](std::ptrdiff_t first, int count, const auto&) {
    std::fill_n(grid.water_volume.begin() + first, count, 0.0);
  });
  const double cell_volume = lattice.cell_volume(), density = setup.water.density;
  if (setup.single_point) carried_to_grid(setup, soil, soil_tiling, grid, team);

  over_chunks(tiling, team, [&](std::size_t first, int count) {
    ChunkWeights<Space> chunk;
    chunk.compute(lattice, pointers_at<Space>(water.position, first), count);
    const bool walled = beside_walls(setup.walls, lattice, chunk, count);
    double mass[chunk_size];
    for (int l = 0; l < count; ++l) {
      const std::size_t p = first + l;
      mass[l] = density * water.volume[p];
      std::array<double, 3> x{0, 0, 0};
      for (int d = 0; d < Space::axes; ++d) x[d] = water.position[d][p];
      const std::ptrdiff_t own = cell_index(lattice, chunk, l);
      const double bulk = water.volume[p] / grid.cell_porosity[own];
      const double half = std::max(0.1, half_edge<Space>(bulk, cell_volume));
      const bool cut = setup.bodies.open_cell(own) < 1;  // such a cell keeps what is in it
      const auto add = [&](std::ptrdiff_t cell, double share) {
        grid.water_volume[setup.bodies.open_neighbour(cell)] += share * water.volume[p];
      };
      if (cut)
        add(own, 1);
      else if (walled)
        over_seen_cells(setup.walls, lattice, x, cell_places(chunk, l), half, setup.water_box.low, setup.water_box.high,
                        add);
      else
        BoxOverlap<Space>(lattice, x, elongated(water, p, half), setup.water_box.low, setup.water_box.high)
            .over_cells(lattice, add);
    }
    over_components<Space>([&]<int c>() {
      if (walled)
        scatter_beside_walls<c, false>(setup.walls, lattice, water, mass, nullptr, first, count, chunk,
                                       grid.water_mass[c].data(), grid.water_velocity[c].data(), nullptr);
      else
        scatter_component<c, false>(lattice, water, mass, nullptr, first, count, chunk, grid.water_mass[c].data(),
                                    grid.water_velocity[c].data(), nullptr);
    });
  });

  for (int c = 0; c < Space::axes; ++c) {
    fold(grid.water_mass[c], c, false, setup.water_box, lattice);
    fold(grid.water_velocity[c], c, true, setup.water_box, lattice);
  }
  over_cell_rows(lattice, grid.rows, team, [&](std::ptrdiff_t first, int count, const auto&) {
    for (std::ptrdiff_t cell = first; cell < first + count; ++cell) {
      const double open = setup.bodies.open_cell(cell);
      grid.fill[cell] = open > 0 ? grid.water_volume[cell] / (grid.cell_porosity[cell] * cell_volume * open) : 0;
      if (setup.single_point) {  // soil that carries its water ends where its grains do: what is above is not pores
        const double saturated = grid.saturated_solid[cell];
        grid.fill[cell] = (grid.water_volume[cell] + saturated) / (grid.cell_porosity[cell] * cell_volume + saturated);
      }
      grid.wet[cell] = grid.fill[cell] > setup.numerics.wet_threshold;
    }
  });
}

template void soil_to_grid(const Setup<PlaneStrain>&, const SoilPoints<PlaneStrain>&, const Tiling<PlaneStrain>&,
                           double, GridFields<PlaneStrain>&, Team&);
template void soil_to_grid(const Setup<Solid>&, const SoilPoints<Solid>&, const Tiling<Solid>&, double,
                           GridFields<Solid>&, Team&);
template void water_to_grid(const Setup<PlaneStrain>&, const SoilPoints<PlaneStrain>&, const Tiling<PlaneStrain>&,
                            const WaterPoints<PlaneStrain>&, const Tiling<PlaneStrain>&, GridFields<PlaneStrain>&,
                            Team&);
template void water_to_grid(const Setup<Solid>&, const SoilPoints<Solid>&, const Tiling<Solid>&,
                            const WaterPoints<Solid>&, const Tiling<Solid>&, GridFields<Solid>&, Team&);

}  // namespace polder
