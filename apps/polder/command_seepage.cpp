// polder seepage CASE: heads, fluxes, discharges and exit gradients of the model that `polder run` simulates.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "case_argument.hpp"
#include "commands.hpp"
#include "polder/report/section_drawing.hpp"
#include "polder/result/atomic_file.hpp"
#include "polder/result/output_error.hpp"
#include "polder/result/paint.hpp"
#include "polder/seepage/flow_reading.hpp"
#include "polder/seepage/flow_results.hpp"
#include "polder/seepage/model_flow.hpp"
#include "polder/stability/ground_deformation.hpp"
#include "polder/stability/sliding_area.hpp"

namespace polder::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string name, json, folder;
  std::vector<std::string> overrides;
};

// The specific discharge on about 500 nodes, the longest arrow a twentieth of the section.
std::vector<std::array<Point2, 2>> arrows(const Mesh& mesh, const std::vector<Point2>& discharge) {
  double most = 0, low = 1e300, high = -1e300;
  for (const Point2& q : discharge) most = std::max(most, std::hypot(q[0], q[1]));
  for (const Point2& p : mesh.nodes) low = std::min(low, p[0]), high = std::max(high, p[0]);
  std::vector<std::array<Point2, 2>> list;
  const std::size_t every = std::max<std::size_t>(1, mesh.nodes.size() / 500);
  const double scale = most > 0 ? (high - low) / 20 / most : 0;
  for (std::size_t n = 0; n < mesh.nodes.size() && scale > 0; n += every)
    list.push_back(
        {mesh.nodes[n], {mesh.nodes[n][0] + scale * discharge[n][0], mesh.nodes[n][1] + scale * discharge[n][1]}});
  return list;
}

void write_fields(const fs::path& folder, std::size_t number, const FlowSolver& solver, const FlowState& state) {
  const Mesh& mesh = *solver.problem().mesh;
  const std::vector<double> pressure = pore_pressure(solver, state);
  const std::vector<Point2> discharge = specific_discharge(solver, state);
  std::string csv = "x (m),y (m),head (m),pore pressure (Pa),qx (m/s),qy (m/s)\n";
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    csv += fmt::format("{:.6g},{:.6g},{:.8g},{:.8g},{:.6g},{:.6g}\n", mesh.nodes[n][0], mesh.nodes[n][1], state.head[n],
                       pressure[n], discharge[n][0], discharge[n][1]);
  write_atomically(folder / fmt::format("nodes-{}.csv", number), csv);
  const std::string at = fmt::format("t = {:g} s", state.time);
  TriangleField head = nodal_field(mesh, state.head);
  head.title = "Head and discharge, " + at;
  head.unit = "m";
  head.lines = 14;
  head.map = ColourMap::water;
  head.overlay = phreatic_line(solver, state);
  head.arrows = arrows(mesh, discharge);
  write_drawing(folder / fmt::format("head-{}.png", number), draw_field(mesh, head));
  TriangleField pore = nodal_field(mesh, pressure);
  pore.title = "Pore pressure, " + at;
  pore.unit = "Pa";
  pore.lines = 10;
  pore.map = ColourMap::field;
  pore.overlay = head.overlay;
  write_drawing(folder / fmt::format("pore-pressure-{}.png", number), draw_field(mesh, pore));
}

// Ground that deforms with the flow, since when it has found no equilibrium, and whether it finds one now.
struct Ground {
  GroundDeformation deformation;
  double lost = -1;  // s
  bool stands = true;
};

void follow(FlowSolver& solver, FlowState& state, double until, Ground& ground) {
  constexpr int parts = 20;
  const double from = state.time;
  for (int i = 1; i <= parts; ++i) {
    solver.advance(state, from + (until - from) * i / parts);
    if (ground.lost >= 0 && i < parts) continue;  // an attempt that fails is dear: one at the instant
    ground.stands = ground.deformation.follow(pore_pressure(solver, state));
    if (!ground.stands && ground.lost < 0) ground.lost = state.time;
    solver.scale_conductivity(ground.deformation.conductivity_scale());
  }
}

void add_ground(std::vector<FlowValue>& values, const Ground& ground, const Mesh& mesh, double time) {
  const std::vector<double>& u = ground.deformation.state().displacement;
  double most = 0, most_k = 0;
  for (std::size_t i = 0; i + 1 < u.size(); i += 2) most = std::max(most, std::hypot(u[i], u[i + 1]));
  for (const double k : ground.deformation.conductivity_scale()) most_k = std::max(most_k, k);
  values.push_back({"displacement", "largest of the ground", time, most, "m"});
  values.push_back({"conductivity", "largest over that at the start", time, most_k, ""});
  if (ground.lost < 0) return;
  values.push_back({"no equilibrium", "from then on; displacements stay", time, ground.lost, "s"});
  values.push_back(
      {"sliding area", "of the attempt that failed", time, sliding_area(mesh, ground.deformation.mechanism()), "m2"});
}

