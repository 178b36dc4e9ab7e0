#include "polder/step/points_to_grid.hpp"

#include <algorithm>
#include <cmath>

#include "polder/step/chunk_loop.hpp"
#include "polder/step/face_loop.hpp"
#include "polder/step/gather.hpp"
#include "polder/step/soil_volume.hpp"
#include "polder/step/wall_transfer.hpp"

namespace polder {

namespace {

constexpr double thinnest_half = 0.02;  // spacings, of a water point's flattened box

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
    const SplineRow row = x_row<c>(chunk, l);
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
  const Vec4 row = splat4(-force) * x_row<up>(chunk, 0).weight;
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
    const Vec4 row = mass[l] * x_row<c>(chunk, l).weight;
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

/// What a chunk of soil points brings to the cells.
struct alignas(64) SoilContent {
  double volume[chunk_size];     // bulk, m³
  double half_edge[chunk_size];  // of the point's box, spacings
  double solid[chunk_size], mass[chunk_size], linear[chunk_size], quadratic[chunk_size];
  double linear_up[chunk_size], quadratic_up[chunk_size];  // drag in the vertical, where it differs

  Vec4 horizontal(int l) const { return Vec4{solid[l], mass[l], linear[l], quadratic[l]}; }

  template <class Space>
  void compute(const Setup<Space>& setup, const GridFields<Space>& grid, const SoilPoints<Space>& soil,
               std::size_t first, int count, const ChunkWeights<Space>& chunk) {
    const double cell_volume = setup.lattice.cell_volume();
    const auto& own = soil.material;
    const bool one =
        std::all_of(own.begin() + first, own.begin() + first + count, [&](auto m) { return m == own[first]; });
    if (one && setup.materials[own[first]].drag[0].packed() && !setup.anisotropic) {
      const SoilMaterial& material = setup.materials[own[first]];
      const double inverse = 1 / material.grain_density;
      const Drag drag = material.drag[0];
      const double *n = soil.porosity.data() + first, *m = soil.mass.data() + first;
      for (int l = 0; l < count; ++l) {
        mass[l] = m[l];
        solid[l] = m[l] * inverse;
        volume[l] = solid[l] / (1 - n[l]);
        const PackedResistance c = packed_resistance(drag, n[l]);
        linear[l] = volume[l] * c.linear;
        quadratic[l] = volume[l] * c.quadratic;
      }
    } else {
      for (int l = 0; l < count; ++l) {
        const std::size_t p = first + l;
        const SoilMaterial& material = setup.materials[own[p]];
        const double n = soil.porosity[p];
        mass[l] = soil.mass[p];
        solid[l] = mass[l] / material.grain_density;
        volume[l] = solid[l] / (1 - n);
        double a[2], b[2];
        for (int d = 0; d < (setup.anisotropic ? 2 : 1); ++d) {
          const Drag& drag = material.drag[d];
          a[d] = volume[l] *
                 (drag.plain() ? linear_resistance(drag, n)
                               : drag_coefficient(
                                     drag, n, flux_in_cell(grid, setup.lattice, cell_index(setup.lattice, chunk, l))));
          b[d] = drag.plain() ? volume[l] * quadratic_resistance(drag, n) : 0;
        }
        linear[l] = a[0];
        quadratic[l] = b[0];
        if (setup.anisotropic) {
          linear_up[l] = a[1];
          quadratic_up[l] = b[1];
        }
      }
    }
    for (int l = 0; l < count; ++l) half_edge[l] = polder::half_edge<Space>(volume[l], cell_volume);
  }
};

/// Half the edges of a chunk's boxes, in spacings: as cubes, and along each axis where they are elongated.
template <class Space>
struct HalfEdges {
  const double* cube;
  std::array<const double*, static_cast<std::size_t>(Space::axes)> along;
};

/// body(point of the chunk, cell index, share) for the cells that the points' boxes overlap. A cell that a body cuts
/// keeps what is in it; beside thin walls boxes are cubes.
template <class Space, class Body>
void over_boxes(const Setup<Space>& setup, const std::array<Array, Space::axes>& position, const PhaseBox& box,
                std::size_t first, int count, const ChunkWeights<Space>& chunk, bool walled,
                const HalfEdges<Space>& half_edges, Body&& body) {
  const auto& lattice = setup.lattice;
  if (!walled && !setup.bodies.any()) {
    ChunkOverlap<Space> overlap;
    overlap.compute(lattice, pointers_at<Space>(position, first), half_edges.along, count, box.low, box.high);
    for (int l = 0; l < count; ++l)
      overlap.over_cells(lattice, l, [&](std::ptrdiff_t cell, double share) { body(l, cell, share); });
    return;
  }
  for (int l = 0; l < count; ++l) {
    const auto add = [&](std::ptrdiff_t cell, double share) { body(l, setup.bodies.open_neighbour(cell), share); };
    const std::ptrdiff_t own = cell_index(lattice, chunk, l);
    if (setup.bodies.open_cell(own) < 1) {
      add(own, 1);
      continue;
    }
    std::array<double, 3> x{0, 0, 0};
    for (int a = 0; a < Space::axes; ++a) x[a] = position[a][first + static_cast<std::size_t>(l)];
    if (walled) {
      over_seen_cells(setup.walls, lattice, x, cell_places(chunk, l), half_edges.cube[l], box.low, box.high, add);
      continue;
    }
    std::array<double, 3> halves{0, 0, 0};
    for (int a = 0; a < Space::axes; ++a) halves[a] = half_edges.along[a][l];
    BoxOverlap<Space>(lattice, x, halves, box.low, box.high).over_cells(lattice, add);
  }
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
      const double bulk = bulk_volume(setup, soil, p);
      const double water = soil.saturated[p] ? n * bulk : 0, solid = soil.saturated[p] ? (1 - n) * bulk : 0;
      mass[l] = setup.water.density * water;
      const BoxOverlap<Space> box(lattice, position_of(soil, p), half_edge<Space>(bulk, cell_volume),
                                  setup.soil_box.low, setup.soil_box.high);
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
    std::fill_n(grid.soil_sums.begin() + 4 * first, 4 * count, 0.0);
    for (auto* field : {&grid.linear_drag[1], &grid.quadratic_drag[1]})
      if (setup.anisotropic) std::fill_n(field->begin() + first, count, 0.0);
  });
  const double cell_volume = lattice.cell_volume();
  std::vector<double> load;  // N on one point
  for (const Table& pressure : setup.loads)
    load.push_back(pressure(time) * lattice.face_area(Space::up) / std::pow(setup.points_per_axis, Space::axes - 1));

