#include "polder/step/points_to_grid.hpp"

#include <algorithm>
#include <cmath>

#include "polder/step/chunk_loop.hpp"
#include "polder/step/face_loop.hpp"
#include "polder/step/gather.hpp"
#include "polder/step/loads.hpp"
#include "polder/step/scatter.hpp"
#include "polder/step/soil_volume.hpp"
#include "polder/step/wall_transfer.hpp"

namespace polder {

namespace {

constexpr double thinnest_cube = 0.1;   // cells, half the edge of a water point's box
constexpr double rim = 0.05;            // cells: half the box of water in a cell that a body cuts
constexpr double thinnest_half = 0.02;  // likewise, where it is flattened
constexpr double least_room = 1e-3;     // share of a cell that saturated soil leaves to free water

/// |q| in a cell, from the faces below and above it.
template <class Space>
double flux_in_cell(const GridFields<Space>& grid, const Lattice<Space>& lattice, std::ptrdiff_t cell) {
  const Array& flux = grid.relative_flux[Space::up];
  return 0.5 * (flux[cell] + flux[cell + lattice.stride[Space::up]]);
}

/// Clears face fields where points may write, and what body(first cell, count) clears of a row of cells.
template <class Space, class Body>
void clear(const Lattice<Space>& lattice, const ActiveRows<Space>& rows, const PhaseBox& box,
           std::initializer_list<FaceField<Space>*> fields, Team& team, Body&& body) {
  const auto beyond = [&](const MirrorShare& share) {
    for (int c = 0; c < Space::axes; ++c)
      for (auto* field : fields) clear_beyond((*field)[c], c, box, lattice, share);
  };
  share_rows(rows, team, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    for (int c = 0; c < Space::axes; ++c)
      visit_face_rows(lattice, rows, c, begin, end, [&](std::ptrdiff_t first, int count, const auto&) {
        for (auto* field : fields) std::fill_n((*field)[c].begin() + first, count, 0.0);
      });
    visit_cell_rows(lattice, rows, begin, end,
                    [&](std::ptrdiff_t first, int count, const auto&) { body(first, count); });
    beyond(ends_of_rows(lattice, begin, end));
  });
  beyond(other_sides);
}

/// What a chunk of soil points brings to the cells.
struct alignas(64) SoilContent {
  double volume[chunk_size];     // bulk, m³
  double half_edge[chunk_size];  // of the point's box, cells
  double solid[chunk_size], mass[chunk_size], linear[chunk_size], quadratic[chunk_size];
  double linear_up[chunk_size], quadratic_up[chunk_size];  // drag in the vertical, where it differs
  Vec4 horizontal[chunk_size];                             // solid, mass, linear, quadratic

