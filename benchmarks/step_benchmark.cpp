// Time per point of every kernel of a step, in plane strain and three dimensions, at 1e5 and 1e6 points of each phase,
// one thread. The counter `per_point` is the inverse rate: read "31n" as 31 ns a point (of the phase named, else of a
// pair; of a wet cell and iteration for pressure_solve).
#include <benchmark/benchmark.h>

#include <functional>
#include <string>

#include "block.hpp"

namespace polder {
namespace {

void count_points(benchmark::State& state, double points) {
  state.counters["per_point"] =
      benchmark::Counter(points, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <class Space>
void soil_points_to_grid(benchmark::State& state, double points) {
  Block<Space> block(points, "drucker-prager");
  for (auto _ : state) soil_to_grid(block.setup, block.soil, block.soil_tiling, 0, block.grid, block.team);
  count_points(state, static_cast<double>(block.soil.size()));
}

template <class Space>
void water_points_to_grid(benchmark::State& state, double points) {
  Block<Space> block(points, "drucker-prager");
  block.to_grid();
  for (auto _ : state)
    water_to_grid(block.setup, block.soil, block.soil_tiling, block.water, block.water_tiling, block.grid, block.team);
  count_points(state, static_cast<double>(block.water.size()));
}

template <class Space>
void faces_with_drag(benchmark::State& state, double points) {
  Block<Space> block(points, "drucker-prager");
  block.to_grid();
  const FaceField<Space> soil = block.grid.soil_velocity, water = block.grid.water_velocity;
  for (auto _ : state) {
    state.PauseTiming();  // momenta become velocities
    block.grid.soil_velocity = soil;
    block.grid.water_velocity = water;
    state.ResumeTiming();
    block.predict();
  }
  count_points(state, static_cast<double>(block.soil.size()));
}

template <class Space>
void pressure_solve(benchmark::State& state, double points) {
  Block<Space> block(points, "drucker-prager");
  block.to_grid();
  block.predict();
  const FaceField<Space> soil = block.grid.soil_velocity, water = block.grid.water_velocity;
  PressureSolver<Space> solver(block.setup.lattice);
  double iterations = 0;
  for (auto _ : state) {
    state.PauseTiming();
    block.grid.soil_velocity = soil;
    block.grid.water_velocity = water;
    std::fill(block.grid.pressure.begin(), block.grid.pressure.end(), 0.0);
    state.ResumeTiming();
    iterations += project(block.setup, Block<Space>::dt, {}, block.grid, solver, block.team).iterations;
  }
  const auto& wet = block.grid.wet;
  iterations /= static_cast<double>(state.iterations());
  state.counters["iterations"] = iterations;
  count_points(state, static_cast<double>(std::count(wet.begin(), wet.end(), 1)) * iterations);
}

template <class Space>
void volume_correction(benchmark::State& state, double points) {
  Block<Space> block(points, "drucker-prager");
  block.to_grid();
  block.predict();
  PressureSolver<Space> solver(block.setup.lattice);
  for (auto _ : state) correct_volume(block.setup, block.grid, solver, block.team);
  count_points(state, static_cast<double>(block.soil.size()));
}

template <class Space>
void water_grid_to_points(benchmark::State& state, double points) {
  Block<Space> block(points, "drucker-prager");
  block.move_grid();
  for (auto _ : state)
    grid_to_water(block.setup, Block<Space>::dt, block.grid, block.water_tiling, block.water, block.team);
  count_points(state, static_cast<double>(block.water.size()));
}

template <class Space>
void soil_grid_to_points(benchmark::State& state, double points, const std::string& law) {
  Block<Space> block(points, law);
  block.move_grid();
  for (auto _ : state)
    grid_to_soil(block.setup, Block<Space>::dt, block.grid, block.soil_tiling, block.soil, block.team);
  count_points(state, static_cast<double>(block.soil.size()));
}

template <class Space>
void sort(benchmark::State& state, double points) {
  Block<Space> block(points, "drucker-prager");
  for (auto _ : state) {
    sort_points(block.setup.lattice, block.soil, block.soil_tiling, block.team);
    sort_points(block.setup.lattice, block.water, block.water_tiling, block.team);
  }
  count_points(state, static_cast<double>(block.soil.size()));
}

template <class Space>
void register_all(const std::string& space) {
  const std::pair<std::string, std::function<void(benchmark::State&, double)>> kernels[] = {
      {"points_to_grid/soil", soil_points_to_grid<Space>},
      {"points_to_grid/water", water_points_to_grid<Space>},
      {"faces_with_drag", faces_with_drag<Space>},
      {"pressure_solve", pressure_solve<Space>},
      {"volume_correction", volume_correction<Space>},
      {"grid_to_points/water", water_grid_to_points<Space>},
      {"grid_to_points/soil/drucker-prager",
       [](auto& s, double n) { soil_grid_to_points<Space>(s, n, "drucker-prager"); }},
      {"grid_to_points/soil/mohr-coulomb", [](auto& s, double n) { soil_grid_to_points<Space>(s, n, "mohr-coulomb"); }},
      {"sort", sort<Space>}};
  for (const auto& [name, kernel] : kernels)
    for (const auto& [size, points] : {std::pair{"1e5", 1e5}, std::pair{"1e6", 1e6}}) {
      const std::string full = name + "/" + space + "/" + size;
      benchmark::RegisterBenchmark(full.c_str(), [kernel, points](benchmark::State& s) { kernel(s, points); })
          ->Unit(benchmark::kMillisecond)
          ->MinTime(0.3);
    }
}

const bool registered = [] {
  keep_arrays_together();
  register_all<PlaneStrain>("2d");
  register_all<Solid>("3d");
  return true;
}();

}  // namespace
}  // namespace polder
