#include "polder/verify/bench.hpp"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>

#include "polder/stage/simulation.hpp"
#include "polder/step/kernels.hpp"

namespace polder::verify {
namespace {

/// B, without what earlier models have given back.
double resident_size() {
  malloc_trim(0);
  std::ifstream status("/proc/self/statm");
  double pages = 0, resident = 0;
  status >> pages >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

StepTimes since(const StepTimes& start, StepTimes now) {
  for (const Kernel& kernel : kernels) now.*kernel.seconds -= start.*kernel.seconds;
  return now;
}

template <class Space>
Timing time_of(const Model& model, int steps, int threads) {
  Timing timing;
  timing.name = model.name;
  timing.space = model.space;
  const double before = resident_size();
  Simulation<Space> run(model, threads);
  for (int i = 0; i < std::max(2, steps / 10) && !run.finished(); ++i) run.advance();
  const StepTimes at_start = run.state().times;
  const std::uint64_t iterations = run.audit().pressure_iterations;
  const auto start = std::chrono::steady_clock::now();
  int done = 0;
  for (; done < steps && !run.finished(); ++done) run.advance();
  timing.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const Stepper<Space>& state = run.state();
  timing.steps = done;
  timing.memory = resident_size() - before;
  timing.kernels = since(at_start, state.times);
  timing.iterations = static_cast<double>(run.audit().pressure_iterations - iterations) / std::max(done, 1);
  timing.threads = state.team.size();
  timing.soil_points = state.soil.size();
  timing.water_points = state.water.size();
  timing.wet_cells = static_cast<std::size_t>(std::count(state.grid.wet.begin(), state.grid.wet.end(), 1));
  return timing;
}

}  // namespace

Model block(const Model& like, SpaceKind space, double soil_points) {
  Model model = like;
  const int axes = space == SpaceKind::solid ? 3 : 2;
  const double per_cell = std::pow(model.points_per_axis, axes);
  // One row of cells stays free above the soil.
  const int cells = std::max(4, static_cast<int>(std::lround(std::pow(soil_points / per_cell, 1.0 / axes))));
  const double width = cells * model.cell[0];
  model.name = "block";
  model.space = space;
  model.cell = {model.cell[0], model.cell[0], axes == 3 ? model.cell[0] : 0};
  model.size = {width, width, axes == 3 ? width : 0};
  model.size[static_cast<std::size_t>(axes) - 1] += model.cell[0];
  SoilBody soil;
  soil.region.polygon = {{0, 0}, {width, 0}, {width, width}, {0, width}};
  model.soils = {soil};
  model.water_table = {{0, width}, {width, width}};
  model.initial_stress = InitialStress::k0;
  model.free_water.clear();
  model.boundaries.clear();
  model.walls.clear();
  model.loads.clear();
  model.changes.clear();
  model.monitors.clear();
  Stage stage;
  stage.name = "rest";
  stage.duration = 1e9;
  model.stages = {stage};
  return model;
}

Timing time_steps(const Model& model, int steps, int threads) {
  return model.space == SpaceKind::solid ? time_of<Solid>(model, steps, threads)
                                         : time_of<PlaneStrain>(model, steps, threads);
}

}  // namespace polder::verify
