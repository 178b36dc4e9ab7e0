#include "polder/step/unsaturated_step.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "polder/case/geometry.hpp"
#include "polder/step/body_contact.hpp"
#include "polder/step/cell_beside.hpp"
#include "polder/step/chunk.hpp"
#include "polder/step/face_loop.hpp"
#include "polder/step/face_predictor.hpp"
#include "polder/step/far_field.hpp"
#include "polder/step/pore_curves.hpp"
#include "polder/step/projection.hpp"
#include "polder/step/soil_volume.hpp"
#include "polder/step/wall_friction.hpp"
#include "polder/step/wells.hpp"

namespace polder {

namespace {

// Steps grow while what is out of balance is below the first share of the weight, shrink above the second.
constexpr double calm_below = 1e-2, loud_above = 2e-2, grow = 1.03, shrink = 0.9, smoothing = 0.1;

}  // namespace

namespace {

/// Of pressures that were computed at the cells' centres: linear in between, as still water beyond the last ones.
template <class Space>
double computed_at_start(const Setup<Space>& setup, double x, double height) {
  const auto &across = setup.lattice.axis[0], &upwards = setup.lattice.axis[Space::up];
  const int columns = setup.lattice.cells[0], levels = setup.lattice.cells[Space::up];
  const auto height_of = static_cast<std::ptrdiff_t>(levels);
  // the cell whose centre is the last one at or before a place, and how far on the way to the next the place is
  const auto between = [](const GridAxis& axis, double at, int count) {
    int low = std::clamp(static_cast<int>(axis.place(at)), 0, count - 1);
    if (at < axis.centre(low)) low = std::max(low - 1, 0);
    const int high = std::min(low + 1, count - 1);
    const double way = high > low ? (at - axis.centre(low)) / (axis.centre(high) - axis.centre(low)) : 0;
    return std::tuple{low, high, std::clamp(way, 0.0, 1.0)};
  };
  const auto [left, right, over] = between(across, x, columns);
  const auto [lower, upper, up] = between(upwards, height, levels);
  const auto value = [&](int i, int j) { return setup.start_pressure[i * height_of + j]; };
  const double p = (1 - over) * ((1 - up) * value(left, lower) + up * value(left, upper)) +
                   over * ((1 - up) * value(right, lower) + up * value(right, upper));
  const double beyond = std::min(height - upwards.centre(0), 0.0) + std::max(height - upwards.centre(levels - 1), 0.0);
  return p + setup.water.density * setup.pull(Space::up) * beyond;
}

}  // namespace

template <class Space>
double pressure_at_start(const Setup<Space>& setup, double x, double height) {
  if (!setup.start_pressure.empty()) return std::max(computed_at_start(setup, x, height), -setup.suction_limit);
  if (setup.water_table.empty()) return 0;
  const double p = setup.water.density * setup.pull(Space::up) * (height - height_at(setup.water_table, x));
  return std::max(p, -setup.suction_limit);
}

template <class Space>
UnsaturatedStep<Space>::UnsaturatedStep(const Setup<Space>& setup, SoilPoints<Space>& soil, GridFields<Space>& grid)
    : pores(setup.lattice, setup.materials.size()) {
  const auto& lattice = setup.lattice;
  over_all_cells(lattice, [&](std::ptrdiff_t cell, const std::array<int, 3>& place) {
    const std::array<double, 3> x = lattice.centre(place);
    grid.pressure[cell] = lattice.graded ? pressure_at_start(setup, x[0], x[Space::up])
                                         : pressure_at_start(setup, (place[0] + 0.5) * lattice.spacing[0],
                                                             (place[Space::up] + 0.5) * lattice.spacing[Space::up]);
    pores.active[cell] = 1;  // it has a pressure
  });
  join_ends(pores.active, setup.soil_box, lattice);
  join_ends(grid.pressure, setup.soil_box, lattice);
  for (std::size_t p = 0; p < soil.size(); ++p) {
    const double filled = filled_by(setup, soil, p, soil.material[p], grid);
    soil.water[p] = filled * soil.porosity[p] * bulk_volume(setup, soil, p);
  }
  ground_.assign(
      static_cast<std::size_t>(lattice.cells[0]) * static_cast<std::size_t>(Space::axes == 3 ? lattice.cells[1] : 1),
      -1);
  ground_changed(setup, soil);
}

template <class Space>
double UnsaturatedStep<Space>::filled_by(const Setup<Space>& setup, const SoilPoints<Space>& soil, std::size_t p,
                                         std::size_t material, const GridFields<Space>& grid) const {
  double filled = 0;
  PointCells<Space>(setup, position_of(soil, p), box_half(setup, soil, p))
      .over_cells(setup.lattice, [&](std::ptrdiff_t cell, double share) {
        if (share > 0)
          filled += share * water_ratio(setup.pores[material], grid.pressure[cell], setup.water.bulk_modulus).value;
      });
  return filled;
}

template <class Space>
void UnsaturatedStep<Space>::ground_changed(const Setup<Space>& setup, const SoilPoints<Space>& soil) {
  const std::vector<int> now = ground_conditions(setup, soil);
  for (std::size_t column = 0; column < now.size(); ++column)
    if (now[column] >= 0) ground_[column] = now[column];
  weight_ = 0;
  for (std::size_t p = 0; p < soil.size(); ++p)
    weight_ += setup.gravity * (soil.mass[p] + setup.water.density * soil.water[p]);
}

template <class Space>
double UnsaturatedStep<Space>::natural_step(const Setup<Space>& setup) const {
  // of the stiffest material, or of the one named: soil_step holds cfl of it
  const double cfl = setup.numerics.cfl;
  const double natural = cfl > difference_cfl ? setup.soil_step * difference_cfl / cfl : setup.soil_step;
  return natural * std::sqrt(setup.numerics.mass_scaling) * calm.stretch;
}

namespace {

/// Share of the pore pressures that acts: those that are held rise with gravity.
double raised_so_far(const StepControl& control) { return control.hold_water ? control.gravity_factor : 1; }

}  // namespace

/// Velocities with the pressures of the last step; the out-of-balance force over the weight.
template <class Space>
double UnsaturatedStep<Space>::predict(const Setup<Space>& setup, const StepControl& control, double dt,
                                       bool standing_water, GridFields<Space>& grid, Team& team) {
  const double weight = setup.water.density * setup.gravity;
  const double raised = raised_so_far(control);
  const bool far_field = control.event && setup.any_absorbs();
  const auto& lattice = setup.lattice;
  std::vector<double> row_sum(static_cast<std::size_t>(lattice.size), 0.0);
  double unbalanced = 0;
  for (int c = 0; c < Space::axes; ++c) {
    const bool joined = setup.soil_box.periodic(c);
    const int low_side = joined ? -1 : setup.soil_box.low[c];
    const int high_side = joined ? lattice.cells[c] + 1 : setup.soil_box.high[c];
    const int again = joined ? lattice.cells[c] : -1;  // the face that is the first one
    const double at_end[2] = {setup.wall_velocity(c, 0), setup.wall_velocity(c, 1)};
    std::fill(row_sum.begin(), row_sum.end(), 0.0);
    over_face_rows(lattice, grid.rows, c, team, [&](std::ptrdiff_t first, int count, const std::array<int, 3>& place) {
      double sum = 0;
      for (int i = 0; i < count; ++i) {
        const std::ptrdiff_t f = first + i;
        const int at = place[c] + (c == 0 ? i : 0);
        const double m = grid.soil_mass[c][f];
        grid.soil_response[c][f] = grid.soil_before[c][f] = 0;
        const bool side = at <= low_side || at >= high_side;
        const bool far = side && far_field && setup.absorbs(c, at > 0);
        const bool wall = (side && !far) || setup.walls.blocked(c, f);
        if (!(m > 0) || wall || pores.held_mass[c][f] > 0.5 * m) {
          grid.soil_velocity[c][f] = wall && (at == 0 || at == lattice.cells[c]) ? at_end[at > 0] : 0;
          continue;
        }
        const double v = grid.soil_before[c][f] = grid.soil_velocity[c][f] / m;
        grid.soil_velocity[c][f] = v;
        if (pores.leader[c][f] != static_cast<std::int8_t>(Leader::itself)) continue;
        double force = grid.soil_force[c][f] + raised * pressure_force(lattice, pores, grid.pressure, c, f);
        if (standing_water) force += raised * standing_water_force(lattice, pores, weight, c, f);
        if (far) force += grid.far_force[c][f];
        const bool met = setup.bodies.inside(c, f);  // by a body, which takes what presses on it as it is
        if (!met && at != again) sum += std::abs(force);
        if (v != 0 && !met) force -= control.local_damping * std::abs(force) * (v > 0 ? 1 : -1);
        double resisted = 1 + control.damping * dt;
        if (far_field) resisted += dt / m * far_dashpot(setup, grid, c, {place[0] + i, place[1], place[2]});
        const double damped = 1 / resisted;
        grid.soil_velocity[c][f] = (v + dt * force / m) * damped;
        grid.soil_response[c][f] = dt / m * damped;
      }
      row_sum[static_cast<std::size_t>(first)] = sum;
    });
    for (const double s : row_sum) unbalanced += s;
  }
  return unbalanced / std::max(weight_, 1e-300);
}

/// What each cell holds after the step, exactly: what it held less what has left it. Its points gain what the curves
/// say, and the difference is spread over its pores; that of cells with little soil goes to their neighbour's below.
template <class Space>
void UnsaturatedStep<Space>::settle_books(const Setup<Space>& setup, double dt, const std::vector<PoreExit>& exits,
                                          bool held, GridFields<Space>& grid, Team& team,
                                          std::vector<Exchange>& exchanged, GroundCover* cover) {
  const auto& lattice = setup.lattice;
  const auto join_books = [&] {
    join_ends(pores.surplus, setup.soil_box, lattice);
    join_ends(pores.deviation, setup.soil_box, lattice);
  };
  const auto below = [&](std::ptrdiff_t cell, int a) { return cell_beside(lattice, setup.soil_box, cell, a, -1); };
  fill_pores(setup, grid, pores, team);
  if (held) {  // pressures are given: the ground takes or gives what they ask for
    double change = 0;
    over_all_cells(lattice,
                   [&](std::ptrdiff_t cell, const auto&) { change += pores.content[cell] - pores.water[cell]; });
    exchanged.push_back({lattice.index(0, 0), change});
    for (std::size_t cell = 0; cell < pores.content.size(); ++cell) {
      pores.surplus[cell] =
          pores.pores[cell] > 0 ? (pores.content_before[cell] - pores.water[cell]) / pores.pores[cell] : 0;
      pores.deviation[cell] = 0;
    }
    join_books();
    return;
  }
  Array left = pores.water;
  over_all_cells(lattice, [&](std::ptrdiff_t cell, const std::array<int, 3>& place) {
    for (int a = 0; a < Space::axes; ++a) {
      if (place[a] == 0 && !setup.soil_box.periodic(a)) continue;
      left[cell] += dt * pores.flow[a][cell];
      left[below(cell, a)] -= dt * pores.flow[a][cell];
    }
  });
  for (const PoreExit& exit : exits) {
    left[exit.cell] -= dt * exit.out;
    if (exit.column >= 0)
      cover->gained[exit.column] += dt * exit.out;
    else
      exchanged.push_back({exit.cell, -dt * exit.out});
  }
  Array beyond = lattice.make_array();                                 // the change of Θ
  for (std::ptrdiff_t row = lattice.row_count() - 1; row >= 0; --row)  // from above, so that each passes on once
    for (int i = lattice.cells[0] - 1; i >= 0; --i) {
      const std::ptrdiff_t cell =
          lattice.index(i, static_cast<int>(row % lattice.cells[1]), static_cast<int>(row / lattice.cells[1]));
      beyond[cell] += left[cell] - pores.water[cell] - (pores.content[cell] - pores.content_before[cell]);
      if (pores.bulk[cell] > thin_cell * lattice.cell_volume(cell) || beyond[cell] == 0) continue;
      std::ptrdiff_t to = pores.host[cell];
      for (int turn = 0; to < 0 && turn < Space::axes; ++turn) {
        const int a = (Space::up + turn) % Space::axes;
        const std::ptrdiff_t lower = below(cell, a);
        if (lower >= 0 && !setup.shut(a, cell) && pores.bulk[lower] > pores.bulk[cell]) to = lower;
      }
      if (to < 0) continue;
      beyond[to] += beyond[cell];
      beyond[cell] = 0;
    }
  for (std::size_t cell = 0; cell < beyond.size(); ++cell) {
    const double room = pores.pores[cell] > 0 ? 1 / pores.pores[cell] : 0;
    pores.surplus[cell] = room * beyond[cell];
    pores.deviation[cell] = room * (pores.water[cell] - pores.content_before[cell] + beyond[cell]);
  }
  join_books();
}

/// How far the faces of each cell move in the step.
template <class Space>
void UnsaturatedStep<Space>::set_way(const Setup<Space>& setup, double dt, const GridFields<Space>& grid, Team& team) {
  const auto& lattice = setup.lattice;
  over_cell_rows(lattice, grid.rows, team, [&](std::ptrdiff_t first, int count, std::array<int, 3> place) {
    for (std::ptrdiff_t cell = first; cell < first + count; ++cell, ++place[0]) {
      double way = 0;
      for (int a = 0; a < Space::axes; ++a)
        for (const std::ptrdiff_t f : {cell, cell + lattice.stride[a]})
          way = std::max(way, dt * std::abs(grid.soil_velocity[a][f]) / lattice.axis[a].width(place[a]));
      pores.way[cell] = std::min(1.0, way);
    }
  });
}

template <class Space>
void UnsaturatedStep<Space>::judge(const Setup<Space>& setup, const SoilPoints<Space>& soil, Team& team) {
  struct Energies {
    double kinetic = 0, elastic = 0, of_mass = 0;  // of_mass: without what inertia is raised by

    void operator+=(const Energies& other) {
      kinetic += other.kinetic;
      elastic += other.elastic;
      of_mass += other.of_mass;
    }
  };
  const double h = setup.lattice.smallest_spacing();
  const auto energies = ordered_sum(team, static_cast<std::ptrdiff_t>(soil.size()), [&](std::ptrdiff_t at) {
    const auto p = static_cast<std::size_t>(at);
    double square = 0;
    for (int s = 0; s < Space::stress; ++s) square += (s < 3 ? 1 : 2) * soil.stress[s][p] * soil.stress[s][p];
    const double half_speed = 0.5 * speed_squared(soil, p);
    return Energies{half_speed * pores.inertia[p],
                    0.5 * pores.volume[p] * square / setup.pores[soil.material[p]].modulus,
                    half_speed * (soil.mass[p] + setup.water.density * soil.water[p])};
  });
  calm.energy_over_weight = weight_ > 0 ? energies.of_mass / (weight_ * setup.lattice.spacing[Space::up]) : 0;
  calm.energy_ratio = energies.elastic > 0 ? energies.kinetic / energies.elastic : 0;
  double largest = 0;  // square of the inertial number over h
  for (std::size_t p = 0; p < soil.size(); ++p) {
    double rate = 0;
    for (int c = 0; c < Space::axes; ++c)
      for (int a = 0; a < Space::axes; ++a) {
        const double e = 0.5 * (pores.gradient[c * Space::axes + a][p] + pores.gradient[a * Space::axes + c][p]);
        rate += 2 * e * e;
      }
    const double confinement = std::max(1e3, -(soil.stress[0][p] + soil.stress[1][p] + soil.stress[2][p]) / 3);  // Pa
    largest = std::max(largest, rate * pores.inertia[p] / (pores.volume[p] * confinement));
  }
  calm.inertial_number = std::sqrt(largest) * h;
  if (calm.stretch > 1 || setup.numerics.mass_scaling > 1 || !setup.numerics.step_material.empty()) {
    calm.worst_energy_ratio = std::max(calm.worst_energy_ratio, calm.energy_ratio);
    calm.worst_inertial_number = std::max(calm.worst_inertial_number, calm.inertial_number);
  }
}

/// What drawings and monitors of the water read: cells under the water table are wet, the uppermost filled up to it.
template <class Space>
void UnsaturatedStep<Space>::show_water(const Setup<Space>& setup, GridFields<Space>& grid, Team& team) const {
  const auto& lattice = setup.lattice;
  const double weight = setup.water.density * std::max(-setup.pull(Space::up), 1e-9);
  const std::ptrdiff_t s = lattice.stride[Space::up];
  over_cell_rows(lattice, grid.rows, team, [&](std::ptrdiff_t first, int count, std::array<int, 3> place) {
    for (std::ptrdiff_t cell = first; cell < first + count; ++cell, ++place[0]) {
      const double rise = weight * lattice.axis[Space::up].width(place[Space::up]);
      const bool own = pores.active[cell] && pores.host[cell] < 0;
      const double level = 0.5 + grid.pressure[cell] / rise;  // of the water table over the cell's base, cells
      grid.wet[cell] = own && grid.pressure[cell] >= 0;
      const bool under = own && pores.active[cell + s] && grid.pressure[cell + s] >= 0;
      grid.fill[cell] = !own ? 0 : under ? 1 : std::clamp(level, 0.0, 1.0);
      grid.cell_porosity[cell] = pores.bulk[cell] > 0 ? pores.pores[cell] / pores.bulk[cell] : 1;
    }
  });
  join_ends(grid.wet, setup.soil_box, lattice);
  join_ends(grid.fill, setup.soil_box, lattice);
  for (int a = 0; a < Space::axes; ++a)
    for (std::size_t f = 0; f < pores.flow[a].size(); ++f)
      if (pores.flow[a][f] != 0 || grid.discharge[a][f] != 0)
        grid.discharge[a][f] = pores.flow[a][f] / lattice.face_area(a, static_cast<std::ptrdiff_t>(f));
}

/// What the water presses with on a body at a face in it, N along the axis: the pressure of the cell before the body
/// and, from the cell's middle on, the weight of still water in the soil that the face carries.
template <class Space>
double UnsaturatedStep<Space>::water_on_body(const Setup<Space>& setup, const StepControl& control,
                                             const GridFields<Space>& grid, int axis, std::ptrdiff_t face) const {
  const double raised = raised_so_far(control);
  const double force = raised * pressure_force(setup.lattice, pores, grid.pressure, axis, face);
  const std::ptrdiff_t low = face - setup.lattice.stride[axis];
  const double below = pores.weight[axis][low], above = pores.weight[axis][face];
  if (axis != Space::up || !(below + above > 0)) return force;
  const double saturation = (below * pores.saturation[low] + above * pores.saturation[face]) / (below + above);
  return force + raised * saturation * setup.water.density * setup.pull(axis) * pores.face_bulk[face];
}

template <class Space>
SolveResult UnsaturatedStep<Space>::advance(const Setup<Space>& setup, const StepControl& control, double dt,
                                            const Tiling<Space>& tiling, SoilPoints<Space>& soil,
                                            GridFields<Space>& grid, PressureSolver<Space>& solver, Team& team,
                                            Motion& motion, std::vector<Exchange>& exchanged, GroundCover* cover) {
  const double down = -setup.pull(Space::up);  // m/s²
  mixture_to_grid(setup, soil, tiling, {setup.numerics.mass_scaling, dt}, control.gravity_factor, control.time, grid,
                  pores, team);
  prepare_cells(setup, grid, pores);
  fill_pores(setup, grid, pores, team);
  pores.content_before = pores.content;
  pores.ratio_before = pores.ratio;
  const bool standing_water = set_standing_water(setup, ground_, control.time, down, pores, cover);
  if (standing_water)
    for (Array* field : pores.standing_water()) join_ends(*field, setup.soil_box, setup.lattice);
  if (standing_water || setup.bodies.any()) bulk_to_faces(setup, soil, tiling, pores, team);
  if (control.event && setup.any_absorbs() && grid.far_is_known == 0)
    know_far_ground(
        setup, soil, pores,
        [&](int c, std::ptrdiff_t f) {
          const double weight = setup.water.density * setup.gravity;
          return grid.soil_force[c][f] + pressure_force(setup.lattice, pores, grid.pressure, c, f) +
                 (standing_water ? standing_water_force(setup.lattice, pores, weight, c, f) : 0);
        },
        grid);
  const double unbalanced = predict(setup, control, dt, standing_water, grid, team);
  if (setup.bodies.any()) {
    extrapolate_soil(setup, grid, team);
    meet_bodies(setup, grid, {}, [&](int c, std::ptrdiff_t f) {
      return grid.soil_response[c][f] * water_on_body(setup, control, grid, c, f);
    });
  }

  SolveResult result;
  std::vector<PoreExit> exits;
  if (!control.hold_water) {
    exits = pore_exits(setup, ground_, control.time, dt, down, pores, cover);
    for (const PoreExit& exit : well_exits(setup, control.time, grid, pores)) exits.push_back(exit);
    result = solve_pore_pressure(setup, dt, exits, grid, pores, solver, team);
  }
  if (!setup.friction.empty()) rub_along_walls(setup, dt, soil, grid);
  const auto follows = [&](int c, std::ptrdiff_t f) {
    const auto who = static_cast<Leader>(pores.leader[c][f]);
    return who == Leader::below || who == Leader::above;
  };
  if (setup.periodic) reflect(grid.soil_velocity[0], 0, true, setup.soil_box, setup.lattice, true);  // leaders beyond
  for (int c = 0; c < Space::axes; ++c) {
    const std::ptrdiff_t s = setup.lattice.stride[c];
    Array& v = grid.soil_velocity[c];
    for (std::size_t f = 0; f < v.size(); ++f) {
      const auto who = static_cast<Leader>(pores.leader[c][f]);
      if (who == Leader::below) v[f] = v[f - static_cast<std::size_t>(s)];
      if (who == Leader::above) v[f] = v[f + static_cast<std::size_t>(s)];
    }
  }
  if (setup.bodies.any()) meet_bodies(setup, grid, follows);
  for (int c = 0; c < Space::axes; ++c) reflect(grid.soil_velocity[c], c, true, setup.soil_box, setup.lattice, true);

  set_volume_change(setup, grid, pores, team);
  motion = strain_points(setup, dt, grid, tiling, soil, pores, team);
  pores_to_grid(setup, soil, tiling, pores, team);
  set_way(setup, dt, grid, team);
  settle_books(setup, dt, exits, control.hold_water, grid, team, exchanged, cover);
  move_points(setup, dt, tiling, pores, soil, team);
  show_water(setup, grid, team);
  judge(setup, soil, team);

  calm.unbalanced_now = unbalanced;
  calm.unbalanced += smoothing * (unbalanced - calm.unbalanced);
  // where the ground is to come to rest, steps that are longer must not keep it from what counts as rest
  const double wanted = control.rest_force > 0 ? std::min(1.0, 0.3 * control.rest_force / calm_below) : 1;
  if (calm.unbalanced > wanted * loud_above)
    calm.stretch = std::max(1.0, shrink * calm.stretch);
  else if (calm.unbalanced < wanted * calm_below)
    calm.stretch = std::min(setup.numerics.step_stretch, grow * calm.stretch);
  return result;
}

template double pressure_at_start(const Setup<PlaneStrain>&, double, double);
template double pressure_at_start(const Setup<Solid>&, double, double);
template class UnsaturatedStep<PlaneStrain>;
template class UnsaturatedStep<Solid>;

}  // namespace polder
