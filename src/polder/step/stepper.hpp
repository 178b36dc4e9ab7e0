#pragma once
// One time step of the double-point formulation, and the state it works on. docs/theory.md has the equations.
#include <memory>
#include <optional>
#include <string>

#include "polder/points/tiles.hpp"
#include "polder/step/body_forces.hpp"
#include "polder/step/fields.hpp"
#include "polder/step/grid_to_points.hpp"
#include "polder/step/open_water.hpp"
#include "polder/step/projection.hpp"
#include "polder/step/reservoirs.hpp"
#include "polder/step/setup.hpp"
#include "polder/step/unsaturated_step.hpp"
#include "polder/step/wells.hpp"

namespace polder {

/// What a step did.
struct StepReport {
  double dt = 0;  ///< s
  SolveResult pressure, volume;
};

/// Wall time by phase of the step, s.
struct StepTimes {
  double sort = 0, to_grid = 0, faces = 0, pressure = 0, volume = 0, to_points = 0, resample = 0;
};

template <class Space>
class Stepper {
 public:
  Stepper(Setup<Space> setup, SoilPoints<Space> soil, WaterPoints<Space> water, int threads);

  /// The step that stability and accuracy allow now, s.
  double natural_step() const;
  StepReport advance(const StepControl& control, double dt);

  /// After points were added, removed or moved from outside.
  void points_changed() {
    unsorted_ = true;
    if (open_water) open_water->points_changed();
  }
  bool unsorted() const { return unsorted_ != 0 || (open_water && open_water->unsorted()); }
  /// After thin walls or bodies of the setup have become others.
  void walls_changed() {
    if (open_water) open_water->walls_changed();
  }

  /// Everything that the next steps depend on, by name: archive(name, value or array). Restoring ends with restored().
  template <class Archive>
  void each_state(Archive&& archive) {
    each_own_state(archive);
    if (open_water) open_water->each_state(archive);
  }
  template <class Archive>  // but for the free water of unsaturated ground, which has a stepper of its own
  void each_own_state(Archive&& archive) {
    soil.each_array(
        [&](const char* name, int c, auto& a) { archive("soil/" + std::string(name) + std::to_string(c), a); });
    water.each_array(
        [&](const char* name, int c, auto& a) { archive("water/" + std::string(name) + std::to_string(c), a); });
    archive("grid/pressure", grid.pressure);
    archive("grid/pressure_trend", grid.pressure_trend);
    archive("grid/potential_trend", grid.potential_trend);
    for (int c = 0; c < Space::axes; ++c) archive("grid/relative_flux" + std::to_string(c), grid.relative_flux[c]);
    if (!setup.open_sides.empty()) archive("grid/owed", grid.owed);
    if (!setup.rains.empty()) archive("grid/rain", grid.rain);
    if (!grid.spare.empty()) archive("grid/spare", grid.spare);
    if (setup.any_absorbs()) {
      for (int c = 0; c < Space::axes; ++c) archive("grid/far_force" + std::to_string(c), grid.far_force[c]);
      archive("grid/far_pressure", grid.far_pressure);
      archive("grid/far_impedance0", grid.far_impedance[0]);
      archive("grid/far_impedance1", grid.far_impedance[1]);
      archive("grid/far_is_known", grid.far_is_known);
    }
    if (setup.single_point)
      for (int c = 0; c < Space::axes; ++c) archive("grid/discharge" + std::to_string(c), grid.discharge[c]);
    if (unsaturated) unsaturated->each_state(archive);
    archive("step", step);
    archive("next_water_id", next_water_id);
    archive("speed", motion.speed);
    archive("drift_water", drift_water);
    archive("drift_soil", drift_soil);
    archive("unsorted", unsorted_);
  }
  void restored();

  Setup<Space> setup;
  SoilPoints<Space> soil;
  WaterPoints<Space> water;
  GridFields<Space> grid;
  std::uint64_t step = 0;  ///< steps taken
  std::uint64_t next_water_id = 0;
  Motion motion;                                        ///< of the last step
  double drift_water = 0, drift_soil = 0;               ///< cells, since the last sort
  std::vector<Exchange> exchanged;                      ///< with reservoirs, in the last step
  std::vector<BodyForce> body_force;                    ///< in the last step, where it is asked for
  std::unique_ptr<UnsaturatedStep<Space>> unsaturated;  ///< of that formulation
  std::unique_ptr<OpenWater<Space>> open_water;         ///< free water on its ground; likewise
  std::vector<WellFlow> sources;  ///< what the next step's pressure is to let in where water stands; others pay for it
  StepTimes times;
  Team team;

 private:
  void sort_water();
  void prepare();  // sorts what has drifted and finds the active rows
  void resample();
  void solve_beside(double dt, const std::vector<WellFlow>& wells, StepReport& report);
  bool begin_weighing();
  StepReport advance_unsaturated(const StepControl& control, double dt);

  Tiling<Space> soil_tiling_, water_tiling_;
  PressureSolver<Space> solver_;
  std::optional<PressureSolver<Space>> volume_solver_;  // where both systems are solved at the same time
  std::uint64_t unsorted_ = 1;
  bool rows_stale_ = true;  // points were sorted since the active rows were found
};

}  // namespace polder
