#include "polder/stability/section_strength_reduction.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "polder/seepage/mesh_file.hpp"

namespace polder::stability {
namespace {

bool same(const Strength& a, const Strength& b) {
  return a.model == b.model && a.cohesion == b.cohesion && a.friction_angle == b.friction_angle &&
         a.undrained_strength == b.undrained_strength;
}

/// What the finite elements cannot take; empty: nothing.
std::string refusal(const Section& section) {
  for (const Soil& soil : section.soils) {
    const bool plain = soil.below.model == StrengthModel::drained ||
                       (soil.below.model == StrengthModel::undrained && soil.below.strength_gradient == 0);
    if (!plain || !same(soil.above, soil.below))
      return fmt::format(
          "strength reduction takes drained and constant undrained strengths, the same above and below the water "
          "table; '{}' has another: use a method of slices",
          soil.name);
  }
  if (!section.line_loads.empty() || section.earthquake.horizontal != 0 || section.earthquake.vertical != 0 ||
      section.crack.depth > 0)
    return "strength reduction has no line loads, earthquake or tension crack: use a method of slices";
  return "";
}

FemMaterial material(const Soil& soil, double water_unit_weight, const SectionReductionOptions& options) {
  FemMaterial m;
  m.young_modulus = options.young_modulus;
  m.poisson_ratio = options.poisson_ratio;
  const bool drained = soil.below.model == StrengthModel::drained;
  m.cohesion = drained ? soil.below.cohesion : soil.below.undrained_strength;
  m.friction_angle = drained ? soil.below.friction_angle : 0;
  m.dry_unit_weight = soil.unit_weight;
  m.porosity = (soil.saturated_unit_weight - soil.unit_weight) / water_unit_weight;
  return m;
}

std::vector<Point2> base_line(const PreparedSection& prepared) {
  std::vector<Point2> line;
  for (const Column& column : prepared.columns) {
    line.push_back({column.left, column.pieces.back().base[0]});
    line.push_back({column.right, column.pieces.back().base[1]});
  }
  return line;
}

/// The ground between two abscissae.
std::vector<Point2> ground_line(const PreparedSection& prepared, double from, double to) {
  std::vector<Point2> line{{from, ground_level(prepared, from)}};
  for (const double x : prepared.breaks)
    if (x > from && x < to) line.push_back({x, ground_level(prepared, x)});
  line.push_back({to, ground_level(prepared, to)});
  return line;
}

}  // namespace

SectionReduction reduce_strength(const PreparedSection& prepared, const SectionReductionOptions& options) {
  const Section& section = prepared.section;
  SectionReduction out;
  out.problem = refusal(section);
  if (!out.problem.empty()) return out;

  MeshRequest request;
  double area = 0;
  for (const Layer& layer : section.layers) request.polygons.push_back(layer.polygon);
  for (const Column& column : prepared.columns)
    area += (column.right - column.left) *
            (column.pieces.front().top[0] + column.pieces.front().top[1] - column.pieces.back().base[0] -
             column.pieces.back().base[1]) /
            2;
  constexpr double share = 0.37;  // of size²: mean area of the mesher's triangles
  request.size = std::sqrt(area / options.triangles / share);
  for (const StripLoad& load : section.strip_loads) request.lines.push_back(ground_line(prepared, load.from, load.to));
  out.mesh = options.mesh_file.empty() ? make_mesh(request) : mesh_of_file(options.mesh_file, request);
  if (!options.mesh_file.empty()) request.size = typical_size(out.mesh);

  FemProblem problem;
  problem.mesh = &out.mesh;
  problem.water_unit_weight = section.water.unit_weight;
  for (const Layer& layer : section.layers) {
    FemMaterial m = material(section.soils[layer.soil], section.water.unit_weight, options);
    if (static_cast<std::size_t>(layer.soil) < options.stiffness.size()) {
      m.young_modulus = options.stiffness[layer.soil][0];
      m.poisson_ratio = options.stiffness[layer.soil][1];
    }
    problem.materials.push_back(m);
  }
  problem.supports = {{base_line(prepared), 0.0, 0.0}};
  for (const auto& [x, column, edge] :
       {std::tuple{prepared.left(), &prepared.columns.front(), 0}, {prepared.right(), &prepared.columns.back(), 1}}) {
    const double top = column->pieces.front().top[edge], bottom = column->pieces.back().base[edge];
    if (top - bottom > 1e-3 * request.size) problem.supports.push_back({{{x, bottom}, {x, top}}, 0.0, {}});
  }
  for (const Line& line : options.fixed) problem.supports.push_back({line, 0.0, 0.0});
  for (const StripLoad& load : section.strip_loads)
    problem.loads.push_back({ground_line(prepared, load.from, load.to), {0, -load.pressure}});

  FemAction action;
  if (!section.water.phreatic.empty() || !section.pressures.empty()) {
    PreparedSection wet = prepared;
    wet.section.water.max_suction = 1e9;  // all of it, so that the weights know where the water table is
    for (const Point2& node : out.mesh.nodes)
      action.pore_pressure.push_back(stability::pore_pressure(wet, node[0], node[1]));
  }
  const FemSolver solver(problem);
  // Jaky's K0: near enough to equilibrium for the first step, and the factor does not depend on it.
  const FemState start =
      solver.k0(action, [&](int layer) { return 1 - std::sin(problem.materials[layer].friction_angle); });
  out.result = strength_reduction(solver, start, action, options.reduction);
  if (out.result.stable == 0)
    out.problem = "no equilibrium even with the strength far above the given one";
  else if (!out.result.found)
    out.problem = fmt::format("no failure up to a factor of {}", options.reduction.highest);
  return out;
}

}  // namespace polder::stability