  template <class Space>
  void compute(const Setup<Space>& setup, const GridFields<Space>& grid, const SoilPoints<Space>& soil,
               std::size_t first, int count, const ChunkWeights<Space>& chunk) {
    const auto& own = soil.material;
    const bool one = std::equal(own.begin() + first + 1, own.begin() + first + count, own.begin() + first);
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
    half_edges(volume, setup.lattice, chunk, count, half_edge);
    for (int l = 0; l < count; l += 4) {
      Vec4 a = load4(solid + l), b = load4(mass + l), c = load4(linear + l), d = load4(quadratic + l);
      transpose4(a, b, c, d);
      horizontal[l] = a;
      horizontal[l + 1] = b;
      horizontal[l + 2] = c;
      horizontal[l + 3] = d;
    }
  }
};

/// Half the edges of a chunk's boxes, in cells: as cubes, and along each axis where they are elongated.
template <class Space>
struct HalfEdges {
  const double* cube;
  std::array<const double*, static_cast<std::size_t>(Space::axes)> along;
};

/// add(cell index, share × content(point of the chunk)) for the cells that the points' boxes overlap. What is in a cell
/// that a body cuts counts for that cell; within `rim` of its edges, if not 0, for both: where points change all of
/// their content from one cell to the next as they cross, the volume correction sends them to and fro. Beside thin
/// walls boxes are cubes.
template <class Space, class Content, class Add>
void over_boxes(const Setup<Space>& setup, const std::array<Array, Space::axes>& position, const PhaseBox& box,
                std::size_t first, int count, const ChunkWeights<Space>& chunk, bool walled,
                const HalfEdges<Space>& half_edges, double rim_of_cut, Content content, Add add) {
  const auto& lattice = setup.lattice;
  if (!walled && !beside_bodies(setup.bodies, lattice, chunk, count)) {
    ChunkOverlap<Space> overlap;
    overlap.compute(lattice, pointers_at<Space>(position, first), half_edges.along, count, box.low, box.high);
    for (int l = 0; l < count; ++l) overlap.over_cells(lattice, l, content(l), add);
    return;
  }
  for (int l = 0; l < count; ++l) {
    const auto whole = content(l);
    const auto add_share = [&](std::ptrdiff_t cell, double share) {
      add(setup.bodies.open_neighbour(cell), share * whole);
    };
    const std::ptrdiff_t own = cell_index(lattice, chunk, l);
    const bool cut = setup.bodies.open_cell(own) < 1;
    if (cut && rim_of_cut == 0) {
      add_share(own, 1);
      continue;
    }
    const double most = cut ? rim_of_cut : 0.5;
    std::array<double, 3> x{0, 0, 0}, halves{0, 0, 0};
    for (int a = 0; a < Space::axes; ++a) {
      x[a] = position[a][first + static_cast<std::size_t>(l)];
      halves[a] = std::min(most, half_edges.along[a][l]);
    }
    if (walled)
      over_seen_cells(setup.walls, lattice, x, cell_places(chunk, l), std::min(most, half_edges.cube[l]), box.low,
                      box.high, add_share);
    else
      BoxOverlap<Space>(lattice, x, halves, box.low, box.high).over_cells(lattice, add_share);
  }
}

/// Water in the pores of the soil that the soil points carry: mass to the faces, volume to the cells.
template <class Space>
void carried_to_grid(const Setup<Space>& setup, const SoilPoints<Space>& soil, const Tiling<Space>& tiling,
                     GridFields<Space>& grid, Team& team) {
  const auto& lattice = setup.lattice;
  clear<Space>(lattice, grid.rows, setup.soil_box, {&grid.carried_mass}, team, [&](std::ptrdiff_t first, int count) {
    for (Array* field : {&grid.saturated_solid, &grid.carried_volume}) std::fill_n(field->begin() + first, count, 0.0);
  });
  over_chunks(tiling, team, [&](std::size_t first, int count) {
    ChunkWeights<Space> chunk;
    chunk.compute(lattice, pointers_at<Space>(soil.position, first), count);
    const bool walled = beside_walls(setup.walls, lattice, chunk, count);
    double mass[chunk_size], water[chunk_size], solid[chunk_size], half[chunk_size];
    for (int l = 0; l < count; ++l) {
      const std::size_t p = first + l;
      const double n = soil.porosity[p];
      const double bulk = bulk_volume(setup, soil, p);
      water[l] = soil.water[p];
      solid[l] = soil.saturated[p] ? (1 - n) * bulk : 0;
      mass[l] = setup.water.density * water[l];
      half[l] = half_edge<Space>(bulk, lattice.cell_volume(cell_places(chunk, l)));
    }
    HalfEdges<Space> half_edges{half, {}};
    half_edges.along.fill(half);
    const auto share_out = [&](const double* what, Array& field) {
      if (!walled && !beside_bodies(setup.bodies, lattice, chunk, count)) {
        for (int l = 0; l < count; ++l)
          BoxOverlap<Space>(lattice, position_of(soil, first + static_cast<std::size_t>(l)), half[l],
                            setup.soil_box.low, setup.soil_box.high)
              .over_cells(lattice, [&](std::ptrdiff_t cell, double share) { field[cell] += share * what[l]; });
        return;
      }
      over_boxes(
          setup, soil.position, setup.soil_box, first, count, chunk, walled, half_edges, 0,
          [&](int l) { return what[l]; }, [&](std::ptrdiff_t cell, double part) { field[cell] += part; });
    };
    share_out(water, grid.carried_volume);
    share_out(solid, grid.saturated_solid);
    over_components<Space>([&]<int c>() {
      if (!walled) return scatter_value<c>(lattice, chunk, mass, count, grid.carried_mass[c].data());
      for (int l = 0; l < count; ++l)
        over_seen_nodes<c>(setup.walls, lattice, chunk, l, [&](const SeenNode<Space>& node) {
          grid.carried_mass[c][node.at] += mass[l] * node.value();
        });
    });
  });
  for (int c = 0; c < Space::axes; ++c) fold(grid.carried_mass[c], c, false, setup.soil_box, lattice);
  for (Array* field : {&grid.saturated_solid, &grid.carried_volume}) join_ends(*field, setup.soil_box, lattice);
}

/// A cell that is just half full is dry, whatever the sums round to.
template <class Space>
bool is_wet(const Setup<Space>& setup, double fill) {
  return fill > setup.numerics.wet_threshold + 1e-9;
}

/// What the soil carries is in the cells beside the free water. Such soil ends where its grains do; free water is in
/// what is left of a cell.
template <class Space>
void fill_with_carried(const Setup<Space>& setup, GridFields<Space>& grid, Team& team) {
  over_cell_rows(setup.lattice, grid.rows, team, [&](std::ptrdiff_t first, int count, const std::array<int, 3>& place) {
    const RowVolume<Space> of_row(setup.lattice, place);
    for (std::ptrdiff_t cell = first; cell < first + count; ++cell) {
      const double whole = of_row(cell - first) * setup.bodies.open_cell(cell);
      const double carried = grid.carried_volume[cell], free = grid.water_volume[cell];
      if (whole <= 0 || carried == 0) continue;
      const double taken = (carried + grid.saturated_solid[cell]) / whole;
      const double pores = grid.cell_porosity[cell] * whole;
      grid.fill[cell] = taken < 1 - least_room && pores - carried > least_room * pores
                            ? taken + (1 - taken) * free / (pores - carried)
                            : taken + free / whole;
      grid.water_volume[cell] += carried;
      grid.wet[cell] = is_wet(setup, grid.fill[cell]);
    }
  });
}

}  // namespace

