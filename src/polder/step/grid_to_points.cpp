#include "polder/step/grid_to_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <mutex>

#include "polder/step/chunk_loop.hpp"
#include "polder/step/face_loop.hpp"
#include "polder/step/gather.hpp"
#include "polder/step/groups.hpp"
#include "polder/step/leave_body.hpp"
#include "polder/step/soil_stress.hpp"
#include "polder/step/wall_transfer.hpp"

namespace polder {

namespace {

/// Runs body(tile) over all ranges of tiles, which write to their own points only, and gathers the motion they report.
template <class Space, class Body>
Motion over_tiles(const Tiling<Space>& tiling, Team& team, Body&& body) {
  Motion motion;
  std::mutex mutex;  // taken once a range; a maximum does not depend on the order
  over_ranges(tiling.in_order, team, [&](const TileRange& range) {
    const Motion of_tile = body(range);
    const std::lock_guard lock(mutex);
    motion.take(of_tile);
  });
  return motion;
}

/// The shift of the water as the correction balances it, linear within each cell: a spline would halve what alternates
/// from cell to cell.
template <int c, class Space>
void shift_in_cells(const Lattice<Space>& lattice, const ChunkWeights<Space>& chunk, int count, const Array& shift,
                    double* displacement) {
  for (int l = 0; l < count; ++l) {
    const std::ptrdiff_t face = cell_index(lattice, chunk, l);
    const double share = lattice.graded ? chunk.share[c][l] : 0.5 + chunk.delta[c][0][l];
    displacement[l] = (1 - share) * shift[face] + share * shift[face + lattice.stride[c]];
  }
}

/// Whether soil has written to any face that the chunk's points read, or to one close by.
template <class Space>
bool beside_soil(const Lattice<Space>& lattice, const ChunkWeights<Space>& chunk, int count,
                 const FaceFlags<Space>& soil) {
  int low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
  for (int a = 0; a < Space::axes; ++a) {
    int least = chunk.cell[a][0], most = least;
    for (int l = 1; l < count; ++l) {
      least = std::min(least, chunk.cell[a][l]);
      most = std::max(most, chunk.cell[a][l]);
    }
    low[a] = least - 1;
    high[a] = most + 2;
  }
  for (int k = low[2]; k <= high[2]; ++k)
    for (int j = low[1]; j <= high[1]; ++j)
      for (std::ptrdiff_t f = lattice.index(low[0], j, k); f <= lattice.index(high[0], j, k); f += 8)
        for (const auto& component : soil)
          if (eight(component.data() + f) != 0) return true;
  return false;
}

/// Largest of the lengths along axis c, counted in the points' own cells.
template <int c, class Space>
double most_cells(const Lattice<Space>& lattice, const ChunkWeights<Space>& chunk, int count, const double* length) {
  if (!lattice.graded) return largest_magnitude(length, count) * (1 / lattice.spacing[c]);
  double most = 0;
  for (int l = 0; l < count; ++l) most = std::max(most, std::abs(length[l]) / lattice.axis[c].width(chunk.cell[c][l]));
  return most;
}

/// The boxes of points in free water stretch along the axes with the flow, at constant volume. In soil, whose pores mix
/// the water, a box is shaped as a cell; in films and spray, whose motion nothing keeps free of divergence, it becomes
/// no more than twice as long or short.
template <class Space>
void stretch_boxes(double dt, const double* porosity, const bool* wet, std::size_t first, int count,
                   WaterPoints<Space>& water) {
  constexpr int axes = Space::axes;
  for (int l = 0; l < count; ++l) {
    const std::size_t p = first + static_cast<std::size_t>(l);
    double edge[axes], product = 1;
    for (int a = 0; a < axes; ++a) {
      const double before = 1 + water.elongation[a][p];
      edge[a] = before * std::max(0.5, 1 + dt * water.affine[a * axes + a][p]);
      if (!wet[l] && (edge[a] < 0.5 || edge[a] > 2)) edge[a] = before;
      product *= edge[a];
    }
    const double scale = axes == 2 ? 1 / std::sqrt(product) : 1 / std::cbrt(product);
    for (int a = 0; a < axes; ++a) water.elongation[a][p] = porosity[l] < 1 ? 0 : edge[a] * scale - 1;
  }
}

/// Moves points by `displacement` on axis a, held inside the phase's box; what is not a number ends at `low`, so that a
/// run that has gone wrong stays inside its arrays until it is stopped.
inline void move(double* x, const double* displacement, int count, double low, double high) {
  POLDER_INDEPENDENT
  for (int l = 0; l < count; ++l) x[l] = std::min(std::max(low, x[l] + displacement[l]), high);
}

/// Where a phase's points may be, by axis and side, m. They may pass a side that is open, to be taken out there, or the
/// ends of a periodic model.
template <class Space>
struct Room {
  const PhaseBox& box;
  double end[Space::axes][2];

