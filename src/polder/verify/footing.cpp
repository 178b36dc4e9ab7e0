// Bearing capacity of a rough rigid strip on weightless ground (Prandtl 1920, Reissner 1924), by the finite elements of
// the strength reduction: Nc = 2 + π for undrained clay; Nq = e^{π tan φ} (1 + sin φ)/(1 − sin φ) and Nc = (Nq − 1) cot
// φ with friction and associated flow.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "polder/case/geometry.hpp"
#include "polder/seepage/mesher.hpp"
#include "polder/stability/fem_loading.hpp"
#include "polder/stability/section_from_model.hpp"
#include "polder/stage/guards.hpp"
#include "polder/verify/problem.hpp"

namespace polder::verify {

namespace {

/// Half of the ground under and beside half of the footing, its axis at the left.
struct Ground {
  double width, depth, half;  ///< m, half: of the footing
};

Ground ground_of(const Model& model) {
  const Bounds box = bounds(model.soils.at(0).region.polygon);
  return {box.high[0] - box.low[0], box.high[1] - box.low[1], model.loads.at(0).span[1] - model.loads.at(0).span[0]};
}

FemMaterial material_of(const MaterialInput& input) {
  FemMaterial m;
  const auto parameter = [&](std::string_view key) { return stability::law_parameter(input, key).value_or(0); };
  m.young_modulus = parameter("young_modulus");
  m.poisson_ratio = parameter("poisson_ratio");
  m.cohesion = input.law == "tresca" ? parameter("undrained_shear_strength") : parameter("cohesion");
  m.friction_angle = parameter("friction_angle");
  m.dilation_angle = parameter("dilatancy_angle");
  return m;
}

Mesh mesh_of(const Ground& g) {
  MeshRequest request;
  request.polygons = {{{0, 0}, {g.width, 0}, {g.width, g.depth}, {g.half, g.depth}, {0, g.depth}}};
  request.size = 0.5 * g.half;
  request.growth = 0.15;
  request.finer = {{{g.half, g.depth}, 0.02 * g.half}};
  return make_mesh(request);
}

struct Pressed {
  std::vector<double> settlement, pressure;  ///< m; Pa, mean under the footing
};

/// A footing under which ground is pressed together step by step, a pressure `surcharge` on the ground beside it.
struct Press {
  const Mesh& mesh;
  Ground ground;
  FemMaterial material;
  double surcharge;
  FemState state{};
  Pressed pressed{};

  std::vector<Point2> sole() const { return {{0, ground.depth}, {ground.half, ground.depth}}; }

  FemSolver at(double settlement) const {
    FemProblem problem;
    problem.mesh = &mesh;
    problem.materials = {material};
    problem.supports = {{{{0, 0}, {ground.width, 0}}, 0.0, 0.0},
                        {{{0, 0}, {0, ground.depth}}, 0.0, {}},
                        {{{ground.width, 0}, {ground.width, ground.depth}}, 0.0, {}},
                        {sole(), 0.0, -settlement}};
    if (surcharge > 0) problem.loads = {{{{ground.half, ground.depth}, {ground.width, ground.depth}}, {0, -surcharge}}};
    return FemSolver(problem);
  }

  /// A uniform stress, in equilibrium with the surcharge.
  void begin() {
    state = at(0).unstressed();
    const double k0 = material.poisson_ratio / (1 - material.poisson_ratio);
    for (auto& stress : state.stress) stress = {-k0 * surcharge, -surcharge, -k0 * surcharge, 0};
  }