template <class Space>
void soil_to_grid(const Setup<Space>& setup, const SoilPoints<Space>& soil, const Tiling<Space>& tiling, double time,
                  GridFields<Space>& grid, Team& team) {
  const auto& lattice = setup.lattice;
  clear<Space>(lattice, grid.rows, setup.soil_box, {&grid.soil_mass, &grid.soil_velocity, &grid.soil_force}, team,
               [&](std::ptrdiff_t first, int count) {
                 std::fill_n(grid.soil_sums.begin() + 4 * first, 4 * count, 0.0);
                 for (auto* field : {&grid.linear_drag[1], &grid.quadratic_drag[1]})
                   if (setup.anisotropic) std::fill_n(field->begin() + first, count, 0.0);
               });

  over_chunks(tiling, team, [&](std::size_t first, int count) {
    const Upcoming<Space> upcoming(lattice, soil.home, first, count);
    upcoming.ask_for_points(soil.position, soil.velocity, soil.affine, soil.stress, soil.mass, soil.porosity);
    upcoming.template ask_for_grid<1>(lattice, grid.soil_mass, grid.soil_velocity, grid.soil_force);
    upcoming.template ask_for_grid<4>(lattice, grid.soil_sums);
    ChunkWeights<Space> chunk;
    chunk.compute(lattice, pointers_at<Space>(soil.position, first), count);
    const bool walled = beside_walls(setup.walls, lattice, chunk, count);
    SoilContent content;
    content.compute(setup, grid, soil, first, count, chunk);
    HalfEdges<Space> half_edges{content.half_edge, {}};
    half_edges.along.fill(content.half_edge);
    const auto share_out = [&](auto what, auto add) {
      over_boxes(setup, soil.position, setup.soil_box, first, count, chunk, walled, half_edges, 0, what, add);
    };
    const Vec4* horizontal = content.horizontal;
    share_out([horizontal](int l) { return horizontal[l]; },
              [sums = grid.soil_sums.data()](std::ptrdiff_t cell, Vec4 part) {
                store4(sums + 4 * cell, load4(sums + 4 * cell) + part);
              });
    if (setup.anisotropic) {
      share_out([&](int l) { return content.linear_up[l]; },
                [&](std::ptrdiff_t cell, double part) { grid.linear_drag[1][cell] += part; });
      share_out([&](int l) { return content.quadratic_up[l]; },
                [&](std::ptrdiff_t cell, double part) { grid.quadratic_drag[1][cell] += part; });
    }
    const double* volume = content.volume;
    double pressed[chunk_size];  // over which the stress acts: in a cell that a body cuts, as if it filled the cell
    if (setup.bodies.merges()) {
      for (int l = 0; l < count; ++l) {
        const double open = setup.bodies.own_share(cell_index(lattice, chunk, l));
        pressed[l] = open > 0 ? volume[l] / open : volume[l];
      }
      volume = pressed;
    }
    const double* mass = soil.mass.data() + first;
    const auto over = [&](int l, int) { return volume[l]; };
    over_components<Space>([&]<int c>() {
      double *masses = grid.soil_mass[c].data(), *momenta = grid.soil_velocity[c].data();
      double* forces = grid.soil_force[c].data();
      if (walled)
        return scatter_beside_walls<c, true>(setup.walls, lattice, soil, mass, over, first, count, chunk, masses,
                                             momenta, forces);
      Contribution<Space> contribution;
      contribution.template take_motion<c>(lattice, chunk, soil, mass, first, count);
      contribution.template take_force<c>(lattice, soil, volume, first, count);
      by_spacing(lattice, [&]<bool graded>() {
        scatter_component<c, true, graded>(lattice, chunk, contribution, count, masses, momenta, forces);
      });
    });
    press_loads(setup, soil, first, count, content.volume, time, grid.soil_force[Space::up].data());
  });

  const auto fold_back = [&](const MirrorShare& share) {
    for (int c = 0; c < Space::axes; ++c) {
      fold_motion(grid.soil_mass[c], grid.soil_velocity[c], c, setup.soil_box, lattice, share);
      release_forces(grid.soil_force[c], c, setup.soil_box, lattice, share);
      fold(grid.soil_force[c], c, true, setup.soil_box, lattice, share);
    }
  };
  const auto sum_up = [&](std::ptrdiff_t first, int count, const std::array<int, 3>& place) {
    const RowVolume<Space> volume(lattice, place);
    for (std::ptrdiff_t cell = first; cell < first + count; ++cell) {
      const double* sums = grid.soil_sums.data() + 4 * cell;
      grid.solid_volume[cell] = sums[0];
      grid.soil_cell_mass[cell] = sums[1];
      grid.linear_drag[0][cell] = sums[2];
      grid.quadratic_drag[0][cell] = sums[3];
      const double open = setup.bodies.open_cell(cell);
      grid.cell_porosity[cell] =
          open > 0 ? std::max(0.2, 1 - grid.solid_volume[cell] / (volume(cell - first) * open)) : 1;
    }
  };
  share_rows(grid.rows, team, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    fold_back(ends_of_rows(lattice, begin, end));
    visit_cell_rows(lattice, grid.rows, begin, end, sum_up);
  });
  fold_back(other_sides);
  for (Array* field : {&grid.solid_volume, &grid.soil_cell_mass, &grid.cell_porosity, &grid.linear_drag[0],
                       &grid.linear_drag[1], &grid.quadratic_drag[0], &grid.quadratic_drag[1]})
    join_ends(*field, setup.soil_box, lattice);
}