  Room(const Lattice<Space>& lattice, const PhaseBox& box_) : box(box_) {
    for (int a = 0; a < Space::axes; ++a) {
      const auto gap = [&](int side) { return box.wall[a][side] == WallKind::open || box.periodic(a) ? -1 : wall_gap; };
      end[a][0] = lattice.axis[a].at_place(box.low[a] + gap(0));
      end[a][1] = lattice.axis[a].at_place(box.high[a] - gap(1));
    }
  }
};

/// Moves a chunk's points by `displacement`, held inside the phase's room and, if `walled`, on their side of thin walls
/// and, if `bodied`, out of bodies.
template <class Space, class Points>
void move_chunk(const Setup<Space>& setup, const Room<Space>& room, double dt, bool walled, bool bodied,
                std::size_t first, int count, const double (&displacement)[Space::axes][chunk_room], Points& points) {
  const auto& lattice = setup.lattice;
  const PhaseBox& box = room.box;
  double before[Space::axes][chunk_size];
  if (walled)
    for (int a = 0; a < Space::axes; ++a) std::copy_n(points.position[a].data() + first, count, before[a]);
  for (int a = 0; a < Space::axes; ++a)
    move(points.position[a].data() + first, displacement[a], count, room.end[a][0], room.end[a][1]);
  for (int a = 0; a < Space::axes; ++a)
    for (int side = 0; side < 2; ++side) {
      if (box.wall[a][side] != WallKind::open || box.opening[a][side].whole()) continue;
      const std::size_t along = static_cast<std::size_t>(along_side<Space>(a));
      const double low = lattice.axis[a].at_place(wall_gap), high = lattice.axis[a].at_place(box.high[a] - wall_gap);
      for (std::size_t p = first; p < first + static_cast<std::size_t>(count); ++p) {
        if (box.opening[a][side].covers(
                static_cast<int>(std::floor(lattice.axis[along].place(points.position[along][p])))))
          continue;
        double& x = points.position[a][p];
        x = side == 0 ? std::max(x, low) : std::min(x, high);
      }
    }
  for (int l = 0; bodied && l < count; ++l) leave_body(setup, box, dt, first + static_cast<std::size_t>(l), points);
  for (int l = 0; walled && l < count; ++l) {
    std::array<double, 3> from{0, 0, 0}, to{0, 0, 0};
    for (int a = 0; a < Space::axes; ++a) from[a] = before[a][l], to[a] = points.position[a][first + l];
    stop_at_walls(lattice, setup.walls, from, to);
    for (int a = 0; a < Space::axes; ++a) points.position[a][first + l] = to[a];
  }
}

/// The sums of a component at a chunk's points, its gradient if asked for, and the values of others there.
template <int c, bool with_gradient, std::size_t others = 0, class Space>
void gather(const Setup<Space>& setup, const ChunkWeights<Space>& chunk, bool walled, int count, const Array& field,
            Gathered<Space>& out, double (*gradient)[chunk_room], const std::array<const double*, others>& other = {},
            const std::array<double*, others>& other_value = {}) {
  if (!walled)
    return by_spacing(setup.lattice, [&]<bool graded>() {
      gather_component<c, with_gradient, graded>(setup.lattice, chunk, count, field.data(), out, gradient, other,
                                                 other_value);
    });
  gather_beside_walls<c, with_gradient>(setup.walls, setup.lattice, chunk, count, field.data(), out, gradient);
  for (std::size_t f = 0; f < others; ++f)
    gather_value_beside_walls<c>(setup.walls, setup.lattice, chunk, count, other[f], other_value[f]);
}

/// The value of a component alone.
template <int c, class Space>
void gather(const Setup<Space>& setup, const ChunkWeights<Space>& chunk, bool walled, int count, const Array& field,
            double* value) {
  if (walled) return gather_value_beside_walls<c>(setup.walls, setup.lattice, chunk, count, field.data(), value);
  by_spacing(setup.lattice,
             [&]<bool graded>() { gather_value<c, graded>(setup.lattice, chunk, count, field.data(), value); });
}

/// The grid's porosity around a soil point.
template <class Space>
double grid_porosity(const Setup<Space>& setup, const GridFields<Space>& grid, const SoilPoints<Space>& soil,
                     std::size_t p) {
  const std::array<double, 3> x = position_of(soil, p);
  double n = 0;
  over_seen_cells(setup.walls, setup.lattice, x, cell_of(setup.lattice, x), 0.5, setup.soil_box.low,
                  setup.soil_box.high,
                  [&](std::ptrdiff_t cell, double share) { n += share * grid.cell_porosity[cell]; });
  return n;
}

/// F-bar: the rate of volume change that each point is to follow, (1 − fbar) its own + fbar its group's mean.
template <class Space>
void share_dilation(double fbar, std::size_t first, int count, const VelocityGradients<Space>& gradients,
                    const SoilPoints<Space>& soil, double* dilation) {
  const double *mass = soil.mass.data() + first, *porosity = soil.porosity.data() + first;
  double volume[chunk_size], change[chunk_size];
  for (int l = 0; l < count; ++l) {
    double own = 0;
    for (int a = 0; a < Space::axes; ++a) own += gradients.at[a][a][l];
    volume[l] = mass[l] / (1 - porosity[l]);
    change[l] = volume[l] * own;
    dilation[l] = (1 - fbar) * own;
  }
  double whole = 0, of_all = 0;
  const auto take = [&](int l) {
    whole += volume[l];
    of_all += change[l];
  };
  over_groups(soil, first, count, take, [&](int begin, int end) {
    const double mean = fbar * (of_all / whole);
    for (int l = begin; l < end; ++l) dilation[l] += mean;
    whole = of_all = 0;
  });
}

/// The porosity of points whose grains are out of contact follows the grid's where that is wet.
template <class Space>
void relax_porosities(const Setup<Space>& setup, const GridFields<Space>& grid, const std::ptrdiff_t* cell,
                      std::size_t first, int count, SoilPoints<Space>& soil) {
  if (std::memchr(soil.fluid.data() + first, 1, static_cast<std::size_t>(count)) == nullptr) return;
  for (int l = 0; l < count; ++l) {
    const std::size_t p = first + static_cast<std::size_t>(l);
    if (!soil.fluid[p] || !grid.wet[cell[l]]) continue;
    soil.porosity[p] = relaxed_porosity(soil.porosity[p], grid_porosity(setup, grid, soil, p),
                                        setup.materials[soil.material[p]].max_porosity);
  }
}

template <std::size_t n>
bool all_finite(const std::array<Array, n>& values, const TileRange& tile) {
  return std::all_of(values.begin(), values.end(),
                     [&](const Array& array) { return polder::all_finite(array.data() + tile.first, tile.count); });
}

}  // namespace

template <class Space>
Motion grid_to_water(const Setup<Space>& setup, double dt, const GridFields<Space>& grid, const Tiling<Space>& tiling,
                     WaterPoints<Space>& water, Team& team) {
  const auto& lattice = setup.lattice;
  const bool stretched = setup.stretches_water();
  const Room<Space> room(lattice, setup.water_box);
  return over_tiles(tiling, team, [&](TileRange tile) {
    Motion motion;
    ChunkWeights<Space> chunk;
    Gathered<Space> gathered;
    double displacement[Space::axes][chunk_room], porosity[chunk_size], discharge[chunk_room], carried[chunk_room];
    bool wet[chunk_size];
    for (std::uint32_t done = 0; done < tile.count; done += chunk_size) {
      const std::size_t first = tile.first + done;
      const int count = std::min(chunk_size, static_cast<int>(tile.count - done));
      const Upcoming<Space> upcoming(lattice, water.home, first, count);
      upcoming.ask_for_points(water.position, water.velocity, water.affine);
      upcoming.template ask_for_grid<1>(lattice, grid.water_velocity, grid.shift, grid.discharge, grid.soil_velocity);
      chunk.compute_places(lattice, pointers_at<Space>(water.position, first), count);
      const bool walled = beside_walls(setup.walls, lattice, chunk, count);
      const bool bodied = beside_bodies(setup.bodies, lattice, chunk, count);
      for (int l = 0; l < count; ++l) porosity[l] = grid.cell_porosity[cell_index(lattice, chunk, l)];
      const bool in_soil = std::any_of(porosity, porosity + count, [](double n) { return n < 1; }) ||
                           beside_soil(lattice, chunk, count, grid.soil_known);
      over_components<Space>([&]<int c>() {
        const double *shift = grid.shift[c].data(), *velocity = gathered.value;
        if (in_soil) {
          gather<c, false, 3>(setup, chunk, walled, count, grid.water_velocity[c], gathered, nullptr,
                              {shift, grid.discharge[c].data(), grid.soil_velocity[c].data()},
                              {displacement[c], discharge, carried});
          for (int l = 0; l < count; ++l) carried[l] += discharge[l] / porosity[l];
          velocity = carried;
        } else {
          gather<c, false, 1>(setup, chunk, walled, count, grid.water_velocity[c], gathered, nullptr, {shift},
                              {displacement[c]});
        }
        take_motion<c>(lattice, chunk, gathered, first, count, water);
        if (stretched) shift_in_cells<c>(lattice, chunk, count, grid.shift[c], displacement[c]);
        for (int l = 0; l < count; ++l) displacement[c][l] += dt * velocity[l];
        motion.speed = std::max(motion.speed, most_cells<c>(lattice, chunk, count, velocity));
        motion.drift = std::max(motion.drift, most_cells<c>(lattice, chunk, count, displacement[c]));
      });
      for (int l = 0; stretched && l < count; ++l) wet[l] = grid.wet[cell_index(lattice, chunk, l)];
      if (stretched) stretch_boxes(dt, porosity, wet, first, count, water);
      move_chunk(setup, room, dt, walled, bodied, first, count, displacement, water);
    }
    motion.sound = all_finite(water.velocity, tile);
    return motion;
  });
}

template <class Space>
Motion grid_to_soil(const Setup<Space>& setup, double dt, const GridFields<Space>& grid, const Tiling<Space>& tiling,
                    SoilPoints<Space>& soil, Team& team) {
  const auto& lattice = setup.lattice;
  const double fbar = setup.numerics.fbar;
  const Room<Space> room(lattice, setup.soil_box);
  return over_tiles(tiling, team, [&](TileRange tile) {
    Motion motion;
    ChunkWeights<Space> chunk;
    Gathered<Space> gathered;
    VelocityGradients<Space> gradients;
    double displacement[Space::axes][chunk_room], dilation[chunk_size], plastic_shear[chunk_size];
    std::ptrdiff_t cell[chunk_size];
    over_whole_groups(soil, tile, [&](std::size_t first, int count) {
      const Upcoming<Space> upcoming(lattice, soil.home, first, count);
      upcoming.ask_for_points(soil.position, soil.velocity, soil.affine, soil.stress, soil.mass, soil.porosity,
                              soil.deviatoric_strain, soil.state);
      upcoming.template ask_for_grid<1>(lattice, grid.soil_velocity);
      chunk.compute_places(lattice, pointers_at<Space>(soil.position, first), count);
      for (int l = 0; l < count; ++l) cell[l] = cell_index(lattice, chunk, l);
      const bool walled = beside_walls(setup.walls, lattice, chunk, count);
      const bool bodied = beside_bodies(setup.bodies, lattice, chunk, count);
      over_components<Space>([&]<int c>() {
        gather<c, true>(setup, chunk, walled, count, grid.soil_velocity[c], gathered, gradients.at[c]);
        take_motion<c>(lattice, chunk, gathered, first, count, soil);
        if (setup.numerics.transfer == Transfer::xpic) {
          gather<c>(setup, chunk, walled, count, grid.unresolved[c], displacement[c]);
          for (int l = 0; l < count; ++l) soil.velocity[c][first + l] += displacement[c][l];
        }
        for (int l = 0; l < count; ++l) displacement[c][l] = dt * gathered.value[l];
        motion.speed = std::max(motion.speed, most_cells<c>(lattice, chunk, count, gathered.value));
      });
      motion.drift = motion.speed * dt;
      move_chunk(setup, room, dt, walled, bodied, first, count, displacement, soil);

      share_dilation(fbar, first, count, gradients, soil, dilation);
      update_soil(setup, dt, first, count, gradients, dilation, soil, plastic_shear);
      mix_porosities(plastic_shear, first, count, soil);
      relax_porosities(setup, grid, cell, first, count, soil);
    });
    motion.sound =
        all_finite(soil.velocity, tile) && all_finite(soil.stress, tile) &&
        all_within(soil.porosity.data() + tile.first, tile.count, possible_porosity[0], possible_porosity[1]);
    return motion;
  });
}

template Motion grid_to_water(const Setup<PlaneStrain>&, double, const GridFields<PlaneStrain>&,
                              const Tiling<PlaneStrain>&, WaterPoints<PlaneStrain>&, Team&);
template Motion grid_to_water(const Setup<Solid>&, double, const GridFields<Solid>&, const Tiling<Solid>&,
                              WaterPoints<Solid>&, Team&);
template Motion grid_to_soil(const Setup<PlaneStrain>&, double, const GridFields<PlaneStrain>&,
                             const Tiling<PlaneStrain>&, SoilPoints<PlaneStrain>&, Team&);
template Motion grid_to_soil(const Setup<Solid>&, double, const GridFields<Solid>&, const Tiling<Solid>&,
                             SoilPoints<Solid>&, Team&);

}  // namespace polder
