// Time per point of every soil law, elastic and plastic, in plane strain and three dimensions, and of the drag laws.
// The counter `per_point` is the inverse rate: read "3.1n" as 3.1 ns a point. A batch is copied before each update (the
// law overwrites it); "copy" is that part alone.
#include <benchmark/benchmark.h>

#include <map>
#include <random>
#include <string>

#include "polder/material/drag.hpp"
#include "polder/material/law.hpp"

namespace polder {
namespace {

const std::map<std::string_view, std::map<std::string_view, double>> examples = {
    {"linear-elastic", {{"young_modulus", 1e7}}},
    {"mohr-coulomb", {{"young_modulus", 1e7}, {"friction_angle", 0.6}, {"cohesion", 1e3}, {"dilatancy_angle", 0.1}}},
    {"softening-mohr-coulomb",
     {{"young_modulus", 1e7},
      {"friction_angle", 0.6},
      {"cohesion", 1e3},
      {"residual_friction_angle", 0.4},
      {"softening_slip", 0.01}}},
    {"tresca", {{"young_modulus", 1e7}, {"undrained_shear_strength", 2e4}}},
    {"drucker-prager", {{"young_modulus", 1e7}, {"friction_angle", 0.6}, {"cohesion", 1e3}, {"dilatancy_angle", 0.1}}},
    {"modified-cam-clay",
     {{"compression_index", 0.2}, {"swelling_index", 0.03}, {"friction_angle", 0.44}, {"overconsolidation_ratio", 3}}},
};

std::unique_ptr<SoilLaw> make(const LawDescription& law) {
  std::vector<double> values;
  const auto& given = examples.at(law.name);
  for (const Parameter& p : law.parameters) values.push_back(given.contains(p.key) ? given.at(p.key) : p.standard);
  return law.make(values, {0.05, 0.4, 0.5});
}

/// Points about a pressure of 100 kPa; strains small, or large enough that nearly all of them yield.
template <int N>
StressBatch<N> points(const SoilLaw& law, bool plastic) {
  std::mt19937 engine(1);
  std::normal_distribution<double> normal;
  StressBatch<N> batch{};
  batch.count = StressBatch<N>::capacity;
  const std::size_t used = law.state_names().size();
  for (int i = 0; i < batch.count; ++i) {
    for (int k = 0; k < N; ++k) {
      batch.stress[k][i] = (k < 3 ? -1e5 : 0) + 5e3 * normal(engine);
      batch.strain[k][i] = (plastic && k >= 3 ? 5e-2 : 1e-6) * normal(engine);
    }
    batch.porosity[i] = 0.41;
    double state[StressBatch<N>::max_state - 1] = {};
    law.initial_state(1e5, 0.41, std::span(state).first(used));
    for (std::size_t k = 0; k < used; ++k) batch.state[k + 1][i] = state[k];
  }
  return batch;
}

template <int N>
void update(benchmark::State& state, const LawDescription& description, bool plastic) {
  const auto law = make(description);
  const StressBatch<N> start = points<N>(*law, plastic);
  StressBatch<N> batch = start;
  law->update(batch);
  int yielded = 0;
  for (int i = 0; i < batch.count; ++i) yielded += batch.state[0][i] > 0;
  for (auto _ : state) {
    batch = start;
    law->update(batch);
    benchmark::DoNotOptimize(batch.stress[0][0]);
    benchmark::ClobberMemory();
  }
  state.counters["per_point"] = benchmark::Counter(
      StressBatch<N>::capacity, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["yielding"] = yielded;
}

template <int N>
void copy(benchmark::State& state) {
  StressBatch<N> start{}, batch{};
  start.count = StressBatch<N>::capacity;
  for (auto _ : state) {
    benchmark::DoNotOptimize(&start);
    batch = start;
    benchmark::DoNotOptimize(&batch);
    benchmark::ClobberMemory();
  }
  state.counters["per_point"] = benchmark::Counter(
      StressBatch<N>::capacity, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void drag(benchmark::State& state, DragLaw law) {
  DragInput in;
  in.law = law;
  in.grain_diameter = 2e-3;
  const Drag coefficients = make_drag(in);
  constexpr int count = 1024;
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> porosity(0.3, 0.95), flow(0, 0.1);
  std::vector<double> n(count), q(count), c(count);
  for (int i = 0; i < count; ++i) n[i] = porosity(engine), q[i] = flow(engine);
  for (auto _ : state) {
    for (int i = 0; i < count; ++i) c[i] = drag_coefficient(coefficients, n[i], q[i]);
    benchmark::DoNotOptimize(c.data());
    benchmark::ClobberMemory();
  }
  state.counters["per_point"] =
      benchmark::Counter(count, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

const bool registered = [] {
  for (const LawDescription& law : soil_laws()) {
    if (!examples.contains(law.name)) continue;
    for (const bool plastic : {false, true}) {
      if (plastic && law.name == "linear-elastic") continue;
      const std::string name = std::string(law.name) + (plastic ? "/plastic/" : "/elastic/");
      benchmark::RegisterBenchmark((name + "2d").c_str(), [&law, plastic](auto& s) { update<4>(s, law, plastic); });
      benchmark::RegisterBenchmark((name + "3d").c_str(), [&law, plastic](auto& s) { update<6>(s, law, plastic); });
    }
  }
  benchmark::RegisterBenchmark("copy/2d", copy<4>);
  benchmark::RegisterBenchmark("copy/3d", copy<6>);
  benchmark::RegisterBenchmark("drag/ergun", [](auto& s) { drag(s, DragLaw::ergun); });
  benchmark::RegisterBenchmark("drag/gidaspow", [](auto& s) { drag(s, DragLaw::gidaspow); });
  benchmark::RegisterBenchmark("drag/beetstra", [](auto& s) { drag(s, DragLaw::beetstra); });
  return true;
}();

}  // namespace
}  // namespace polder
