#include "polder/step/unsaturated_transfer.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "polder/step/chunk_loop.hpp"
#include "polder/step/gather.hpp"
#include "polder/step/leave_body.hpp"
#include "polder/step/loads.hpp"
#include "polder/step/pore_curves.hpp"
#include "polder/step/soil_stress.hpp"
#include "polder/step/soil_volume.hpp"
#include "polder/step/unsaturated_step.hpp"

namespace polder {

namespace {

/// The cells that a point counts for.
template <class Space>
PointCells<Space> box_of(const Setup<Space>& setup, const SoilPoints<Space>& soil, std::size_t p) {
  return {setup, position_of(soil, p), box_half(setup, soil, p)};
}

/// Of the four nodes of a row of faces, the lower one of the point's own cell: 0 or 1.
inline int own_face(double delta) { return delta < 0 ? 0 : 1; }

/// Derivatives along a component's own axis (but x, whose rows are made where they are used) as cell differences.
template <class Space>
void use_cell_differences(ChunkWeights<Space>& chunk, int count) {
  for (int a = 1; a < Space::axes; ++a)
    for (int l = 0; l < count; ++l) {
      const int o = own_face(chunk.delta[a][1][l]);
      for (int i = 0; i < 3; ++i) chunk.derivative[a][1][i][l] = i == o ? -1 : i == o + 1 ? 1 : 0;
    }
}

/// The difference between the faces of a point's own cell, in a row that starts one cell before.
constexpr Vec4 difference_row{0, -1, 1, 0};

/// What a point brings to the faces.
struct Load {
  double inertia[chunk_size], weight[chunk_size], held[chunk_size];
  double volume[chunk_size];  // over which the stress acts: in a cell that a body cuts, as if it filled the cell
};

/// scatter_component() beside thin walls.
// NOLINTBEGIN(readability-non-const-parameter): written in the lambda
template <int c, class Space>
void scatter_beside(const Setup<Space>& setup, const SoilPoints<Space>& points, const Load& load, std::size_t first,
                    int count, const ChunkWeights<Space>& chunk, GridFields<Space>& grid, double* held_field) {
  double* force_field = grid.soil_force[c].data();
  scatter_beside_walls<c, true, true>(setup.walls, setup.lattice, points, load.inertia, load.volume, first, count,
                                      chunk, grid.soil_mass[c].data(), grid.soil_velocity[c].data(), force_field);
  for (int l = 0; l < count; ++l)
    over_seen_nodes<c>(setup.walls, setup.lattice, chunk, l, [&](const SeenNode<Space>& node) {
      if (held_field) held_field[node.at] += load.held[l] * node.value();
      if (c == Space::up) force_field[node.at] -= node.sign * load.weight[l] * node.value();
    });
}
// NOLINTEND(readability-non-const-parameter)

template <int c, class Space>
void scatter_component(const Lattice<Space>& lattice, const SoilPoints<Space>& points, const Load& load,
                       std::size_t first, int count, const ChunkWeights<Space>& chunk, GridFields<Space>& grid,
                       double* held_field) {
  constexpr int axes = Space::axes;
  const auto& h = lattice.spacing;
  double* mass_field = grid.soil_mass[c].data();
  double* momentum_field = grid.soil_velocity[c].data();
  double* force_field = grid.soil_force[c].data();
  for (int l = 0; l < count; ++l) {
    const std::size_t p = first + static_cast<std::size_t>(l);
    const double m = load.inertia[l], v = -load.volume[l];
    const SplineRow row = x_row<c>(chunk, l);
    const Vec4 slope = c == 0 ? difference_row : row.derivative;
    const auto affine = [&](int a) { return points.affine[c * axes + a][p]; };
    const auto stress = [&](int a) { return points.stress[stress_index<Space>(c, a)][p]; };
    const Vec4 mass_row = m * row.weight, held_row = load.held[l] * row.weight;
    const Vec4 momentum_row = (m * points.velocity[c][p]) * row.weight + (m * h[0] * affine(0)) * row.offset;
    const Vec4 momentum_y = (m * h[1] * affine(1)) * row.weight;
    Vec4 force_row = (v * stress(0) / h[0]) * slope;
    if (c == Space::up) force_row -= load.weight[l] * row.weight;
    const Vec4 force_y = (v * stress(1) / h[1]) * row.weight;
    Vec4 momentum_z{}, force_z{};
    if constexpr (axes == 3) {
      momentum_z = (m * h[2] * affine(axes - 1)) * row.weight;
      force_z = (v * stress(axes - 1) / h[2]) * row.weight;
    }
    const std::ptrdiff_t base = stencil_base<c>(chunk, l);
    over_rows<c>(chunk, lattice.stride, l,
                 [&](std::ptrdiff_t at, double wy, double oy, double dy, double wz, double oz, double dz) {
                   const std::ptrdiff_t node = base + at;
                   store4(mass_field + node, load4(mass_field + node) + (wy * wz) * mass_row);
                   if (held_field) store4(held_field + node, load4(held_field + node) + (wy * wz) * held_row);
                   Vec4 q = load4(momentum_field + node) + (wy * wz) * momentum_row + (oy * wz) * momentum_y;
                   Vec4 f = load4(force_field + node) + (wy * wz) * force_row + (dy * wz) * force_y;
                   if constexpr (axes == 3) {
                     q += (wy * oz) * momentum_z;
                     f += (wy * dz) * force_z;
                   }
                   store4(momentum_field + node, q);
                   store4(force_field + node, f);
                 });
  }
}

/// A point's volume to the cells of its own layer along axis c, by centre splines across: the volume over which the
/// cell difference of component c is taken.
template <int c, class Space>
void scatter_weight(const Setup<Space>& setup, const double* volume, int count, const ChunkWeights<Space>& chunk,
                    double* field) {
  const auto& lattice = setup.lattice;
  for (int l = 0; l < count; ++l) {
    if (volume[l] == 0) continue;
    const std::ptrdiff_t cell = cell_index(lattice, chunk, l);
    if (const WallStencil<Space>* stencil = setup.walls.beside(cell); stencil != nullptr) {
      for (int k = Space::axes == 3 ? -1 : 0; k <= (Space::axes == 3 ? 1 : 0); ++k)
        for (int j = -1; j <= 1; ++j)
          for (int i = -1; i <= 1; ++i) {
            const int o[3] = {i, j, k};
            double w = volume[l];
            for (int a = 0; a < Space::axes; ++a) {
              double weight[3], offset[3], derivative[3];
              spline_weights(chunk.delta[a][0][l], weight, offset, derivative);
              w *= a == c ? (o[a] == 0 ? 1.0 : 0.0) : weight[o[a] + 1];
            }
            const int number = (i + 1) + 3 * (j + 1) + (Space::axes == 3 ? 9 * (k + 1) : 0);
            field[cell + stencil->cell[static_cast<std::size_t>(number)]] += w;
          }
      continue;
    }
    constexpr Vec4 own{0, 1, 0, 0};
    const Vec4 row = volume[l] * (c == 0 ? own : centre_row(chunk.delta[0][0][l]).weight);
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

}  // namespace

template <class Space>
double box_half(const Setup<Space>& setup, const SoilPoints<Space>& soil, std::size_t p) {
  const SoilMaterial& material = setup.materials[soil.material[p]];
  const double volume = soil.mass[p] / (material.grain_density * (1 - material.initial_porosity));
  return std::min(0.5, half_edge<Space>(volume, setup.lattice.cell_volume()));
}

template <class Space>
void mixture_to_grid(const Setup<Space>& setup, const SoilPoints<Space>& soil, const Tiling<Space>& tiling,
                     InertiaRule inertia, double gravity, double time, GridFields<Space>& grid,
                     PoreFields<Space>& pores, Team& team) {
  const auto& lattice = setup.lattice;
  for (auto* fields : {&grid.soil_mass, &grid.soil_velocity, &grid.soil_force, &pores.weight, &pores.held_mass})
    for (auto& field : *fields) std::fill(field.begin(), field.end(), 0.0);
  for (auto* field : {&pores.sums, &pores.resistance[1]}) std::fill(field->begin(), field->end(), 0.0);

  pores.box.resize(soil.size());
  over_chunks(tiling, team, [&](std::size_t first, int count) {
    ChunkWeights<Space> chunk;
    chunk.compute(lattice, pointers_at<Space>(soil.position, first), count);
    use_cell_differences(chunk, count);
    Load load;
    double yielding[chunk_size], bulk[chunk_size];
    bool any_held = false;
    const bool walled = beside_walls(setup.walls, lattice, chunk, count);
    for (int l = 0; l < count; ++l) {
      const std::size_t p = first + static_cast<std::size_t>(l);
      const SoilMaterial& material = setup.materials[soil.material[p]];
      const double volume = bulk_volume(setup, soil, p), mass = soil.mass[p] + setup.water.density * soil.water[p];
      const double stretched = inertia.step / (difference_cfl * lattice.smallest_spacing());
      bulk[l] = volume;
      const double open = setup.bodies.own_share(cell_index(lattice, chunk, l));
      load.volume[l] = open > 0 ? volume / open : volume;
      load.weight[l] = gravity * mass;
      load.inertia[l] =
          std::max(inertia.scaling * mass, volume * setup.pores[soil.material[p]].modulus * stretched * stretched);
      load.held[l] = material.fixed ? load.inertia[l] : 0;
      any_held = any_held || material.fixed;
      yielding[l] = material.fixed ? 0 : volume;
      const Vec4 content{volume, yielding[l], soil.water[p],
                         volume * linear_resistance(material.drag[0], soil.porosity[p])};
      double* sums = pores.sums.data();
      pores.box[p] = box_of(setup, soil, p);
      pores.box[p].over_cells(lattice, [&](std::ptrdiff_t cell, double share) {
        store4(sums + 4 * cell, load4(sums + 4 * cell) + share * content);
      });
      if (!setup.anisotropic) continue;
      const double upright = volume * linear_resistance(material.drag[1], soil.porosity[p]);
      pores.box[p].over_cells(lattice,
                              [&](std::ptrdiff_t cell, double share) { pores.resistance[1][cell] += share * upright; });
    }
    over_components<Space>([&]<int c>() {
      double* held = any_held ? pores.held_mass[c].data() : nullptr;
      if (walled)
        scatter_beside<c>(setup, soil, load, first, count, chunk, grid, held);
      else
        scatter_component<c>(lattice, soil, load, first, count, chunk, grid, held);
      scatter_weight<c>(setup, yielding, count, chunk, pores.weight[c].data());
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
  if (!setup.anisotropic) pores.resistance[1] = pores.resistance[0];
  for (int c = 0; c < Space::axes; ++c) {
    fold(grid.soil_mass[c], c, false, setup.soil_box, lattice);
    fold(pores.held_mass[c], c, false, setup.soil_box, lattice);
    fold(grid.soil_velocity[c], c, true, setup.soil_box, lattice);
    fold(grid.soil_force[c], c, true, setup.soil_box, lattice);
    fold(pores.weight[c], -1, false, setup.soil_box, lattice);
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
      const double volume = bulk_volume(setup, soil, p);
      if (walled) {
        over_seen_nodes<up>(setup.walls, lattice, chunk, l,
                            [&](const SeenNode<Space>& node) { field[node.at] += volume * node.value(); });
        continue;
      }
      const Vec4 row = volume * x_row<up>(chunk, l).weight;
      double* base = field + stencil_base<up>(chunk, l);
      over_rows<up>(chunk, lattice.stride, l,
                    [&](std::ptrdiff_t at, double wy, double, double, double wz, double, double) {
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
      const double volume = soil.porosity[p] * bulk_volume(setup, soil, p);
      Array& field = pores.composition[soil.material[p]];
      pores.box[p].over_cells(setup.lattice, [&](std::ptrdiff_t cell, double share) { field[cell] += share * volume; });
    }
  });
  pores.pores = pores.composition.front();
  for (std::size_t m = 1; m < pores.composition.size(); ++m)
    for (std::size_t cell = 0; cell < pores.pores.size(); ++cell) pores.pores[cell] += pores.composition[m][cell];
}

namespace {

/// Gathers velocities and rates of strain; a point's own dilation goes to the cells that it counts for.
template <class Space>
Motion gather_rates(const Setup<Space>& setup, const GridFields<Space>& grid, const Tiling<Space>& tiling,
                    SoilPoints<Space>& soil, PoreFields<Space>& pores, Team& team) {
  const auto& lattice = setup.lattice;
  Motion motion;
  std::mutex mutex;  // a maximum does not depend on the order
  over_chunks(tiling, team, [&](std::size_t first, int count) {
    ChunkWeights<Space> chunk;
    chunk.compute(lattice, pointers_at<Space>(soil.position, first), count);
    use_cell_differences(chunk, count);
    const bool walled = beside_walls(setup.walls, lattice, chunk, count);
    Gathered<Space> gathered;
    double speed = 0;
    over_components<Space>([&]<int c>() {
      if (walled)
        gather_beside_walls<c, true, true>(setup.walls, lattice, chunk, count, grid.soil_velocity[c].data(), gathered);
      else
        gather_component<c, true, false>(lattice, chunk, count, grid.soil_velocity[c].data(), gathered);
      for (int l = 0; c == 0 && !walled && l < count; ++l) {
        const double* base = grid.soil_velocity[c].data() + stencil_base<c>(chunk, l);
        Vec4 sum{};
        over_rows<c>(chunk, lattice.stride, l,
                     [&](std::ptrdiff_t at, double wy, double, double, double wz, double, double) {
                       sum += (wy * wz) * load4(base + at);
                     });
        gathered.gradient[0][l] = sum_lanes(sum * difference_row);
      }
      take_motion<c>(lattice, chunk, gathered, first, count, soil);
      for (int l = 0; l < count; ++l) {
        const std::size_t p = first + static_cast<std::size_t>(l);
        speed = std::max(speed, std::abs(gathered.value[l]) / lattice.spacing[c]);
        for (int a = 0; a < Space::axes; ++a)
          pores.gradient[c * Space::axes + a][p] = gathered.gradient[a][l] / lattice.spacing[a];
      }
    });
    for (std::size_t p = first; p < first + static_cast<std::size_t>(count); ++p) {
      double own = 0;
      for (int a = 0; a < Space::axes; ++a) own += pores.gradient[a * Space::axes + a][p];
      if (setup.materials[soil.material[p]].fixed) own = 0;
      pores.dilation[p] = (1 - setup.numerics.fbar) * own;
    }
    const std::lock_guard lock(mutex);
    motion.take({speed, 0});
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
      const double change = bulk_volume(setup, soil, p) * pores.dilation[p];
      pores.box[p].over_cells(lattice,
                              [&](std::ptrdiff_t cell, double share) { pores.points_change[cell] += share * change; });
    }
  });
  const double thin = 0.05 * lattice.cell_volume();
  for (std::size_t cell = 0; cell < pores.bulk.size(); ++cell)
    pores.correction[cell] = pores.yielding[cell] > thin
                                 ? (pores.volume_change[cell] - pores.points_change[cell]) / pores.yielding[cell]
                                 : 0;
  over_chunks(tiling, team, [&](std::size_t first, int count) {
    for (std::size_t p = first; p < first + static_cast<std::size_t>(count); ++p) {
      if (!yields(p)) continue;
      double add = 0;
      pores.box[p].over_cells(lattice,
                              [&](std::ptrdiff_t cell, double share) { add += share * pores.correction[cell]; });
      pores.dilation[p] += add;
    }
  });
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
  over_chunks(tiling, team, [&](std::size_t first, int count) {
    VelocityGradients<Space> gradients;
    for (int c = 0; c < Space::axes; ++c)
      for (int a = 0; a < Space::axes; ++a)
        std::copy_n(pores.gradient[c * Space::axes + a].data() + first, count, gradients.at[c][a]);
    for (std::size_t p = first; p < first + static_cast<std::size_t>(count); ++p)
      pores.pore_volume[p] = soil.porosity[p] * bulk_volume(setup, soil, p);
    double plastic_shear[chunk_size];
    update_soil(setup, dt, first, count, gradients, pores.dilation.data() + first, soil, plastic_shear);
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
    const double before = pores.pore_volume[p], now = soil.porosity[p] * bulk_volume(setup, soil, p);
    pores.box[p].over_cells(setup.lattice, [&](std::ptrdiff_t cell, double share) {
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
  for (std::size_t cell = 0; cell < pores.mixing.size(); ++cell)
    pores.mixing[cell] = pores.mixing[cell] > uneven * pores.pores[cell] ? pores.way[cell] : 0;
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
  over_chunks(tiling, team, [&](std::size_t first, int count) {
    for (std::size_t p = first; p < first + static_cast<std::size_t>(count); ++p) {
      if (setup.materials[soil.material[p]].fixed) continue;
      const std::array<double, 3> from = position_of(soil, p);
      for (int a = 0; a < Space::axes; ++a)
        soil.position[a][p] = std::clamp(soil.position[a][p] + dt * soil.velocity[a][p],
                                         (setup.soil_box.low[a] + wall_gap) * lattice.spacing[a],
                                         (setup.soil_box.high[a] - wall_gap) * lattice.spacing[a]);
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
  template double box_half(const Setup<Space>&, const SoilPoints<Space>&, std::size_t);                                \
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