/// Of the ground since the beginning or, where it finds no equilibrium, of what moved in the attempt at this instant.
void write_strain(const fs::path& folder, std::size_t number, const Ground& ground, const Mesh& mesh, double time) {
  const bool fails = !ground.stands;
  const std::vector<double>& moved = fails ? ground.deformation.mechanism() : ground.deformation.state().displacement;
  TriangleField strain = gauss_field(mesh, ground.deformation.strain(moved));
  strain.title = fmt::format("Deviatoric strain{}, t = {:g} s", fails ? " of the attempt that fails" : "", time);
  strain.map = ColourMap::strain;
  strain.from_zero = true;
  strain.arrows = arrows(mesh, [&] {
    std::vector<Point2> u(mesh.nodes.size());
    for (std::size_t n = 0; n < u.size(); ++n) u[n] = {moved[2 * n], moved[2 * n + 1]};
    return u;
  }());
  write_drawing(folder / fmt::format("strain-{}.png", number), draw_field(mesh, strain));
}

void print(const std::vector<FlowValue>& values) {
  if (!values.empty()) fmt::print("t = {:g} s\n", values.front().time);
  for (const FlowValue& v : values) fmt::print("  {:<14}{:>12.4g} {:<6}{}\n", v.quantity, v.value, v.unit, v.at);
  std::fflush(stdout);
}

int run(const Options& options) {
  const ReadResult read = read_case(find_case_file(options.name), options.overrides);
  std::cerr << format(read.diagnostics);
  if (!read.ok()) throw Failure(status_wrong_input, "the case is wrong; nothing was written");
  const Model& model = read.model;
  const SeepageInput& input = read.seepage;
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  const bool quiet = options.json == "-";
  try {
    const ModelFlow flow = model_flow(model, input);
    FlowSolver solver(flow.problem());
    std::optional<Ground> ground;
    if (input.deformation && input.times.empty())
      throw std::invalid_argument("seepage.deformation goes from instant to instant: give seepage.times");
    if (input.deformation) ground.emplace(Ground{GroundDeformation(model, input, flow)});
    if (!quiet)
      fmt::print("{}: {} triangles, {} nodes\n", model.name, flow.mesh.triangles.size(), flow.mesh.nodes.size());
    if (!options.folder.empty()) make_folder(options.folder);
    std::size_t number = 0;
    const auto take = [&](const FlowState& state) {
      std::vector<FlowValue> values = read_flow(model, solver, state);
      if (ground) add_ground(values, *ground, flow.mesh, state.time);
      if (!quiet) print(values);
      for (const FlowValue& v : values)
        rows.push_back({{"case", model.name},
                        {"quantity", v.quantity},
                        {"at", v.at},
                        {"time", v.time},
                        {"value", v.value},
                        {"unit", v.unit}});
      if (!options.folder.empty()) {
        write_fields(options.folder, number, solver, state);
        if (ground) write_strain(options.folder, number, *ground, flow.mesh, state.time);
        ++number;
      }
    };
    if (input.times.empty()) {
      take(solver.steady(input.steady_time));
    } else {
      FlowState state = input.start == SeepageStart::steady ? solver.steady(0) : initial_flow(model, solver);
      if (ground && !ground->deformation.begin(pore_pressure(solver, state)))
        throw std::runtime_error(
            "the ground finds no equilibrium under its weight and the pressures at t = 0: it fails before anything "
            "changes; look at its factor of safety (polder stability)");
      for (const double time : input.times) {
        if (time > state.time && ground)
          follow(solver, state, time, *ground);
        else if (time > state.time)
          solver.advance(state, time);
        take(state);
      }
    }
    const std::string text = rows.dump(2) + "\n";
    if (!options.folder.empty()) write_atomically(fs::path(options.folder) / "seepage.json", text);
    if (quiet)
      std::cout << text;
    else if (!options.json.empty())
      write_atomically(options.json, text);
  } catch (const std::invalid_argument& error) {
    throw Failure(status_wrong_input, model.file + ": " + error.what());
  } catch (const OutputError& error) {
    throw Failure(status_not_written, error.what());
  } catch (const std::runtime_error& error) {
    throw Failure(status_failed, model.file + ": " + error.what());
  }
  return status_done;
}

}  // namespace

void add_seepage(CLI::App& polder, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = add_command(polder, "seepage", "Steady or transient seepage of a case by finite elements",
                                  "polder seepage dike-seepage-fem\n"
                                  "polder seepage dike-seepage-fem --out seepage\n"
                                  "polder seepage my-dike.toml --set seepage.mesh_size=\"0.1 m\" --json flow.json");
  command->add_option("CASE", options->name, "A case file, a folder with a case.toml, or a shipped case")->required();
  command->add_option("--set", options->overrides, "Override one key, such as seepage.mesh_size=\"0.1 m\"")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--out", options->folder, "Write heads, pressures and discharges (CSV) and pictures (PNG) here")
      ->type_name("DIR");
  command->add_option("--json", options->json, "Write the numbers to this file as well (-: to the screen instead)")
      ->type_name("FILE");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace polder::cli
