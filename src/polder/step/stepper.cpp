#include "polder/step/stepper.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "polder/math/huge_pages.hpp"
#include "polder/points/resample.hpp"
#include "polder/step/body_contact.hpp"
#include "polder/step/cavities.hpp"
#include "polder/step/chunk_loop.hpp"
#include "polder/step/face_predictor.hpp"
#include "polder/step/far_field.hpp"
#include "polder/step/films.hpp"
#include "polder/step/open_sides.hpp"
#include "polder/step/points_to_grid.hpp"
#include "polder/step/rain.hpp"
#include "polder/step/smooth_walls.hpp"
#include "polder/step/soil_exchange.hpp"
#include "polder/step/unresolved.hpp"
#include "polder/step/viscous_stress.hpp"
#include "polder/step/wall_friction.hpp"

namespace polder {

namespace {

constexpr double point_cfl = 0.5;    // cells that a point may cross in a step
constexpr double surface_cfl = 0.1;  // of √(h/g): free surfaces are advanced explicitly
constexpr double viscous_cfl = 0.8;  // of the explicit limit of viscous stresses
constexpr std::uint64_t resample_every = 10;
constexpr std::ptrdiff_t cells_worth_a_team = 60000;  // of a system that two threads or more solve together

/// Points that have passed an end of a periodic model come in at the other. Returns whether there are any.
template <class Space, class Points>
bool bring_in(const Lattice<Space>& lattice, Points& points) {
  const double length = lattice.length(0);
  bool any = false;
  for (std::size_t p = 0; p < points.size(); ++p) {
    double& x = points.position[0][p];
    if (x >= 0 && x < length) continue;
    const double shift = x < 0 ? length : -length;
    x = std::clamp(x + shift, 0.0, length * (1 - 1e-15));
    if constexpr (requires { points.reference; }) points.reference[0][p] += shift;
    any = true;
  }
  return any;
}

class Stopwatch {
 public:
  void lap(double& total) {
    const auto now = std::chrono::steady_clock::now();
    total += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace

template <class Space>
Stepper<Space>::Stepper(Setup<Space> setup_, SoilPoints<Space> soil_, WaterPoints<Space> water_, int threads)
    : setup(std::move(setup_)),
      soil(std::move(soil_)),
      water(std::move(water_)),
      grid(setup.lattice),
      next_water_id(water.size()),
      team(threads),
      solver_(setup.lattice) {
  if (!setup.rains.empty()) grid.rain = setup.lattice.make_array();
  if (setup.single_point && !setup.unsaturated) grid.spare = setup.lattice.make_array();
  if (setup.numerics.transfer == Transfer::xpic) grid.unresolved = make_face_field(setup.lattice);
  if (setup.any_absorbs()) {
    grid.far_force = make_face_field(setup.lattice);
    grid.far_pressure = setup.lattice.make_array();
    for (auto& z : grid.far_impedance) z = setup.lattice.make_array();
  }
  if (setup.unsaturated) unsaturated = std::make_unique<UnsaturatedStep<Space>>(setup, soil, grid);
  if (OpenWater<Space>::wanted(setup, water))
    open_water = std::make_unique<OpenWater<Space>>(setup, soil, water.size(), threads);
  if (soil.size() + water.size() > many_points) use_huge_pages();
}

template <class Space>
double Stepper<Space>::natural_step() const {
  if (unsaturated) {
    double dt = std::min(setup.numerics.max_step, unsaturated->natural_step(setup));
    if (open_water) dt = std::min(dt, open_water->natural_step());
    return motion.speed > 0 ? std::min(dt, point_cfl / motion.speed) : dt;
  }
  double dt = std::min(setup.numerics.max_step, soil.size() > 0 ? setup.soil_step : 1e300);
  const bool wet = water.size() > 0 || soil.size() == 0;  // what has no soil is for water, now or later
  if (setup.water.viscous && wet) {                       // ν∇²v is explicit
    double sum = 0;
    for (int a = 0; a < Space::axes; ++a) sum += 1 / (setup.lattice.spacing[a] * setup.lattice.spacing[a]);
    dt = std::min(dt, viscous_cfl * setup.water.density / (2 * setup.water.viscosity * sum));
  }
  if (setup.gravity > 0 && (wet || setup.single_point || !setup.rains.empty()))
    dt = std::min(dt, surface_cfl * std::sqrt(setup.lattice.smallest_spacing() / setup.gravity));
  if (motion.speed > 0) dt = std::min(dt, point_cfl / motion.speed);
  return dt;
}

template <class Space>
void Stepper<Space>::sort_water() {
  sort_points(setup.lattice, water, water_tiling_, team);
  drift_water = 0;
  rows_stale_ = true;
}

template <class Space>
void Stepper<Space>::prepare() {
  if (unsorted_ || drift_water > largest_drift) sort_water();
  if (unsorted_ || drift_soil > largest_drift) {
    sort_points(setup.lattice, soil, soil_tiling_, team);
    drift_soil = 0;
    rows_stale_ = true;
  }
  unsorted_ = 0;
  if (!rows_stale_) return;
  ActiveRows<Space> rows = rows_near(setup.lattice, soil.home, water.home, team.size());
  if (setup.periodic) {  // what is near one end is near the other
    for (RowSpan& span : rows.spans)
      if (span.count() > 0) span = {0, setup.lattice.cells[0]};
    rows.finish(team.size());
  }
  grid.activate(setup.lattice, std::move(rows));
  rows_stale_ = false;
}

template <class Space>
void Stepper<Space>::restored() {
  rows_stale_ = true;
  if (open_water) open_water->restored(water);
  if (unsorted_) return;
  tile_points(setup.lattice, soil.home, soil_tiling_);
  if (!open_water) tile_points(setup.lattice, water.home, water_tiling_);
}

template <class Space>
void Stepper<Space>::resample() {
  ResampleRules rules;
  rules.nominal = setup.nominal_point_volume();
  rules.points_per_cell = static_cast<int>(std::lround(std::pow(setup.points_per_axis, Space::axes)));
  if (setup.stretches_water()) rules.split_edge = 1.9 / setup.points_per_axis;
  rules.seed = setup.numerics.seed;
  const std::size_t split = split_water(setup.lattice, grid.cell_porosity, rules, step, next_water_id, water, team,
                                        setup.walls, setup.bodies);
  if (split > 0 || drift_water > largest_drift) {
    sort_water();
    if (merge_water(setup.lattice, grid.cell_porosity, rules, water) > 0)  // those that are left stay in order
      tile_points(setup.lattice, water.home, water_tiling_);
  }
}

/// Whether the forces on bodies are asked for.
template <class Space>
bool Stepper<Space>::begin_weighing() {
  const bool weighs = setup.bodies.any() && (setup.bodies.moves() || setup.weighs_bodies);
  grid.body_impulse.assign(weighs ? setup.bodies.sections().size() : 0, {0, 0});
  body_force.clear();
  return weighs;
}

template <class Space>
StepReport Stepper<Space>::advance_unsaturated(const StepControl& control, double dt) {
  StepReport report;
  report.dt = dt;
  Stopwatch watch;
  exchanged.clear();
  if (open_water) open_water->advance(setup, control, dt, water, exchanged);
  watch.lap(times.volume);
  prepare();
  setup.move_sides(control.time);
  watch.lap(times.sort);
  const bool weighs = begin_weighing();
  report.pressure = unsaturated->advance(setup, control, dt, soil_tiling_, soil, grid, solver_, team, motion, exchanged,
                                         open_water ? &open_water->cover : nullptr);
  if (weighs) body_force = body_forces(setup, dt, grid, &unsaturated->pores);
  drift_soil += motion.drift;
  if (setup.periodic && bring_in(setup.lattice, soil)) points_changed();
  if (open_water) {
    open_water->follow(setup, unsaturated->pores.bulk, exchanged);
    open_water->show(setup, unsaturated->pores, grid);
  }
  ++step;
  watch.lap(times.pressure);
  return report;
}

/// The two solves of a step at the same time, each on one thread: the sweeps of small systems are too short to share.
/// The wall time is booked on each by what it took.
template <class Space>
void Stepper<Space>::solve_beside(double dt, const std::vector<WellFlow>& wells, StepReport& report) {
  if (!volume_solver_) volume_solver_.emplace(setup.lattice);
  double pressure = 0, volume = 0, both = 0;
  Stopwatch watch;
  team.run([&](int rank) {
    if (rank > 1) return;
    Team alone(1);
    Stopwatch own;
    if (rank == 0) {
      report.pressure = project(setup, dt, wells, grid, solver_, alone);
      own.lap(pressure);
    } else {
      report.volume = correct_volume(setup, grid, *volume_solver_, alone);
      own.lap(volume);
    }
  });
  watch.lap(both);
  times.pressure += both * pressure / (pressure + volume);
  times.volume += both * volume / (pressure + volume);
}

template <class Space>
StepReport Stepper<Space>::advance(const StepControl& control, double dt) {
  if (unsaturated) return advance_unsaturated(control, dt);
  StepReport report;
  report.dt = dt;
  Stopwatch watch;

  prepare();
  setup.move_sides(control.time);
  watch.lap(times.sort);

  soil_to_grid(setup, soil, soil_tiling_, control.time, grid, team);
  water_to_grid(setup, soil, soil_tiling_, water, water_tiling_, grid, team);
  if (setup.bodies.any()) let_drops_slide(setup, grid);
  keep_cavities(setup, grid);
  if (!setup.open_sides.empty()) prepare_open_sides(setup, control.time, grid);
  const bool far_field = control.event && setup.any_absorbs();
  if (far_field && grid.far_is_known == 0)
    know_far_field(setup, soil, setup.gravity * control.gravity_factor, step == 0, grid);
  if (far_field) prepare_far_field(setup, grid);
  watch.lap(times.to_grid);

  if (setup.water.viscous) add_viscous_stress(setup, dt, grid, team);
  if (!setup.sticky_sides.empty()) rub_along_smooth_walls(setup, dt, grid, team);
  predict_faces(setup, control, dt, grid, team);
  if (water.size() > 0) spread_films(setup, control, dt, grid, team);
  if (!setup.open_sides.empty()) close_seepage_faces(setup, grid);
  watch.lap(times.faces);

  std::vector<WellFlow> wells;
  if (!setup.wells.empty()) wells = well_flows(setup, control.time, grid);
  const std::size_t own_wells = wells.size();
  std::copy_if(sources.begin(), sources.end(), std::back_inserter(wells),
               [&](const WellFlow& source) { return grid.wet[source.cell] != 0; });
  const bool beside = team.size() > 1 && !far_field && grid.rows.cell_count * (team.size() - 1) < cells_worth_a_team;
  if (beside) {
    solve_beside(dt, wells, report);
    watch = {};  // it has booked its own time
  } else {
    report.pressure = project(setup, dt, wells, grid, solver_, team);
    if (far_field) close_far_field(setup, grid);
    watch.lap(times.pressure);
  }

  wells.resize(own_wells);
  if (control.local_damping > 0) damp_locally(setup, control.local_damping, grid, team);
  extrapolate_water(setup, grid, grid.water_velocity, true, grid.layers, team);
  extrapolate_soil(setup, grid, team);
  const bool weighs = begin_weighing();
  if (setup.bodies.any()) meet_bodies(setup, grid);
  if (setup.bodies.moves()) water_meets_bodies(setup, grid);
  if (weighs) body_force = body_forces(setup, dt, grid);
  if (!setup.friction.empty()) rub_along_walls(setup, dt, soil, grid);
  for (int c = 0; c < Space::axes; ++c) {
    if (control.hold_water && c != Space::up)
      std::fill(grid.water_velocity[c].begin(), grid.water_velocity[c].end(), 0.0);
    reflect(grid.water_velocity[c], c, true, setup.water_box, setup.lattice, true);
    reflect(grid.soil_velocity[c], c, true, setup.soil_box, setup.lattice, true);
  }
  update_discharge(setup, grid, team);
  for (int c = 0; c < Space::axes; ++c) reflect(grid.discharge[c], c, true, setup.water_box, setup.lattice);
  watch.lap(times.faces);

  if (!beside) report.volume = correct_volume(setup, grid, solver_, team);
  watch.lap(times.volume);

  if (setup.numerics.transfer == Transfer::xpic) find_unresolved(setup, soil, soil_tiling_, grid, team);
  const Motion of_water = grid_to_water(setup, dt, grid, water_tiling_, water, team);
  const Motion of_soil = grid_to_soil(setup, dt, grid, soil_tiling_, soil, team);
  drift_water += of_water.drift;
  drift_soil += of_soil.drift;
  motion = of_water;
  motion.take(of_soil);
  if (setup.periodic) {
    if (bring_in(setup.lattice, water)) sort_water();
    if (bring_in(setup.lattice, soil)) points_changed();
  }
  watch.lap(times.to_points);

  exchanged.clear();
  bool sorted = true;  // wells that only change volumes leave the order as it is
  if (!wells.empty()) exchanged = exchange_with_wells(setup, dt, wells, grid, next_water_id, water, sorted);
  const auto add = [&](const std::vector<Exchange>& more) {
    if (!more.empty()) sorted = false;
    exchanged.insert(exchanged.end(), more.begin(), more.end());
  };
  if (!setup.rains.empty()) add(let_it_rain(setup, control.time, dt, grid, next_water_id, water));
  if (!setup.open_sides.empty()) add(exchange_through_sides(setup, dt, grid, next_water_id, water));
  if (!setup.reservoirs.empty()) add(exchange_with_reservoirs(setup, control.time, grid, next_water_id, water));
  if (!grid.spare.empty() && exchange_with_soil(setup, dt, grid, next_water_id, soil, water)) sorted = false;
  if (!sorted) sort_water();
  ++step;
  if (setup.numerics.split_water && step % resample_every == 0) resample();
  watch.lap(times.resample);
  return report;
}

template class Stepper<PlaneStrain>;
template class Stepper<Solid>;

}  // namespace polder
