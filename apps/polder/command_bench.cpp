// polder bench: how fast the engine is on this machine.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "case_argument.hpp"
#include "commands.hpp"
#include "polder/result/atomic_file.hpp"
#include "polder/stage/guards.hpp"
#include "polder/step/kernels.hpp"
#include "polder/verify/bench.hpp"

namespace polder::cli {
namespace {

using verify::Timing;

struct BenchOptions {
  std::string case_name, json, space = "both";
  std::vector<std::string> overrides;
  std::vector<double> points{1e5};
  int steps = 20, threads = 1;
};

/// As in a heading: points_to_grid is "points to grid".
std::string spoken(const Kernel& kernel) {
  std::string name = kernel.key;
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

const char* space_name(const Timing& t) { return t.space == SpaceKind::solid ? "3d" : "plane strain"; }

/// ns per unknown and iteration of the pressure solve; 0 where nothing was solved.
double per_unknown(const Timing& t) {
  const double work = static_cast<double>(t.wet_cells) * t.iterations * t.steps;
  return work > 0 ? 1e9 * t.kernels.pressure / work : 0;
}

void print(const std::vector<Timing>& timings) {
  fmt::print("{:<14}{:<14}{:>10}{:>10}{:>9}{:>12}{:>12}{:>12}{:>12}{:>12}\n", "model", "space", "soil", "water",
             "threads", "Mpoints/s", "ns/point", "iterations", "ns/unknown", "bytes/point");
  for (const Timing& t : timings)
    fmt::print("{:<14}{:<14}{:>10}{:>10}{:>9}{:>12.2f}{:>12.1f}{:>12.1f}{:>12.2f}{:>12.0f}\n", t.name, space_name(t),
               t.soil_points, t.water_points, t.threads, 1e3 / t.per_point(t.seconds), t.per_point(t.seconds),
               t.iterations, per_unknown(t), t.memory / static_cast<double>(t.points()));
  fmt::print("\nns per point and step, by kernel:\n{:<28}", "");
  for (const Kernel& kernel : kernels) fmt::print("{:>16}", spoken(kernel));
  fmt::print("\n");
  for (const Timing& t : timings) {
    fmt::print("{:<28}", fmt::format("{}, {}, {}", t.name, space_name(t), t.points()));
    for (const Kernel& kernel : kernels) fmt::print("{:>16.1f}", t.per_point(t.kernels.*kernel.seconds));
    fmt::print("\n");
  }
  for (std::size_t i = 0; i + 1 < timings.size(); ++i) {
    const Timing &a = timings[i], &b = timings[i + 1];
    if (a.space != b.space || b.points() <= a.points()) continue;
    fmt::print("\nmemory grows by {:.0f} bytes a point between {} and {} points ({})",
               (b.memory - a.memory) / static_cast<double>(b.points() - a.points()), a.points(), b.points(),
               space_name(a));
  }
  fmt::print("\n");
}

nlohmann::ordered_json json_of(const Timing& t) {
  nlohmann::ordered_json json{{"model", t.name},
                              {"space", t.space == SpaceKind::solid ? "3d" : "plane-strain"},
                              {"threads", t.threads},
                              {"soil_points", t.soil_points},
                              {"water_points", t.water_points},
                              {"wet_cells", t.wet_cells},
                              {"steps", t.steps},
                              {"wall_seconds", t.seconds},
                              {"points_per_second", 1e9 / t.per_point(t.seconds)},
                              {"pressure_iterations_per_step", t.iterations},
                              {"pressure_ns_per_unknown_and_iteration", per_unknown(t)},
                              {"bytes_per_point", t.memory / static_cast<double>(t.points())}};
  for (const Kernel& kernel : kernels) json["kernel_seconds"][kernel.key] = t.kernels.*kernel.seconds;
  return json;
}

int bench(const BenchOptions& options) {
  std::vector<Model> models;
  if (options.case_name.empty()) {
    const Model dike = read_case_or_fail("dike-seepage", options.overrides);
    for (const SpaceKind space : {SpaceKind::plane_strain, SpaceKind::solid})
      if (options.space == "both" || (options.space == "3d") == (space == SpaceKind::solid))
        for (const double points : options.points) models.push_back(verify::block(dike, space, points));
  } else {
    models.push_back(read_case_or_fail(options.case_name, options.overrides));
  }
  std::vector<Timing> timings;
  try {
    for (const Model& model : models) {
      timings.push_back(verify::time_steps(model, options.steps, options.threads));
      if (timings.back().steps == 0 || timings.back().points() == 0)
        throw Failure(status_wrong_input, fmt::format("{} ends before its first timed step: give fewer --steps, or "
                                                      "longer stages",
                                                      model.name));
    }
  } catch (const RunFailure& failure) {
    throw Failure(status_failed, failure.what());
  }
  print(timings);
  if (!options.json.empty()) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const Timing& t : timings) rows.push_back(json_of(t));
    write_atomically(options.json, rows.dump(2) + "\n");
  }
  return status_done;
}

}  // namespace

void add_bench(CLI::App& polder, Action& action) {
  const auto options = std::make_shared<BenchOptions>();
  CLI::App* command = add_command(polder, "bench", "Speed and memory of the engine on this machine",
                                  "polder bench\n"
                                  "polder bench --space 3d --points 100000 1000000 --steps 10\n"
                                  "polder bench dike-seepage --steps 500 --threads 2\n"
                                  "polder bench --json speed.json");
  command->add_option("CASE", options->case_name,
                      "Case file, or the name of a shipped case (default: a saturated block of "
                      "dike-seepage's sand, at rest)");
  command->add_option("--points", options->points, "Soil points of the block, as many of water: one size or several")
      ->check(CLI::Range(100.0, 1e8));
  command->add_option("--space", options->space, "Of the block: plane-strain, 3d, or both")
      ->check(CLI::IsMember({"plane-strain", "3d", "both"}));
  command->add_option("--steps", options->steps, "Steps that are timed, after a tenth as many")
      ->check(CLI::Range(1, 1000000));
  command->add_option("--threads", options->threads, "Threads")->check(CLI::Range(1, 1024))->capture_default_str();
  command->add_option("--set", options->overrides, "Override a key of the case: section.key=value")
      ->allow_extra_args(false);
  command->add_option("--json", options->json, "Write the figures to this file as well");
  command->callback([=, &action] { action = [=] { return bench(*options); }; });
}

}  // namespace polder::cli
