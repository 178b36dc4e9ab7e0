#include "polder/step/face_predictor.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "polder/step/face_blocks.hpp"
#include "polder/step/face_loop.hpp"
#include "polder/step/row_metric.hpp"

namespace polder {

using namespace face_blocks;

namespace {

struct FaceState {
  double water, soil;                    // velocities, m/s
  double water_response, soil_response;  // d/d(∇p)
};

/// The 2 × 2 system of drag on one face, per volume: Mw = S n ρw, Ms = m_s/V_f, C the drag; right-hand sides Mw vw*,
/// Ms vs* and, for the responses, −Δt S (n, 1 − n).
FaceState couple(double water, double soil, double Mw, double Ms, double C, double n, double S, double dt,
                 bool water_fixed, bool soil_fixed, bool water_absent) {
  const double ew = dt * n * S, es = dt * (1 - n) * S;
  if (soil_fixed && water_fixed) return {0, 0, 0, 0};
  if (soil_fixed) {
    const double m = Mw + dt * C;
    return {Mw * water / m, 0, -ew / m, 0};
  }
  if (water_fixed || water_absent) {
    const double m = Ms + dt * C;
    const double v = water_absent ? soil : Ms * soil / m;
    return {water_fixed ? 0 : v, v, 0, -es / m};
  }
  const double a = Mw + dt * C, b = Ms + dt * C, o = dt * C;
  const double inverse = 1 / (Mw * Ms + dt * C * (Mw + Ms));
  const double rw = Mw * water, rs = Ms * soil;
  return {(b * rw + o * rs) * inverse, (a * rs + o * rw) * inverse, -(b * ew + o * es) * inverse,
          -(a * es + o * ew) * inverse};
}

/// Pa s/m over m: the dashpots of absorbing sides beside a cell against motion along them, per volume.
template <class Space>
double impedance_along(const Setup<Space>& setup, const GridFields<Space>& grid, int c, std::ptrdiff_t cell,
                       const std::array<int, 3>& at, int i) {
  const auto& lattice = setup.lattice;
  double sum = 0;
  for (int a = 0; a < Space::axes; ++a) {
    if (a == c) continue;
    const int place = a == 0 ? at[0] + i : at[a];
    const std::ptrdiff_t s = lattice.stride[a];
    const double width = lattice.axis[a].width(place);
    if (place == 0 && setup.absorbs(a, 0)) sum += grid.far_impedance[1][cell - s] / width;
    if (place == lattice.cells[a] - 1 && setup.absorbs(a, 1)) sum += grid.far_impedance[1][cell + s] / width;
  }
  return sum;
}

/// A face on an absorbing side: grains and water move as one, under what is more than at rest, against the dashpot.
/// Mw is the density of the water per volume; `outside` the cell beyond.
template <class Space>
FaceState far_state(const GridFields<Space>& grid, int c, std::ptrdiff_t f, std::ptrdiff_t outside, double area,
                    double volume, double Mw, double g, double dt, bool vertical, double water_before) {
  const double Ms = grid.soil_mass[c][f] / volume, M = Ms + Mw;
  double force = grid.soil_force[c][f] + grid.far_force[c][f];
  if (vertical) force -= g * M * volume;
  const double resisted = 1 + dt * grid.far_impedance[0][outside] * area / (volume * M);
  const double v = ((Ms * grid.soil_before[c][f] + Mw * water_before) / M + dt * force / (volume * M)) / resisted;
  const double response = -dt / M / resisted;
  return {v, v, response, response};
}

}  // namespace

template <class Space>
void predict_faces(const Setup<Space>& setup, const StepControl& control, double dt, GridFields<Space>& grid,
                   Team& team) {
  const auto& lattice = setup.lattice;
  const double cell_volume = lattice.cell_volume();
  const double rho_w = setup.water.density, g = setup.gravity * control.gravity_factor;
  const bool one_material = setup.materials.size() <= 1;
  const double rho_s0 = setup.materials.empty() ? 2650 : setup.materials.front().grain_density;
  const bool all_fixed = !setup.materials.empty() &&
                         std::all_of(setup.materials.begin(), setup.materials.end(), [](auto& m) { return m.fixed; });

  const bool far_field = control.event && setup.any_absorbs();

  for (int c = 0; c < Space::axes; ++c) {
    const std::ptrdiff_t s = lattice.stride[c];
    const bool vertical = c == Space::up, joined = setup.soil_box.periodic(c);
    const double pull = setup.pull(c) * control.gravity_factor;
    const double at_end[2] = {setup.wall_velocity(c, 0), setup.wall_velocity(c, 1)};
    const double* soil_mass = grid.soil_mass[c].data();
    const double* water_mass = grid.water_mass[c].data();
    const double* force = grid.soil_force[c].data();
    const double* flux = grid.relative_flux[c].data();
    const double* linear_drag = grid.linear_drag[setup.anisotropic && vertical].data();
    const double* quadratic_drag = grid.quadratic_drag[setup.anisotropic && vertical].data();
    double *vs = grid.soil_velocity[c].data(), *vw = grid.water_velocity[c].data(), *porosity = grid.porosity[c].data();
    double *rw = grid.water_response[c].data(), *rs = grid.soil_response[c].data(), *beta = grid.mobility[c].data();
    double *before = grid.soil_before[c].data(), *water_before = grid.water_before[c].data();
    const double* carried = grid.carried_mass[c].data();
    const double* discharge = grid.discharge[c].data();
    const OpenSide* opening[2] = {setup.open_side(c, 0), setup.open_side(c, 1)};
    const bool far_across[2] = {far_field && setup.absorbs(c, 0), far_field && setup.absorbs(c, 1)};
    std::uint8_t* reached = grid.reached[c].data();

    const bool plain = one_material && !all_fixed && !setup.single_point && (vertical || !control.hold_water) &&
                       !far_field && !control.body_force && !lattice.graded;
    const auto free = [&](int place) {  // of the sides that hold soil
      return place > setup.soil_box.low[c] && place < setup.soil_box.high[c];
    };
    const auto alone = [&](std::ptrdiff_t first, int run) {  // without walls and bodies
      return setup.walls.open(c, first, run) && setup.bodies.far_from(first, run);
    };
    const FaceArrays arrays{soil_mass,
                            water_mass,
                            force,
                            flux,
                            linear_drag,
                            quadratic_drag,
                            vs,
                            vw,
                            porosity,
                            rs,
                            rw,
                            beta,
                            before,
                            water_before,
                            grid.wet.data(),
                            grid.solid_volume.data(),
                            grid.cell_porosity.data()};
    const FaceConstants constants{dt,
                                  1 / cell_volume,
                                  rho_s0 * cell_volume,
                                  rho_w,
                                  -dt * pull,
                                  1 - std::min(1.0, control.damping * dt),
                                  1 - std::min(1.0, control.water_damping * dt)};

    by_spacing(lattice, [&]<bool graded>() {
      over_face_rows(lattice, grid.rows, c, team, [&](std::ptrdiff_t first, int count, const std::array<int, 3>& at) {
        const RowMetric<Space, graded> metric(lattice, at);
        for (int i = 0; i < count; ++i) {
          const std::ptrdiff_t f = first + i, low = f - s;
          const int place = c == 0 ? at[0] + i : at[c];
          if (plain && i + 4 <= count && place > 0) {
            const bool whole = i + block <= count;
            const int run = whole ? block : 4, last = c == 0 ? place + run - 1 : place;
            if (last < lattice.cells[c] && alone(f, run)) {
              const std::uint64_t wet = eight(&grid.wet[f]), wet_below = eight(&grid.wet[low]),
                                  either = wet | wet_below;
              const bool full = whole && (wet & wet_below) == eight_set, boxed = free(place) && free(last);
              bool done = true;
              if (full && boxed && all_above(soil_mass + f, soil_present * constants.full_of_grains))
                predict_block(arrays, f, s, constants);
              else if (full && all_zero(soil_mass + f))
                predict_water_block(arrays, f, constants);
              else if (whole && either == 0 && all_zero(soil_mass + f) && all_zero(water_mass + f))
                clear_block(arrays, f);
              else if (boxed)
                for (int part = 0; part < run; part += 4) predict_four(arrays, f + part, s, constants);
              else
                done = false;
              if (done) {
                std::memcpy(reached + f, &either, static_cast<std::size_t>(run));
                i += run - 1;
                continue;
              }
            }
          }
          const bool end = !joined && (place == 0 || place == lattice.cells[c]);
          const bool wall = end || setup.shut(c, f);
          const bool both_wet = grid.wet[low] && grid.wet[f], beside_wet = grid.wet[low] || grid.wet[f];
          reached[f] = beside_wet && (end || !wall);
          if (soil_mass[f] == 0 && water_mass[f] == 0 && !beside_wet) {
            water_before[f] = vs[f] = vw[f] = rs[f] = rw[f] = beta[f] = 0;
            porosity[f] = 1;
            continue;
          }
          const double open =
              setup.bodies.any() ? std::max(0.05, 0.5 * (setup.bodies.open_cell(low) + setup.bodies.open_cell(f))) : 1;
          const double whole = metric.face_volume(c, i), volume = (end ? 0.5 * whole : whole) * open;
          const double solid = grid.solid_volume[low] + grid.solid_volume[f];
          const double rho_s = one_material || solid <= least_solid * whole
                                   ? rho_s0
                                   : (grid.soil_cell_mass[low] + grid.soil_cell_mass[f]) / solid;
          const double full_of_grains = rho_s * volume;
          double n = std::max(0.2, 1 - soil_mass[f] / full_of_grains), ends = 0;
          const std::ptrdiff_t wet = grid.wet[f] ? f : low;
          if (beside_wet && !both_wet && !wall && grid.solid_volume[wet] > least_solid * whole) {
            double other = solid - grid.solid_volume[wet];
            if constexpr (graded)
              other *= grid.wet[f] ? metric.volume(i) / metric.volume_below(c, i)
                                   : metric.volume_below(c, i) / metric.volume(i);
            ends = std::max(0.0, 1 - other / grid.solid_volume[wet]);
            n += ends * (grid.cell_porosity[wet] - n);
          }
          porosity[f] = n;
          const bool has_soil = soil_mass[f] > soil_present * full_of_grains;

          const double held = setup.single_point ? carried[f] : 0;
          double S = std::min(1.0, (water_mass[f] + held) / (rho_w * n * volume));
          const bool has_water = S > water_present;
          const OpenSide* side = joined                      ? nullptr
                                 : place == 0                ? opening[0]
                                 : place == lattice.cells[c] ? opening[1]
                                                             : nullptr;
          if (side && !side->part.covers(c == 0 ? at[Space::up] : at[0] + i)) side = nullptr;
          if (beside_wet) S = both_wet || side ? 1 : std::max(least_saturation, S);

          double soil = has_soil ? vs[f] / soil_mass[f] : 0;
          before[f] = soil;
          double water = water_mass[f] > water_present * rho_w * volume ? vw[f] / water_mass[f] : soil;
          // water that soil points carry remembers its motion relative to them on the grid
          if (held > 0) water = (vw[f] + held * (soil + discharge[f] / n)) / (water_mass[f] + held);
          water_before[f] = water;
          if (has_soil) {
            soil += dt * force[f] / std::max(soil_mass[f], force_floor * full_of_grains);
            if (pull != 0) soil += dt * pull;
            if (control.body_force) {
              std::array<double, 3> x{};
              for (int a = 0; a < Space::axes; ++a) {
                const int number = a == 0 ? at[0] + i : at[a];
                x[a] = a == c ? lattice.axis[a].edge(number) : lattice.axis[a].centre(number);
              }
              soil += dt * control.body_force(c, x, control.time - dt);
            }
            soil *= 1 - std::min(1.0, control.damping * dt);
          }
          if (far_field && has_soil)
            soil /= 1 + dt * impedance_along(setup, grid, c, place < lattice.cells[c] ? f : low, at, i) * volume /
                            soil_mass[f];
          if (pull != 0) water += dt * pull;
          water *= 1 - std::min(1.0, control.water_damping * dt);

          // on the faces that a body closes, soil meets it after the pressure has acted; what water there is carries
          // its share
          const bool met = setup.bodies.closed(c, f) && !end && !setup.walls.blocked(c, f);
          if (met && vertical && has_water) soil += dt * g * rho_w / rho_s;
          const bool far = end && has_soil && !all_fixed && far_across[place > 0];
          const bool soil_fixed = (wall && !met) || all_fixed ||
                                  (!joined && (place <= setup.soil_box.low[c] || place >= setup.soil_box.high[c]));
          const bool water_fixed = (wall && !(side && side->prescribes_head)) || (control.hold_water && !vertical);
          FaceState state{0, 0, 0, 0};
          if (far) {
            state = far_state(grid, c, f, place == 0 ? low : f, metric.area(c, i), volume, n * rho_w * S, g, dt,
                              vertical, water_before[f]);
          } else if (met) {
            state.soil = has_soil && !soil_fixed ? soil : 0;
          } else if (!has_soil) {
            if (!water_fixed) {
              state.water = water;
              state.water_response = -dt / rho_w;
            }
          } else {
            // where the soil ends at the surface, of the wet cell alone; on an open side, of the cell inside
            const double share_low = side ? place > 0 : 0.5 * (1 + (grid.wet[low] ? ends : -ends));
            // of the whole face: on a graded lattice from what each cell has per volume
            const double of_low = graded ? share_low * whole / metric.volume_below(c, i) : share_low;
            const double of_high = graded ? (1 - share_low) * whole / metric.volume(i) : 1 - share_low;
            const double linear = of_low * linear_drag[low] + of_high * linear_drag[f];
            const double quadratic = of_low * quadratic_drag[low] + of_high * quadratic_drag[f];
            const double C = n * n * (linear + quadratic * flux[f]) * (metric.inverse_face_volume(c, i) / open) * S;
            state = couple(water, soil, n * rho_w * std::max(S, 1e-6), std::max(soil_mass[f] / volume, 1e-9), C, n, S,
                           dt, water_fixed, soil_fixed, !has_water && !beside_wet);
          }
          if (side && !side->prescribes_head) state.water = -side->outward() * side->value(control.time) / n;
          if (soil_fixed && !far) before[f] = 0;
          if (water_fixed && !far) water_before[f] = 0;
          if (end && !side && at_end[place > 0] != 0)  // a side that moves
            state.water = state.soil = before[f] = water_before[f] = at_end[place > 0];
          vw[f] = state.water;
          vs[f] = state.soil;
          rw[f] = state.water_response;
          rs[f] = state.soil_response;
          beta[f] = -(n * state.water_response + (1 - n) * state.soil_response);
        }
      });
    });
  }
}

template <class Space>
void damp_locally(const Setup<Space>& setup, double factor, GridFields<Space>& grid, Team& team) {
  for (int c = 0; c < Space::axes; ++c)
    over_face_rows(setup.lattice, grid.rows, c, team, [&](std::ptrdiff_t first, int count, const auto&) {
      for (std::ptrdiff_t f = first; f < first + count; ++f) {
        double& v = grid.soil_velocity[c][f];
        const double change = grid.soil_mass[c][f] > 0 ? v - grid.soil_before[c][f] : 0;
        v -= std::copysign(std::min(factor * std::abs(change), std::abs(v)), v);
      }
    });
}

template <class Space>
void update_discharge(const Setup<Space>& setup, GridFields<Space>& grid, Team& team) {
  const auto& lattice = setup.lattice;
  over_all_face_rows(lattice, grid.rows, team, [&](int c, std::ptrdiff_t first, int count, const auto&) {
    const std::ptrdiff_t s = lattice.stride[c];
    for (std::ptrdiff_t f = first; f < first + count; ++f) {
      grid.discharge[c][f] = grid.porosity[c][f] * (grid.water_velocity[c][f] - grid.soil_velocity[c][f]);
      if (grid.soil_mass[c][f] <= 0) {
        grid.relative_flux[c][f] = 0;
        continue;
      }
      double square = 0;
      for (int o = 0; o < Space::axes; ++o) {
        double u = 0;
        if (o == c) {
          u = grid.water_velocity[c][f] - grid.soil_velocity[c][f];
        } else {  // mean of the four faces around
          const std::ptrdiff_t t = lattice.stride[o];
          for (const std::ptrdiff_t at : {f - s, f, f - s + t, f + t})
            u += 0.25 * (grid.water_velocity[o][at] - grid.soil_velocity[o][at]);
        }
        square += u * u;
      }
      grid.relative_flux[c][f] = grid.porosity[c][f] * std::sqrt(square);
    }
  });
}

template void predict_faces(const Setup<PlaneStrain>&, const StepControl&, double, GridFields<PlaneStrain>&, Team&);
template void predict_faces(const Setup<Solid>&, const StepControl&, double, GridFields<Solid>&, Team&);
template void damp_locally(const Setup<PlaneStrain>&, double, GridFields<PlaneStrain>&, Team&);
template void damp_locally(const Setup<Solid>&, double, GridFields<Solid>&, Team&);
template void update_discharge(const Setup<PlaneStrain>&, GridFields<PlaneStrain>&, Team&);
template void update_discharge(const Setup<Solid>&, GridFields<Solid>&, Team&);

}  // namespace polder