  /// From one settlement to another, by halves where that is too far at once. False: there is no equilibrium.
  bool advance(double from, double to, int halvings) {
    const FemSolver solver = at(to);
    const FemState before = state;
    FemOptions options;
    options.stop_early = false;
    options.iterations = 25;
    if (solver.solve(state, {}, options).converged) {
      pressed.settlement.push_back(to);
      pressed.pressure.push_back(-solver.reaction(state, {}, sole())[1] / ground.half);
      return true;
    }
    state = before;
    const double middle = 0.5 * (from + to);
    return halvings > 0 && advance(from, middle, halvings - 1) && advance(middle, to, halvings - 1);
  }
};

Pressed press(const Mesh& mesh, const Ground& ground, const FemMaterial& material, double surcharge, double depth,
              int steps) {
  Press press{mesh, ground, material, surcharge};
  press.begin();
  for (int k = 0; k < steps; ++k)
    if (!press.advance(depth * k / steps, depth * (k + 1) / steps, 5))
      throw RunFailure(
          fmt::format("the footing has no equilibrium at a settlement of {:.3g} m", depth * (k + 1) / steps));
  return std::move(press.pressed);
}

/// The same without a surcharge, in steps that adapt: ground that keeps its volume finds equilibrium in short ones
/// only.
Pressed press_in_steps(const Mesh& mesh, const Ground& ground, const FemMaterial& material, double depth) {
  Press press{mesh, ground, material, 0};
  const FemSolver solver = press.at(depth);
  press.state = solver.unstressed();
  FemAction from;
  from.load = 0;
  LoadingOptions options;
  options.first = 0.1;
  for (const double share : {0.25, 0.5, 0.8, 1.0}) {
    FemAction to;
    to.load = share;
    if (!load_in_steps(solver, press.state, from, to, options).reached)
      throw RunFailure(fmt::format("the footing has no equilibrium at a settlement of {:.3g} m", share * depth));
    press.pressed.settlement.push_back(share * depth);
    press.pressed.pressure.push_back(-solver.reaction(press.state, to, press.sole())[1] / ground.half);
    from = to;
  }
  return std::move(press.pressed);
}

Findings footing(const Source& source) {
  const Study study = source.study();
  const Ground g = ground_of(study.run);
  const Mesh mesh = mesh_of(g);
  Findings findings;
  Chart chart{"Bearing pressure", "settlement over half the width", "of the exact capacity", "", "", {}, {}};
  chart.curves.push_back({"exact", {0, 0}, {1, 1}, false});
  const auto compare = [&](const std::string& at, double exact, double found, Pressed pressed, double capacity) {
    findings.comparisons.push_back({"bearing capacity factor", at, exact, found});
    for (double& s : pressed.settlement) s /= g.half;
    for (double& p : pressed.pressure) p /= capacity;
    chart.curves.front().x[1] = std::max(chart.curves.front().x[1], pressed.settlement.back());
    chart.curves.push_back({at, std::move(pressed.settlement), std::move(pressed.pressure), false});
  };

  const FemMaterial clay = material_of(study.run.materials.at(0)), sand = material_of(study.run.materials.at(1));
  const double strength = material_of(study.shipped.materials.at(0)).cohesion;
  const FemMaterial& exact_sand = material_of(study.shipped.materials.at(1));
  const double phi = exact_sand.friction_angle, sine = std::sin(phi), cohesion = exact_sand.cohesion;
  const double nq = std::exp(std::numbers::pi * std::tan(phi)) * (1 + sine) / (1 - sine), nc = (nq - 1) / std::tan(phi);

  const Pressed undrained = press_in_steps(mesh, g, clay, 0.03 * g.half);
  const Pressed drained = press(mesh, g, sand, 0, 0.15 * g.half, 10);
  FemMaterial loose = sand;  // without cohesion, under a surcharge
  loose.cohesion = 0;
  const Pressed buried = press(mesh, g, loose, cohesion, 0.12 * g.half, 10);
  compare("Nc, φ = 0", 2 + std::numbers::pi, undrained.pressure.back() / strength, undrained,
          (2 + std::numbers::pi) * strength);
  const std::string angle = fmt::format("φ = {:g}°", phi * 180 / std::numbers::pi);
  compare("Nc, " + angle, nc, drained.pressure.back() / cohesion, drained, nc * cohesion);
  compare("Nq, " + angle, nq, buried.pressure.back() / cohesion, buried, nq * cohesion);
  findings.figure = chart;
  return findings;
}

}  // namespace

std::vector<Problem> footing_problems() {
  return {{"footing", "A rough strip is pressed into weightless ground", "Prandtl (1920), Reissner (1924)", false,
           footing}};
}

}  // namespace polder::verify
