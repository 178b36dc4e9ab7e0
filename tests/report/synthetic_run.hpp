#pragma once
// A run's folder written from closed formulas instead of a computation: a dike of two soils that slumps while the water
// behind it sinks and spreads. It has everything that a report shows; points split, flow out and change state.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "polder/result/history.hpp"
#include "polder/result/summary.hpp"
#include "polder/result/vtk.hpp"
#include "polder/result/vtk_reader.hpp"

namespace polder {

struct SyntheticRun {
  double spacing = 0.05;  ///< m, of the points
  int frames = 24;
  double duration = 12;  ///< s
  bool finished = true;  ///< false: no summary.json, as while a run goes on
};

namespace synthetic {

inline constexpr double length = 6, height = 1.4, crest = 1, foot = 2, toe = 4.2, level = 0.8;

inline double surface(double x) { return x < foot || x > toe ? 0 : std::min(crest, (toe - x) / (toe - foot - 0.2)); }

/// How far the slump has gone, 0…1, and how fast it goes, 1/s.
inline double progress(double t) { return 1 / (1 + std::exp(-(t - 6))); }
inline double pace(double t) { return progress(t) * (1 - progress(t)); }

inline Frame frame_at(const SyntheticRun& run, double t) {
  Frame frame;
  frame.time = t;
  frame.title = "A slumping dike, from formulas";
  frame.size = {length, height, 0};
  frame.outlines = {{{foot, 0}, {foot, crest}, {foot + 0.2, crest}, {toe, 0}, {foot, 0}}};
  const double d = run.spacing, done = progress(t), rate = pace(t);
  std::vector<double> porosity, pressure, excess, stress, strain, displacement, velocity, material, fluid;
  std::uint64_t id = 1;
  for (double x = foot + d / 2; x < toe; x += d)
    for (double y = d / 2; y < surface(x); y += d, ++id) {
      const double share = (x - foot) / (toe - foot) * y;
      const double ux = 0.9 * share, uy = -0.35 * share * y;
      const double p = std::max(0.0, 9810 * (level * (toe - x) / (toe - foot) - y));
      frame.soil.id.push_back(id);
      frame.soil.position.push_back({x + ux * done, y + uy * done, 0});
      frame.soil.volume.push_back(d * d);
      porosity.push_back(0.4 + 0.12 * done * share);
      pressure.push_back(p * (1 - 0.3 * done));
      excess.push_back(-0.3 * p * done);
      const double vertical = -9.81 * 1000 * (surface(x) - y);
      stress.insert(stress.end(), {0.5 * vertical, vertical, 0.5 * vertical, 0.1 * vertical});
      strain.push_back(done * share);
      displacement.insert(displacement.end(), {ux * done, uy * done});
      velocity.insert(velocity.end(), {ux * rate, uy * rate});
      material.push_back(y < 0.4 ? 0 : 1);
      fluid.push_back(porosity.back() > 0.48 ? 1 : 0);
    }
  frame.soil.fields = {make_field("porosity", porosity),        make_field("pore_pressure", pressure),
                       make_field("excess_pressure", excess),   make_field("effective_stress", stress, 4),
                       make_field("deviatoric_strain", strain), make_field("displacement", displacement, 2),
                       make_field("velocity", velocity, 2),     make_field("material", material),
                       make_field("liquefied", fluid)};

  std::vector<double> water_pressure, water_velocity;
  const double drop = 0.25 * done;
  for (std::uint64_t column = 0; (static_cast<double>(column) + 0.5) * d < foot; ++column)
    for (std::uint64_t row = 0; (static_cast<double>(row) + 0.5) * d < level - drop; ++row) {
      const double x = (static_cast<double>(column) + 0.5) * d, y = (static_cast<double>(row) + 0.5) * d;
      frame.water.id.push_back(column * 1000 + row);
      frame.water.position.push_back({x, y, 0});
      frame.water.volume.push_back(d * d);
      water_pressure.push_back(9810 * (level - drop - y));
      water_velocity.insert(water_velocity.end(), {0.2 * rate, -0.25 * rate});
    }
  for (std::uint64_t k = 0; static_cast<double>(k) * d < 1.6 * done; ++k) {  // what has come through
    const double x = toe + static_cast<double>(k) * d;
    frame.water.id.push_back(1000000 + k);
    frame.water.position.push_back({x, d / 2, 0});
    frame.water.volume.push_back(d * d);
    water_pressure.push_back(9810 * d / 2);
    water_velocity.insert(water_velocity.end(), {1.6 * rate, 0});
  }
  frame.water.fields = {make_field("pressure", water_pressure), make_field("velocity", water_velocity, 2)};
  return frame;
}

inline nlohmann::ordered_json inputs() {
  return nlohmann::ordered_json::parse(R"json({
    "name": "slump", "file": "slump/case.toml",
    "model": {"title": "A slumping dike, from formulas", "space": "plane strain", "size": [6, 1.4], "cell": [0.1, 0.1],
              "gravity": 9.81, "points_per_axis": 2},
    "water": {"density": 1000, "bulk_modulus": 2.2e9, "viscosity": 0.001},
    "material": [
      {"name": "sand", "law": "mohr-coulomb", "grain_density": 2700, "porosity": 0.4, "max_porosity": 0.5,
       "drag": "ergun", "grain_diameter": 0.002, "youngs_modulus": 1e6, "poissons_ratio": 0.15,
       "friction_angle": 0.610865238},
      {"name": "loose <sand>", "law": "mohr-coulomb", "grain_density": 2700, "porosity": 0.45, "max_porosity": 0.5,
       "drag": "ergun", "grain_diameter": 0.002, "youngs_modulus": 5e5, "poissons_ratio": 0.15,
       "friction_angle": 0.523598776}],
    "boundary": [{"name": "base", "side": "base", "soil": "rough", "water": "closed"},
                 {"name": "river", "side": "left", "soil": "none", "water": "reservoir", "head": [[0, 0.8], [6, 0.6]]}],
    "stage": [{"name": "gravity", "duration": 1, "initial": true, "ramp": 0.7, "damping": 10},
              {"name": "seepage", "duration": 12, "initial": false}],
    "monitor": [{"name": "crest", "kind": "point", "quantity": "displacement", "at": [[2.1, 0.95]]},
                {"name": "toe", "kind": "point", "quantity": "porosity", "at": [[4.05, 0.05]]}]
  })json");
}

inline constexpr const char* expected = R"toml(
[[compare]]
quantity  = "settlement of the crest"
at        = "the end"
monitor   = "crest: settlement"
reference = 0.1
tolerance = 0.005
source    = "the formula, 0.1 m / (1 + exp(-6))"

[[compare]]
quantity  = "porosity of the toe"
at        = "6 s"
monitor   = "toe porosity"
time      = "6 s"
reference = 0.5
tolerance = 0.02
source    = "wrong on purpose"

[[compare]]
quantity  = "difference between grids"
reference = 0
tolerance = 0.1
source    = "what one run cannot answer"

[[show]]
quantity  = "run-out"
result    = "run-out"
reference = "some decimetres"
source    = "a picture"
)toml";

}  // namespace synthetic

