#include "polder/step/unsaturated_transfer.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "polder/step/chunk_loop.hpp"
#include "polder/step/cut_cells.hpp"
#include "polder/step/gather.hpp"
#include "polder/step/groups.hpp"
#include "polder/step/leave_body.hpp"
#include "polder/step/loads.hpp"
#include "polder/step/pore_curves.hpp"
#include "polder/step/soil_stress.hpp"
#include "polder/step/soil_volume.hpp"
#include "polder/step/unsaturated_scatter.hpp"
#include "polder/step/unsaturated_step.hpp"

namespace polder {

template <class Space>
std::array<double, 3> box_half(const Setup<Space>& setup, const SoilPoints<Space>& soil, std::size_t p) {
  const auto& lattice = setup.lattice;
  const SoilMaterial& material = setup.materials[soil.material[p]];
  const double volume = soil.mass[p] / (material.grain_density * (1 - material.initial_porosity));
  const std::array<int, 3> from = lattice.graded ? cell_of(lattice, reference_of(soil, p)) : std::array<int, 3>{};
  const double half = half_edge<Space>(volume, lattice.cell_volume(from));
  std::array<double, 3> halves{half, half, half};
  if (lattice.graded) {
    const std::array<int, 3> now = cell_of(lattice, position_of(soil, p));
    for (int a = 0; a < Space::axes; ++a) halves[a] *= lattice.axis[a].width(from[a]) / lattice.axis[a].width(now[a]);
  }
  for (double& h : halves) h = std::min(0.5, h);
  return halves;
}

namespace {

/// box_half() of a chunk, by axis.
template <class Space>
void box_halves(const Setup<Space>& setup, const SoilPoints<Space>& soil, std::size_t first, int count,
                double (&half)[Space::axes][chunk_size]) {
  if (setup.lattice.graded) {
    for (int l = 0; l < count; ++l) {
      const std::array<double, 3> halves = box_half(setup, soil, first + static_cast<std::size_t>(l));
      for (int a = 0; a < Space::axes; ++a) half[a][l] = halves[a];
    }
    return;
  }
  const double whole = setup.lattice.cell_volume();
  for (int l = 0; l < count; ++l) {
    const std::size_t p = first + static_cast<std::size_t>(l);
    const SoilMaterial& material = setup.materials[soil.material[p]];
    half[0][l] = soil.mass[p] / (material.grain_density * (1 - material.initial_porosity));
  }
  for (int l = 0; l < count; ++l) half[0][l] = std::min(0.5, half_edge<Space>(half[0][l], whole));
  for (int a = 1; a < Space::axes; ++a) std::copy_n(half[0], count, half[a]);
}

/// Of a periodic model: what points have given to cells beyond its ends is for those inside, and seen from both sides.
template <class Space>
void fold_ends(const Setup<Space>& setup, Array& cells) {
  fold(cells, -1, false, setup.soil_box, setup.lattice);
  join_ends(cells, setup.soil_box, setup.lattice);
}

/// Volumes of a chunk's points with their porosities as they are.
template <class Space>
void set_volumes(const Setup<Space>& setup, const SoilPoints<Space>& soil, std::size_t first, int count,
                 PoreFields<Space>& pores) {
  for (std::size_t p = first; p < first + static_cast<std::size_t>(count); ++p)
    pores.volume[p] = bulk_volume(setup, soil, p);
}

}  // namespace

template <class Space>
void mixture_to_grid(const Setup<Space>& setup, const SoilPoints<Space>& soil, const Tiling<Space>& tiling,
                     InertiaRule inertia, double gravity_factor, double time, GridFields<Space>& grid,
                     PoreFields<Space>& pores, Team& team) {
  const auto& lattice = setup.lattice;
  const double down = -setup.pull(Space::up) * gravity_factor, along = setup.pull(0) * gravity_factor;
  for (auto* fields : {&grid.soil_mass, &grid.soil_velocity, &grid.soil_force, &pores.weight, &pores.held_mass})
    for (auto& field : *fields) std::fill(field.begin(), field.end(), 0.0);
  for (auto* field : {&pores.sums, &pores.resistance[1]}) std::fill(field->begin(), field->end(), 0.0);

  pores.box.resize(setup, soil.size());
  pores.inertia.resize(soil.size());
  pores.volume.resize(soil.size());
  const NeededInertia<Space> needed(lattice, inertia.step);
  over_chunks(tiling, team, [&](std::size_t first, int count) {
    ChunkWeights<Space> chunk;
    chunk.compute(lattice, pointers_at<Space>(soil.position, first), count);
    use_cell_differences(lattice, chunk, count);
    MixtureLoad<Space::axes> load;
    double yielding[chunk_size], half[Space::axes][chunk_size];
    set_volumes(setup, soil, first, count, pores);
    const double* bulk = pores.volume.data() + first;
    bool any_held = false;
    const bool walled = beside_walls(setup.walls, lattice, chunk, count);
    box_halves(setup, soil, first, count, half);
    pores.box.set(setup, soil.position, first, count, half);
    for (int l = 0; l < count; ++l) {
      const std::size_t p = first + static_cast<std::size_t>(l);
      const SoilMaterial& material = setup.materials[soil.material[p]];
      const double volume = bulk[l], mass = soil.mass[p] + setup.water.density * soil.water[p];
      for (int a = 0; a < Space::axes; ++a)
        load.volume[a][l] = volume * pressing_part(setup.bodies, lattice, a, cell_index(lattice, chunk, l));
      load.weight[l] = down * mass;
      load.along[l] = along * mass;
      load.inertia[l] = pores.inertia[p] = std::max(
          inertia.scaling * mass, needed(cell_places(chunk, l), volume, setup.pores[soil.material[p]].modulus));
      load.held[l] = material.fixed ? load.inertia[l] : 0;
      any_held = any_held || material.fixed;
      yielding[l] = material.fixed ? 0 : volume;
      const Vec4 content{volume, yielding[l], soil.water[p],
                         volume * linear_resistance(material.drag[0], soil.porosity[p])};
      double* sums = pores.sums.data();
      pores.box.over_cells(lattice, p, [&](std::ptrdiff_t cell, double share) {
        store4(sums + 4 * cell, load4(sums + 4 * cell) + share * content);
      });
      if (!setup.anisotropic) continue;
      const double upright = volume * linear_resistance(material.drag[1], soil.porosity[p]);
      pores.box.over_cells(lattice, p,
                           [&](std::ptrdiff_t cell, double share) { pores.resistance[1][cell] += share * upright; });
    }
    over_components<Space>([&]<int c>() {
      double* held = any_held ? pores.held_mass[c].data() : nullptr;
      if (walled) scatter_beside<c>(setup, soil, load, first, count, chunk, grid, held);
      by_spacing(lattice, [&]<bool graded>() {
        const bool leans = c == 0 && along != 0;
        if (!walled && leans) scatter_mixture<c, graded, c == 0>(lattice, soil, load, first, count, chunk, grid, held);
        if (!walled && !leans) scatter_mixture<c, graded, false>(lattice, soil, load, first, count, chunk, grid, held);
        scatter_weight<c, graded>(setup, yielding, count, chunk, pores.weight[c].data());
      });
    });
    press_loads(setup, soil, first, count, bulk, time, grid.soil_force[Space::up].data());
  });
  for (std::ptrdiff_t cell = 0; cell < lattice.size; ++cell) {
    const double* sums = pores.sums.data() + 4 * cell;
    pores.bulk[cell] = sums[0];
    pores.yielding[cell] = sums[1];
    pores.water[cell] = sums[2];
    pores.resistance[0][cell] = sums[3];
  }
  if (setup.periodic)
    for (Array* field : {&pores.bulk, &pores.yielding, &pores.water, &pores.resistance[0]}) fold_ends(setup, *field);
  if (setup.anisotropic && setup.periodic) fold_ends(setup, pores.resistance[1]);
  if (!setup.anisotropic) pores.resistance[1] = pores.resistance[0];
  for (int c = 0; c < Space::axes; ++c) {
    fold(pores.held_mass[c], c, false, setup.soil_box, lattice);
    fold_motion(grid.soil_mass[c], grid.soil_velocity[c], c, setup.soil_box, lattice);
    release_forces(grid.soil_force[c], c, setup.soil_box, lattice);
    fold(grid.soil_force[c], c, true, setup.soil_box, lattice);
    fold(pores.weight[c], -1, false, setup.soil_box, lattice);
    join_ends(pores.weight[c], setup.soil_box, lattice);
  }
  pores_to_grid(setup, soil, tiling, pores, team);
}

template <class Space>
void bulk_to_faces(const Setup<Space>& setup, const SoilPoints<Space>& soil, const Tiling<Space>& tiling,
                   PoreFields<Space>& pores, Team& team) {
  constexpr int up = Space::up;
  const auto& lattice = setup.lattice;
  std::fill(pores.face_bulk.begin(), pores.face_bulk.end(), 0.0);
  double* field = pores.face_bulk.data();
  over_chunks(tiling, team, [&](std::size_t first, int count) {
    ChunkWeights<Space> chunk;
    chunk.compute(lattice, pointers_at<Space>(soil.position, first), count);
    const bool walled = beside_walls(setup.walls, lattice, chunk, count);
    for (int l = 0; l < count; ++l) {
      const std::size_t p = first + static_cast<std::size_t>(l);
      if (setup.materials[soil.material[p]].fixed) continue;
      const double volume = pores.volume[p];
      if (walled) {
        over_seen_nodes<up>(setup.walls, lattice, chunk, l,
                            [&](const SeenNode<Space>& node) { field[node.at] += volume * node.value(); });
        continue;
      }
      const Vec4 row = volume * x_row<up>(chunk, l).weight;
      double* base = field + stencil_base<up>(chunk, l);
      over_rows<up>(chunk, lattice.stride, l, [&](std::ptrdiff_t at, double wy, double, double wz, auto...) {
        store4(base + at, load4(base + at) + (wy * wz) * row);
      });
    }
  });
  fold(pores.face_bulk, up, false, setup.soil_box, lattice);
}

template <class Space>
void pores_to_grid(const Setup<Space>& setup, const SoilPoints<Space>& soil, const Tiling<Space>& tiling,
                   PoreFields<Space>& pores, Team& team) {
  for (auto& field : pores.composition) std::fill(field.begin(), field.end(), 0.0);
  over_chunks(tiling, team, [&](std::size_t first, int count) {
    for (std::size_t p = first; p < first + static_cast<std::size_t>(count); ++p) {
      const double volume = soil.porosity[p] * pores.volume[p];
      Array& field = pores.composition[soil.material[p]];
      pores.box.over_cells(setup.lattice, p, [&](std::ptrdiff_t cell, double share) { field[cell] += share * volume; });
    }
  });
  for (std::size_t m = 0; setup.periodic && m < pores.composition.size(); ++m) fold_ends(setup, pores.composition[m]);
  pores.pores = pores.composition.front();
  for (std::size_t m = 1; m < pores.composition.size(); ++m)
    for (std::size_t cell = 0; cell < pores.pores.size(); ++cell) pores.pores[cell] += pores.composition[m][cell];
}

namespace {

/// Rates of strain across the surface of a body: of what it leaves of a cell. Soil in a cell that counts as covered
/// stretches with that of the cell to which it belongs.
template <class Space>
void strain_beside_bodies(const Setup<Space>& setup, const GridFields<Space>& grid, const ChunkWeights<Space>& chunk,
                          std::size_t first, int count, PoreFields<Space>& pores) {
  const auto& lattice = setup.lattice;
  for (int l = 0; l < count; ++l) {
    const std::ptrdiff_t own = cell_index(lattice, chunk, l);
    if (!setup.bodies.near(own)) continue;
    const bool covered = setup.bodies.covered(own);
    const std::ptrdiff_t cell = covered ? setup.bodies.open_neighbour(own) : own;
    for (int a = 0; a < Space::axes; ++a) {
      double& rate = pores.gradient[a * Space::axes + a][first + static_cast<std::size_t>(l)];
      const double across = lies_across(setup.bodies, lattice, a, cell);
      if (across == 0) continue;
      if (covered)
        rate += across * ((grid.soil_velocity[a][cell + lattice.stride[a]] - grid.soil_velocity[a][cell]) /
                              lattice.axis[a].width(lattice.place(cell, a)) -
                          rate);
      rate /= thickness(setup.bodies, lattice, a, cell, setup.bodies.open_cell(cell));
    }
  }
}

/// Gathers velocities and rates of strain; a point's own dilation goes to the cells that it counts for.
template <class Space>
Motion gather_rates(const Setup<Space>& setup, const GridFields<Space>& grid, const Tiling<Space>& tiling,
                    SoilPoints<Space>& soil, PoreFields<Space>& pores, Team& team) {
  const auto& lattice = setup.lattice;
  Motion motion;
  std::mutex mutex;  // a maximum does not depend on the order
  over_chunks(tiling, team, [&](std::size_t first, int count) {
    ChunkWeights<Space> chunk;
    chunk.compute_places(lattice, pointers_at<Space>(soil.position, first), count);
    const bool walled = beside_walls(setup.walls, lattice, chunk, count);
    Gathered<Space> gathered;
    double gradient[Space::axes][chunk_room];
    double speed = 0;
    over_components<Space>([&]<int c>() {
      if (walled)
        gather_beside_walls<c, true, true>(setup.walls, lattice, chunk, count, grid.soil_velocity[c].data(), gathered,
                                           gradient);
      else
        by_spacing(lattice, [&]<bool graded>() {
          gather_component<c, true, graded, true>(lattice, chunk, count, grid.soil_velocity[c].data(), gathered,
                                                  gradient);
        });
      take_motion<c>(lattice, chunk, gathered, first, count, soil);
      for (int l = 0; l < count; ++l) {
        const std::size_t p = first + static_cast<std::size_t>(l);
        speed = std::max(speed, std::abs(gathered.value[l]) / lattice.spacing[c]);
        for (int a = 0; a < Space::axes; ++a) pores.gradient[c * Space::axes + a][p] = gradient[a][l];
      }
    });
    if (setup.bodies.any()) strain_beside_bodies(setup, grid, chunk, first, count, pores);
    for (std::size_t p = first; p < first + static_cast<std::size_t>(count); ++p) {
      double own = 0;
      for (int a = 0; a < Space::axes; ++a) own += pores.gradient[a * Space::axes + a][p];
      if (setup.materials[soil.material[p]].fixed) own = 0;
      pores.dilation[p] = (1 - setup.numerics.fbar) * own;
    }
    const std::lock_guard lock(mutex);
    motion.take({.speed = speed});
  });
  return motion;
}

/// Adds to the points' dilations, by the cells that they count for, what these lack of their own change of volume.
template <class Space>
void correct_dilation(const Setup<Space>& setup, const Tiling<Space>& tiling, const SoilPoints<Space>& soil,
                      PoreFields<Space>& pores, Team& team) {
  const auto& lattice = setup.lattice;
  const auto yields = [&](std::size_t p) { return !setup.materials[soil.material[p]].fixed; };
  std::fill(pores.points_change.begin(), pores.points_change.end(), 0.0);
  over_chunks(tiling, team, [&](std::size_t first, int count) {
    for (std::size_t p = first; p < first + static_cast<std::size_t>(count); ++p) {
      if (!yields(p)) continue;
      const double change = pores.volume[p] * pores.dilation[p];
      pores.box.over_cells(lattice, p,
                           [&](std::ptrdiff_t cell, double share) { pores.points_change[cell] += share * change; });
    }
  });
  if (setup.periodic) fold_ends(setup, pores.points_change);
  const double thin = 0.05;  // of a cell's volume
  for (std::size_t cell = 0; cell < pores.bulk.size(); ++cell)
    pores.correction[cell] =
        pores.yielding[cell] > 0 && pores.yielding[cell] > thin * lattice.cell_volume(static_cast<std::ptrdiff_t>(cell))
            ? (pores.volume_change[cell] - pores.points_change[cell]) / pores.yielding[cell]
            : 0;
  join_ends(pores.correction, setup.soil_box, lattice);
  over_chunks(tiling, team, [&](std::size_t first, int count) {
    for (std::size_t p = first; p < first + static_cast<std::size_t>(count); ++p) {
      if (!yields(p)) continue;
      double add = 0;
      pores.box.over_cells(lattice, p,
                           [&](std::ptrdiff_t cell, double share) { add += share * pores.correction[cell]; });
      pores.dilation[p] += add;
    }
  });
}

/// Points whose grains are out of contact come back to the porosity of the grid where that is denser. Where a cell is
/// not full, at a surface, the grid says more than there is.
template <class Space>
void relax_porosities(const Setup<Space>& setup, const PoreFields<Space>& pores, std::size_t first, int count,
                      SoilPoints<Space>& soil) {
  for (std::size_t p = first; p < first + static_cast<std::size_t>(count); ++p) {
    if (!soil.fluid[p]) continue;
    double grains = 0;
    pores.box.over_cells(setup.lattice, p, [&](std::ptrdiff_t cell, double share) {
      grains += share * (pores.bulk[cell] - pores.pores[cell]) / setup.lattice.cell_volume(cell);
    });
    soil.porosity[p] = std::min(soil.porosity[p], relaxed_porosity(soil.porosity[p], 1 - grains,
                                                                   setup.materials[soil.material[p]].max_porosity));
  }
}

}  // namespace

template <class Space>
Motion strain_points(const Setup<Space>& setup, double dt, const GridFields<Space>& grid, const Tiling<Space>& tiling,
                     SoilPoints<Space>& soil, PoreFields<Space>& pores, Team& team) {
  for (auto& g : pores.gradient) g.resize(soil.size());
  pores.dilation.resize(soil.size());
  pores.pore_volume.resize(soil.size());
  Motion motion = gather_rates(setup, grid, tiling, soil, pores, team);
  for (int pass = 0; pass < dilation_passes; ++pass) correct_dilation(setup, tiling, soil, pores, team);
  over_ranges(tiling.in_order, team, [&](const TileRange& range) {
    over_whole_groups(soil, range, [&](std::size_t first, int count) {
      VelocityGradients<Space> gradients;
      for (int c = 0; c < Space::axes; ++c)
        for (int a = 0; a < Space::axes; ++a)
          std::copy_n(pores.gradient[c * Space::axes + a].data() + first, count, gradients.at[c][a]);
      for (std::size_t p = first; p < first + static_cast<std::size_t>(count); ++p)
        pores.pore_volume[p] = soil.porosity[p] * pores.volume[p];
      double plastic_shear[chunk_size];
      update_soil(setup, dt, first, count, gradients, pores.dilation.data() + first, soil, plastic_shear);
      mix_porosities(plastic_shear, first, count, soil);
      relax_porosities(setup, pores, first, count, soil);
      set_volumes(setup, soil, first, count, pores);
    });
  });
  motion.drift = motion.speed * dt;
  return motion;
}

namespace {

constexpr double uneven = 0.01;  // of the pores: so differently may the points of a cell be filled

/// Gives the points what their cells gained, Δ(n V S(p)(1 + p/K)) + n V surplus. Where the points of a cell hold uneven
/// shares of its water and it moves, they even out by the way that it goes.
template <class Space>
void change_water(const Setup<Space>& setup, const Tiling<Space>& tiling, PoreFields<Space>& pores,
                  SoilPoints<Space>& soil, Team& team) {
  // body(cell, share, water by its own history, water as the cell's mean has it)
  const auto over_shares = [&](std::size_t p, auto&& body) {
    const Array &ratio = pores.ratio[soil.material[p]], &ratio_before = pores.ratio_before[soil.material[p]];
    const double before = pores.pore_volume[p], now = soil.porosity[p] * pores.volume[p];
    pores.box.over_cells(setup.lattice, p, [&](std::ptrdiff_t cell, double share) {
      if (share == 0) return;
      const double filled = ratio[cell];
      const double own = soil.water[p] + now * (filled + pores.surplus[cell]) - before * ratio_before[cell];
      body(cell, share, own, now * (filled + pores.deviation[cell]));
    });
  };
  std::fill(pores.mixing.begin(), pores.mixing.end(), 0.0);
  over_chunks(tiling, team, [&](std::size_t first, int count) {
    for (std::size_t p = first; p < first + static_cast<std::size_t>(count); ++p)
      over_shares(p, [&](std::ptrdiff_t cell, double share, double own, double mean) {
        pores.mixing[cell] += share * std::abs(own - mean);
      });
  });
  if (setup.periodic) fold_ends(setup, pores.mixing);
  for (std::size_t cell = 0; cell < pores.mixing.size(); ++cell)
    pores.mixing[cell] = pores.mixing[cell] > uneven * pores.pores[cell] ? pores.way[cell] : 0;
  join_ends(pores.mixing, setup.soil_box, setup.lattice);
  over_chunks(tiling, team, [&](std::size_t first, int count) {
    for (std::size_t p = first; p < first + static_cast<std::size_t>(count); ++p) {
      double water = 0;
      over_shares(p, [&](std::ptrdiff_t cell, double share, double own, double mean) {
        water += share * (own + pores.mixing[cell] * (mean - own));
      });
      soil.water[p] = water;
    }
  });
}

}  // namespace

template <class Space>
void move_points(const Setup<Space>& setup, double dt, const Tiling<Space>& tiling, PoreFields<Space>& pores,
                 SoilPoints<Space>& soil, Team& team) {
  const auto& lattice = setup.lattice;
  change_water(setup, tiling, pores, soil, team);
  std::array<double, 3> lowest{}, highest{};
  for (int a = 0; a < Space::axes;
       ++a) {  // points may pass the ends of a periodic model, to be brought in at the other
    const double gap = setup.soil_box.periodic(a) ? -1 : wall_gap;
    lowest[a] = lattice.axis[a].at_place(setup.soil_box.low[a] + gap);
    highest[a] = lattice.axis[a].at_place(setup.soil_box.high[a] - gap);
  }
  over_chunks(tiling, team, [&](std::size_t first, int count) {
    for (std::size_t p = first; p < first + static_cast<std::size_t>(count); ++p) {
      if (setup.materials[soil.material[p]].fixed) continue;
      const std::array<double, 3> from = position_of(soil, p);
      for (int a = 0; a < Space::axes; ++a)
        soil.position[a][p] = std::clamp(from[a] + dt * soil.velocity[a][p], lowest[a], highest[a]);
      if (setup.bodies.any()) {
        const auto cell = cell_of(lattice, position_of(soil, p));
        if (setup.bodies.near(lattice.index(cell[0], cell[1], cell[2]))) leave_body(setup, setup.soil_box, dt, p, soil);
      }
      if (setup.walls.any()) {
        std::array<double, 3> to = position_of(soil, p);
        stop_at_walls(lattice, setup.walls, from, to);
        for (int a = 0; a < Space::axes; ++a) soil.position[a][p] = to[a];
      }
    }
  });
}

#define POLDER_UNSATURATED_TRANSFER(Space)                                                                             \
  template std::array<double, 3> box_half(const Setup<Space>&, const SoilPoints<Space>&, std::size_t);                 \
  template void mixture_to_grid(const Setup<Space>&, const SoilPoints<Space>&, const Tiling<Space>&, InertiaRule,      \
                                double, double, GridFields<Space>&, PoreFields<Space>&, Team&);                        \
  template Motion strain_points(const Setup<Space>&, double, const GridFields<Space>&, const Tiling<Space>&,           \
                                SoilPoints<Space>&, PoreFields<Space>&, Team&);                                        \
  template void pores_to_grid(const Setup<Space>&, const SoilPoints<Space>&, const Tiling<Space>&, PoreFields<Space>&, \
                              Team&);                                                                                  \
  template void bulk_to_faces(const Setup<Space>&, const SoilPoints<Space>&, const Tiling<Space>&, PoreFields<Space>&, \
                              Team&);                                                                                  \
  template void move_points(const Setup<Space>&, double, const Tiling<Space>&, PoreFields<Space>&, SoilPoints<Space>&, \
                            Team&);
POLDER_UNSATURATED_TRANSFER(PlaneStrain)
POLDER_UNSATURATED_TRANSFER(Solid)
#undef POLDER_UNSATURATED_TRANSFER

}  // namespace polder
