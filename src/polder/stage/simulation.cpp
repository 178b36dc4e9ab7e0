#include "polder/stage/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "polder/boundary/load.hpp"
#include "polder/boundary/standing_walls.hpp"
#include "polder/points/seed.hpp"
#include "polder/stage/initial.hpp"
#include "polder/stage/rest.hpp"
#include "polder/stage/seepage_start.hpp"
#include "polder/stage/sound.hpp"
#include "polder/stage/stress_at_rest.hpp"
#include "polder/step/ground_water.hpp"
#include "polder/step/open_water.hpp"

namespace polder {

namespace {

constexpr std::uint64_t steps_at_rest = 100;  // in a row, until a stage counts as at rest

template <class Space>
void put_walls(const Model& model, const std::vector<bool>& stands, double time, Setup<Space>& setup) {
  setup.walls = make_thin_walls(model, setup.lattice, stands);
  setup.bodies = make_bodies(model, setup.lattice, stands, time);
  setup.friction = friction_faces(model, setup.lattice, stands);
}

/// Free water on unsaturated ground, over the outline by which its step knows the ground: filled to the outline of the
/// case, which passes between the points of the soil, it would begin with cells that are too full and others that are
/// not full.
template <class Space>
WaterPoints<Space> water_over(const Setup<Space>& setup, const SoilPoints<Space>& soil, Model model) {
  WallInput ground;
  ground.polygon = ground_outline(setup, ground_heights(setup, soil));
  if (!ground.polygon.empty()) model.walls.push_back(std::move(ground));
  model.soils.clear();
  model.unsaturated = false;  // the water's cells are cut as without pores
  return seed_points<Space>(model, setup.lattice).water;
}

template <class Space>
Stepper<Space> make_stepper(const Model& model, int threads) {
  Setup<Space> setup = make_setup<Space>(model);
  SeededPoints<Space> points = seed_points<Space>(model, setup.lattice);
  mark_loaded_points(model, setup.lattice, -1, points.soil);
  set_stress_at_rest(model, setup, points.soil);
  start_law_state(setup, 0, points.soil);
  const double start = std::accumulate(model.stages.begin(), model.stages.end(), 0.0,
                                       [](double t, const Stage& s) { return s.initial ? t - s.duration : t; });
  put_walls(model, standing(model, 0, start), start, setup);
  if (setup.unsaturated && Space::axes == 2 && !model.free_water.empty())
    points.water = water_over(setup, points.soil, model);
  return Stepper<Space>(std::move(setup), std::move(points.soil), std::move(points.water), threads);
}

}  // namespace

template <class Space>
Simulation<Space>::Simulation(const Model& model, int threads)
    : model_(with_steady_seepage(model)),
      stepper_(make_stepper<Space>(model_, threads)),
      audit_(model_, stepper_),
      guards_(stepper_) {
  for (const Stage& stage : model_.stages)
    (stage.initial ? time_ : end_time_) += stage.initial ? -stage.duration : stage.duration;
  stage_ends_.assign(model_.stages.size(), -1);
  restless_.assign(model_.stages.size(), 0);
  bodies_move_ = any_body_moves(model_);
  stepper_.setup.weighs_bodies = std::any_of(model_.monitors.begin(), model_.monitors.end(),
                                             [](const Monitor& m) { return m.kind == MonitorKind::wall; });
  set_numerics();
  raise_walls();
}

template <class Space>
std::vector<StageEnd> Simulation<Space>::stage_ends() const {
  std::vector<StageEnd> ends;
  for (std::size_t i = 0; i < stage_; ++i) ends.push_back({model_.stages[i].name, stage_ends_[i], restless_[i]});
  return ends;
}

/// What the stage says of the method, and the wells that are there.
template <class Space>
void Simulation<Space>::set_numerics() {
  if (finished()) return;
  stepper_.setup.wells = make_wells(model_, stepper_.setup.lattice, stage_);
  Numerics& numerics = stepper_.setup.numerics;
  numerics.mass_scaling = stage()->mass_scaling.value_or(model_.numerics.mass_scaling);
  numerics.step_stretch = stage()->step_stretch.value_or(model_.numerics.step_stretch);
}

/// The walls that stand now; gates whose time has come vanish.
template <class Space>
void Simulation<Space>::raise_walls() {
  if (model_.walls.empty()) return;
  std::vector<bool> now = standing(model_, stage_, time_);
  if (now == standing_) return;
  standing_ = std::move(now);
  put_walls(model_, standing_, time_, stepper_.setup);
  stepper_.walls_changed();
}

/// s until the next gate vanishes: a step ends there.
template <class Space>
double Simulation<Space>::to_next_gate() const {
  double least = std::numeric_limits<double>::infinity();
  for (const WallInput& wall : model_.walls)
    if (stands_at(wall, time_)) least = std::min(least, wall.until - time_);
  return least;
}

/// The natural step, shortened where a body would go more than a quarter of a cell in it.
template <class Space>
double Simulation<Space>::step_of_bodies(double dt) const {
  const auto& spacing = stepper_.setup.lattice.spacing;
  for (int turn = 0; turn < 20; ++turn) {
    double way = 0;  // cells
    for (const WallInput& wall : model_.walls) {
      const Point2 now = displacement_at(wall, time_), then = displacement_at(wall, time_ + dt);
      way = std::max({way, std::abs(then[0] - now[0]) / spacing[0], std::abs(then[1] - now[1]) / spacing[Space::up]});
    }
    if (way <= 0.25) break;
    dt *= std::max(0.1, 0.2 / way);
  }
  return dt;
}

template <class Space>
StepReport Simulation<Space>::advance() {
  const Stage& stage = model_.stages[stage_];
  StepControl control;
  control.damping = stage.damping;
  control.water_damping = stage.water_damping;
  control.local_damping = stage.local_damping;
  control.hold_water = stage.hold_water;
  control.body_force = body_force;
  control.event = !stage.initial;
  if (stage.until_rest) control.rest_force = stage.rest_force;
  if (stage.ramp > 0) control.gravity_factor = std::min(1.0, time_in_stage_ / stage.ramp);

  if (stepper_.unsorted()) guards_.before_step(stepper_, time_);  // the points have not come from a step alone
  const double natural = bodies_move_ ? step_of_bodies(stepper_.natural_step()) : stepper_.natural_step();
  const double left = stage.duration - time_in_stage_;
  const double until = std::min(left, to_next_gate());
  double dt = natural >= until * (1 - 1e-9) ? until : natural;
  // no sliver of a step is left over: what has gathered in a full step would be put right in a moment, with a blow
  if (dt < until && until < 1.5 * dt) dt = until / 2;
  bool last = dt >= left * (1 - 1e-9);
  if (last) dt = left;
  if (!(dt > 0) || (!last && natural < 1e-9 * std::min(stage.duration, 1.0)))
    throw RunFailure(fmt::format("the time step collapsed to {:.3g} s at t = {:.6g} s (fastest point: {:.3g} cells/s)",
                                 dt, time_, stepper_.motion.speed));
  control.time = time_ + dt;
  if (bodies_move_) {
    stepper_.setup.bodies = make_bodies(model_, stepper_.setup.lattice, standing_, time_, dt);
    stepper_.walls_changed();
  }
  const StepReport report = stepper_.advance(control, dt);
  time_in_stage_ += dt;
  time_ += dt;
  const std::string unsound = unsound_point_after_step(stepper_, stepper_.team);
  audit_.take(stepper_, dt, stepper_.team);
  audit_.pressure_iterations += static_cast<std::uint64_t>(report.pressure.iterations);
  audit_.volume_iterations += static_cast<std::uint64_t>(report.volume.iterations);
  guards_.take(stepper_, audit_, report, unsound, time_,
               !stage.initial && stage.ramp <= 0 && !stepper_.setup.driven() && !bodies_move_ && !body_force);
  if (stage.until_rest && time_in_stage_ >= stage.ramp) {
    const Unrest now = unrest(stepper_, dt);
    const bool calm = now.energy <= stage.rest_energy && now.force <= stage.rest_force;
    calm_steps_ = calm ? calm_steps_ + 1 : 0;
    const bool at_rest = calm_steps_ >= steps_at_rest;
    if (last && !at_rest) restless_[stage_] = now.force;
    last = last || at_rest;
  }
  if (last) end_stage();
  raise_walls();
  return report;
}

template <class Space>
std::string Simulation<Space>::flaw() {
  if (stage_ > model_.stages.size() || !std::isfinite(time_) || !std::isfinite(time_in_stage_))
    return "its time is in no stage of the case";
  if (stage_ends_.size() != model_.stages.size() || restless_.size() != model_.stages.size())
    return "its stages are not those of the case";
  if (!(stepper_.drift_soil >= 0) || !(stepper_.drift_water >= 0) || !(stepper_.motion.speed >= 0))
    return "the drift or the speed of its points is not a number";
  if (stepper_.open_water && !stepper_.open_water->sound())
    return "what its free water owes the ground is not a number";
  return flaw_of(stepper_, !stepper_.unsorted());
}

template <class Space>
void Simulation<Space>::end_stage() {
  const bool was_initial = model_.stages[stage_].initial;
  stage_ends_[stage_] = time_in_stage_;
  ++stage_;
  time_in_stage_ = 0;
  calm_steps_ = 0;
  if (stepper_.unsaturated) stepper_.unsaturated->begin_stage();
  if (was_initial && (finished() || !model_.stages[stage_].initial)) begin_event();
  if (!finished()) begin_stage();
}

template <class Space>
void Simulation<Space>::begin_event() {
  auto& soil = stepper_.soil;
  for (auto& v : soil.velocity) std::fill(v.begin(), v.end(), 0.0);
  std::fill(soil.deviatoric_strain.begin(), soil.deviatoric_strain.end(), 0.0);
  std::fill(soil.state[0].begin(), soil.state[0].end(), 0.0);
  soil.reference = soil.position;
  time_ = 0;
  audit_ = Audit<Space>(model_, stepper_);
  guards_.begin_event(stepper_);
}

template <class Space>
void Simulation<Space>::begin_stage() {
  set_numerics();
  const auto stage = static_cast<int>(stage_);
  if (std::any_of(model_.changes.begin(), model_.changes.end(),
                  [&](const GroundChange& c) { return c.stage == stage; })) {
    audit_.take(stepper_, change_ground(model_, stage_, stepper_));
    guards_.begin_event(stepper_);
  }
  mark_loaded_points(model_, stepper_.setup.lattice, stage, stepper_.soil);
}

template <class Space>
double Simulation<Space>::pressure_at(const std::array<double, 3>& x) const {
  if (stepper_.open_water && stepper_.open_water->covers(x)) return stepper_.open_water->pressure_at(x);
  if (stepper_.unsaturated) return stepper_.unsaturated->pressure_at(stepper_.setup, stepper_.grid, x);
  const auto cell = cell_of(stepper_.setup.lattice, x);
  return stepper_.grid.pressure[stepper_.setup.lattice.index(cell[0], cell[1], cell[2])];
}

template class Simulation<PlaneStrain>;
template class Simulation<Solid>;

}  // namespace polder