/// Writes the folder anew.
inline void write_synthetic_run(const std::filesystem::path& folder, const SyntheticRun& run) {
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  VtkSeries series;
  for (int k = 0; k < run.frames; ++k) {
    const Frame frame = synthetic::frame_at(run, run.duration * k / (run.frames - 1));
    if (k == 0) write_section(folder, frame);
    add_snapshot(folder, series, frame);
  }
  HistoryFile history(folder / "history.csv", {{"crest: height", "m"},
                                               {"crest: settlement", "m"},
                                               {"toe porosity", ""},
                                               {"energy: kinetic of the soil", "J/m"},
                                               {"energy: kinetic of the water", "J/m"},
                                               {"water balance error", ""},
                                               {"time step", "s"}});
  for (int k = 0; k <= 240; ++k) {
    const double t = run.duration * k / 240, done = synthetic::progress(t), rate = synthetic::pace(t);
    history.append(t, std::vector{1 - 0.1 * done, 0.1 * done, 0.4 + 0.12 * done, 90 * rate, 30 * rate + 1,
                                  1e-14 * std::sin(t), 0.001 - 0.001 * rate});
  }
  std::ofstream(folder / "expected.toml") << synthetic::expected;
  if (!run.finished) return;
  Summary summary;
  summary.reason = "the end of the last stage was reached";
  summary.simulated_time = run.duration;
  summary.steps = 12345;
  summary.wall_seconds = 31;
  summary.soil_points = 1200;
  summary.water_points = 640;
  summary.cells = 840;
  summary.point_steps_per_second = 3.2e6;
  summary.pressure_iterations_per_step = 3.6;
  summary.water_balance_error = 3e-15;
  summary.solid_mass_error = 1e-15;
  summary.state_hash = "0123456789abcdef";
  summary.energy = {{"kinetic", 1.2}, {"potential", 5400.0}};
  summary.maxima = {{"soil speed", 0.22}, {"water pressure", 7800.0}};
  summary.case_inputs = synthetic::inputs();
  write_summary(folder / "summary.json", summary);
}

}  // namespace polder