template <class Space>
void water_to_grid(const Setup<Space>& setup, const SoilPoints<Space>& soil, const Tiling<Space>& soil_tiling,
                   const WaterPoints<Space>& water, const Tiling<Space>& tiling, GridFields<Space>& grid, Team& team) {
  const auto& lattice = setup.lattice;
  clear<Space>(lattice, grid.rows, setup.water_box, {&grid.water_mass, &grid.water_velocity}, team,
               [&](std::ptrdiff_t first, int count) { std::fill_n(grid.water_volume.begin() + first, count, 0.0); });
  const double density = setup.water.density;
  const bool stretched = setup.stretches_water();
  if (setup.single_point) carried_to_grid(setup, soil, soil_tiling, grid, team);

  over_chunks(tiling, team, [&](std::size_t first, int count) {
    const Upcoming<Space> upcoming(lattice, water.home, first, count);
    upcoming.ask_for_points(water.position, water.velocity, water.affine, water.volume);
    upcoming.template ask_for_grid<1>(lattice, grid.water_mass, grid.water_velocity, grid.water_volume,
                                      grid.cell_porosity);
    ChunkWeights<Space> chunk;
    chunk.template compute<false>(lattice, pointers_at<Space>(water.position, first), count);
    const bool walled = beside_walls(setup.walls, lattice, chunk, count);
    const double* volume = water.volume.data() + first;
    double mass[chunk_size], half[chunk_size], elongated[Space::axes][chunk_size];
    double bulk[chunk_size];
    for (int l = 0; l < count; ++l) bulk[l] = grid.cell_porosity[cell_index(lattice, chunk, l)];
    for (int l = 0; l < count; ++l) {
      mass[l] = density * volume[l];
      bulk[l] = volume[l] / bulk[l];
    }
    polder::half_edges(bulk, lattice, chunk, count, half);
    for (int l = 0; l < count; ++l) half[l] = std::max(thinnest_cube, half[l]);
    HalfEdges<Space> half_edges{half, {}};
    for (int a = 0; a < Space::axes; ++a) {
      half_edges.along[a] = half;
      if (!stretched) continue;
      const double* elongation = water.elongation[a].data() + first;
      for (int l = 0; l < count; ++l) elongated[a][l] = std::max(thinnest_half, half[l] * (1 + elongation[l]));
      half_edges.along[a] = elongated[a];
    }
    over_boxes(
        setup, water.position, setup.water_box, first, count, chunk, walled, half_edges, rim,
        [volume](int l) { return volume[l]; },
        [sums = grid.water_volume.data()](std::ptrdiff_t cell, double part) { sums[cell] += part; });
    over_components<Space>([&]<int c>() {
      double *masses = grid.water_mass[c].data(), *momenta = grid.water_velocity[c].data();
      if (walled)
        return scatter_beside_walls<c, false>(setup.walls, lattice, water, mass, nullptr, first, count, chunk, masses,
                                              momenta, nullptr);
      Contribution<Space> contribution;
      contribution.template take_motion<c>(lattice, chunk, water, mass, first, count);
      by_spacing(lattice, [&]<bool graded>() {
        scatter_component<c, false, graded>(lattice, chunk, contribution, count, masses, momenta, nullptr);
      });
    });
  });

  const auto fold_back = [&](const MirrorShare& share) {
    for (int c = 0; c < Space::axes; ++c)
      fold_motion(grid.water_mass[c], grid.water_velocity[c], c, setup.water_box, lattice, share);
  };
  const auto look_for_water = [&](std::ptrdiff_t first, int count, const std::array<int, 3>& place) {
    const RowVolume<Space> of_row(lattice, place);
    for (std::ptrdiff_t cell = first; cell < first + count; ++cell) {
      const double open = setup.bodies.open_cell(cell), cell_volume = of_row(cell - first);
      grid.fill[cell] = open > 0 ? grid.water_volume[cell] / (grid.cell_porosity[cell] * cell_volume * open) : 0;
      grid.wet[cell] = is_wet(setup, grid.fill[cell]);
    }
  };
  share_rows(grid.rows, team, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    fold_back(ends_of_rows(lattice, begin, end));
    visit_cell_rows(lattice, grid.rows, begin, end, look_for_water);
  });
  fold_back(other_sides);
  if (setup.single_point) fill_with_carried(setup, grid, team);
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