  over_chunks(tiling, team, [&](std::size_t first, int count) {
    ChunkWeights<Space> chunk;
    chunk.compute(lattice, pointers_at<Space>(soil.position, first), count);
    const bool walled = beside_walls(setup.walls, lattice, chunk, count);
    SoilContent content;
    content.compute(setup, grid, soil, first, count, chunk);
    HalfEdges<Space> half_edges{content.half_edge, {}};
    half_edges.along.fill(content.half_edge);
    over_boxes(setup, soil.position, setup.soil_box, first, count, chunk, walled, half_edges,
               [&](int l, std::ptrdiff_t cell, double share) {
                 double* sums = grid.soil_sums.data() + 4 * cell;
                 store4(sums, load4(sums) + share * content.horizontal(l));
                 if (setup.anisotropic) {
                   grid.linear_drag[1][cell] += share * content.linear_up[l];
                   grid.quadratic_drag[1][cell] += share * content.quadratic_up[l];
                 }
               });
    const double* volume = content.volume;
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
    fold_motion(grid.soil_mass[c], grid.soil_velocity[c], c, setup.soil_box, lattice);
    fold(grid.soil_force[c], c, true, setup.soil_box, lattice);
  }
  over_cell_rows(lattice, grid.rows, team, [&](std::ptrdiff_t first, int count, const auto&) {
    for (std::ptrdiff_t cell = first; cell < first + count; ++cell) {
      const double* sums = grid.soil_sums.data() + 4 * cell;
      grid.solid_volume[cell] = sums[0];
      grid.soil_cell_mass[cell] = sums[1];
      grid.linear_drag[0][cell] = sums[2];
      grid.quadratic_drag[0][cell] = sums[3];
      const double open = setup.bodies.open_cell(cell);
      grid.cell_porosity[cell] = open > 0 ? std::max(0.2, 1 - grid.solid_volume[cell] / (cell_volume * open)) : 1;
    }
  });
  for (Array* field : {&grid.solid_volume, &grid.soil_cell_mass, &grid.cell_porosity, &grid.linear_drag[0],
                       &grid.linear_drag[1], &grid.quadratic_drag[0], &grid.quadratic_drag[1]})
    join_ends(*field, setup.soil_box, lattice);
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
  const bool stretched = setup.stretches_water();
  if (setup.single_point) carried_to_grid(setup, soil, soil_tiling, grid, team);

  over_chunks(tiling, team, [&](std::size_t first, int count) {
    ChunkWeights<Space> chunk;
    chunk.compute(lattice, pointers_at<Space>(water.position, first), count);
    const bool walled = beside_walls(setup.walls, lattice, chunk, count);
    const double* volume = water.volume.data() + first;
    double mass[chunk_size], half[chunk_size], elongated[Space::axes][chunk_size];
    for (int l = 0; l < count; ++l) {
      mass[l] = density * volume[l];
      const double bulk = volume[l] / grid.cell_porosity[cell_index(lattice, chunk, l)];
      half[l] = std::max(0.1, half_edge<Space>(bulk, cell_volume));
    }
    HalfEdges<Space> half_edges{half, {}};
    for (int a = 0; a < Space::axes; ++a) {
      half_edges.along[a] = half;
      if (!stretched) continue;
      const double* elongation = water.elongation[a].data() + first;
      for (int l = 0; l < count; ++l) elongated[a][l] = std::max(thinnest_half, half[l] * (1 + elongation[l]));
      half_edges.along[a] = elongated[a];
    }
    over_boxes(setup, water.position, setup.water_box, first, count, chunk, walled, half_edges,
               [&](int l, std::ptrdiff_t cell, double share) { grid.water_volume[cell] += share * volume[l]; });
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
    fold_motion(grid.water_mass[c], grid.water_velocity[c], c, setup.water_box, lattice);
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
  join_ends(grid.fill, setup.water_box, lattice);
  join_ends(grid.wet, setup.water_box, lattice);
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
