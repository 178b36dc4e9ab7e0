// polder check: is the case right, how does it look, what will it cost.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "case_argument.hpp"
#include "commands.hpp"
#include "polder/case/estimate.hpp"
#include "polder/points/seed.hpp"
#include "polder/report/run_points.hpp"
#include "polder/result/atomic_file.hpp"
#include "polder/result/model_drawing.hpp"
#include "polder/result/output_error.hpp"
#include "polder/result/paint.hpp"

namespace polder::cli {
namespace {

using Json = nlohmann::ordered_json;

struct CheckOptions {
  std::string name, folder = ".";
  std::vector<std::string> overrides;
  bool json = false, no_drawing = false;
};

/// Measured with the dike at 1/20, 1/30 and 1/40 m on one core (5.7, 6.0, 6.6 M point-steps/s; resident at most, with
/// the report at the end, 67 MB at 1/20 and 190 MB at 1/40 m): the order of magnitude on other machines and models. In
/// 3d a point costs about twice as much.
constexpr double point_steps_per_second = 6e6, share_in_3d = 0.5;
constexpr double base_memory = 24e6, memory_per_point = 1000, memory_per_page_entry = 66;  // B

/// Seconds as one says them.
std::string spoken(double seconds) {
  if (seconds < 90) return fmt::format("{:.0f} s", std::max(seconds, 1.0));
  if (seconds < 90 * 60) return fmt::format("{:.0f} min", seconds / 60);
  if (seconds < 48 * 3600) return fmt::format("{:.0f} h", seconds / 3600);
  return fmt::format("{:.0f} days", seconds / 86400);
}

double computed_time(const Model& model) {
  double time = 0;
  for (const Stage& stage : model.stages) time += stage.duration;
  return time;
}

/// B, resident at most: the run, and beside it the points that the report's page moves.
double estimated_memory(const Model& model, double points) {
  double shown_time = 0;
  for (const Stage& stage : model.stages)
    if (!stage.initial) shown_time += stage.duration;
  const PageLimits limits;
  double moved = points;  // of a run in 3d, those in a slice two points thick
  if (model.space == SpaceKind::solid)
    moved *= std::min(1.0, 2 * model.cell[1] / (model.points_per_axis * model.size[1]));
  const double frames = std::min(shown_time / model.output.snapshot_interval + 1, static_cast<double>(limits.frames));
  const double entries = std::min(std::min(moved, limits.points) * frames, limits.entries);
  return base_memory + memory_per_point * points + memory_per_page_entry * entries;
}

std::vector<std::string> draw(const Model& model, const CheckOptions& options) {
  std::vector<std::string> files;
  if (options.no_drawing) return files;
  try {
    make_folder(options.folder);
    const Drawing drawing = draw_model(model);
    for (const char* ending : {".svg", ".png"}) {
      const auto path = std::filesystem::path(options.folder) / (model.name + "-model" + ending);
      write_drawing(path, drawing);
      files.push_back(path.lexically_normal().string());
    }
  } catch (const OutputError& error) {
    throw Failure(status_not_written, error.what());
  }
  return files;
}

Json diagnostics_json(const Diagnostics& diagnostics) {
  Json list = Json::array();
  for (const Diagnostic& d : diagnostics)
    list.push_back({{"severity", d.severity == Severity::error ? "error" : "warning"},
                    {"file", d.place.file},
                    {"line", d.place.line},
                    {"column", d.place.column},
                    {"key", d.key},
                    {"message", d.message},
                    {"help", d.help}});
  return list;
}

std::string extent(const Model& model, const std::array<double, 3>& lengths) {
  return model.space == SpaceKind::solid ? fmt::format("{:g} x {:g} x {:g} m", lengths[0], lengths[1], lengths[2])
                                         : fmt::format("{:g} x {:g} m", lengths[0], lengths[1]);
}

int check(const CheckOptions& options) {
  const ReadResult result = read_case(find_case_file(options.name), options.overrides);
  const Model& model = result.model;
  if (!options.json) std::cerr << format(result.diagnostics);
  Json json{{"case", model.name}, {"file", model.file}, {"ok", result.ok()}};
  if (result.ok()) {
    const double step = estimated_step(model), time = computed_time(model);
    const StepCount steps = estimated_steps(model);
    const bool stretched = steps.at_rest < 0.9 * steps.moving;
    const auto drawings = draw(model, options);
    const PointCount points = count_points(model);
    const double count = static_cast<double>(points.soil + points.water);
    const double speed = point_steps_per_second * (model.space == SpaceKind::solid ? share_in_3d : 1);
    const double wall = count * steps.moving / speed, wall_at_rest = count * steps.at_rest / speed;
    const double memory = estimated_memory(model, count);
    json.update({{"cells", cell_count(model)},
                 {"soil_points", points.soil},
                 {"water_points", points.water},
                 {"computed_time", time},
                 {"estimated_step", step},
                 {"estimated_steps", steps.moving},
                 {"estimated_steps_at_rest", steps.at_rest},
                 {"estimated_wall_seconds", wall},
                 {"estimated_wall_seconds_at_rest", wall_at_rest},
                 {"estimated_memory_bytes", memory}});
    json["drawings"] = drawings;
    if (!options.json) {
      std::cout << fmt::format("{}{}{}\n", model.name, model.title.empty() ? "" : ": ", model.title)
                << fmt::format("  size      {}, {}\n", extent(model, model.size),
                               model.space == SpaceKind::solid ? "3d" : "plane strain")
                << fmt::format("  grid      {} cells of {}\n", cell_count(model), extent(model, model.cell))
                << fmt::format("  points    {} of soil, {} of water\n", points.soil, points.water)
                << fmt::format("  time      {:g} s in {} stage{}\n", time, model.stages.size(),
                               model.stages.size() == 1 ? "" : "s")
                << fmt::format("  step      about {:.2g} s at the start, so {:.2g} steps{}\n", step, steps.moving,
                               stretched ? fmt::format("; {:.2g} if the ground is at rest", steps.at_rest) : "")
                << fmt::format("  cost      about {}{} on one core, {:.0f} MB\n",
                               stretched ? fmt::format("{} (at rest) to ", spoken(wall_at_rest)) : "", spoken(wall),
                               memory / 1e6);
      for (const std::string& file : drawings) std::cout << fmt::format("  drawing   {}\n", file);
    }
  }
  json["diagnostics"] = diagnostics_json(result.diagnostics);
  if (options.json) std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
  if (!std::cout.flush()) return status_not_written;
  return result.ok() ? status_done : status_wrong_input;
}

}  // namespace

void add_check(CLI::App& polder, Action& action) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App* command = add_command(polder, "check", "Say what is wrong with a case, draw it, estimate its cost",
                                  "polder check my-dike.toml\n"
                                  "polder check dike-seepage --set model.cell=\"0.025 m\"\n"
                                  "polder check my-dike.toml --json --no-drawing");
  command->add_option("CASE", options->name, "A case file, a folder with a case.toml, or a shipped case")->required();
  command->add_option("--set", options->overrides, "Override one key, such as material.sand.friction_angle=\"36 deg\"")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--out", options->folder, "Where the drawing goes")->type_name("DIR");
  command->add_flag("--no-drawing", options->no_drawing, "Write no drawing");
  command->add_flag("--json", options->json, "Print one JSON object instead of text");
  command->callback([&action, options] { action = [options] { return check(*options); }; });
}

}  // namespace polder::cli
