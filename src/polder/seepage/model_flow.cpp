#include "polder/seepage/model_flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "polder/seepage/chain_sides.hpp"
#include "polder/seepage/mesh_file.hpp"

namespace polder {
namespace {

double top_of(const Region& region) {
  double top = -1e300;
  for (const auto& p : region.polygon) top = std::max(top, p[1]);
  return top;
}

/// The side of the model that a point lies on.
std::optional<Side> side_of(const Model& model, const Point2& p, double near) {
  if (p[0] < near) return Side::left;
  if (p[0] > model.size[0] - near) return Side::right;
  if (p[1] < near) return Side::base;
  return std::nullopt;
}

/// What the outside of a side of the outline is to the water in the soil; absent: closed.
std::optional<FlowBoundary> condition_of(const Model& model, const Point2& a, const Point2& b, double near) {
  const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
  const Point2 middle{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
  // The soil lies to the left of a → b.
  const Point2 outside{middle[0] + near * (b[1] - a[1]) / length, middle[1] - near * (b[0] - a[0]) / length};
  FlowBoundary boundary;
  boundary.name = "seepage face";

  const std::optional<Side> side = side_of(model, middle, near);
  for (const Boundary& given : model.boundaries) {
    const bool on = given.side
                        ? side == given.side
                        : given.line.size() == 2 && distance_to_segment(middle, given.line[0], given.line[1]) < near;
    if (!on) continue;
    if (given.water == WaterCondition::closed) return std::nullopt;
    if (given.water == WaterCondition::reservoir) {
      boundary.name = given.name.empty() ? "reservoir" : given.name;
      boundary.condition = FlowCondition::head;
      boundary.head = given.head;
      return boundary;
    }
  }
  for (const Boundary& given : model.boundaries)
    if (given.water == WaterCondition::reservoir && given.region.polygon.size() > 2 &&
        inside_polygon(given.region.polygon, outside)) {
      boundary.name = given.name.empty() ? "reservoir" : given.name;
      boundary.condition = FlowCondition::head;
      boundary.head = given.head;
      return boundary;
    }
  for (const FreeWaterBody& water : model.free_water)
    if (inside_polygon(water.region.polygon, outside)) {
      boundary.name = water.name.empty() ? "free water" : water.name;
      boundary.condition = FlowCondition::head;
      boundary.head = Table::constant(top_of(water.region));
      return boundary;
    }
  const bool open_side = std::any_of(model.boundaries.begin(), model.boundaries.end(), [&](const Boundary& given) {
    return given.side && side == given.side && given.water == WaterCondition::open;
  });
  if (side && !open_side) return std::nullopt;
  return boundary;
}

bool same(const FlowBoundary& a, const FlowBoundary& b) {
  return a.name == b.name && a.condition == b.condition && a.head.x == b.head.x && a.head.y == b.head.y;
}

FlowBoundary boundary_of(const SeepageCondition& given) {
  using Kind = SeepageCondition::Kind;
  FlowBoundary boundary;
  boundary.name = given.name;
  boundary.line = given.line;
  boundary.condition = given.kind == Kind::head   ? FlowCondition::head
                       : given.kind == Kind::rain ? FlowCondition::rain
                                                  : FlowCondition::seepage;
  boundary.head = given.head;
  boundary.head_at_end = given.head_at_end;
  boundary.rate = given.rate;
  return boundary;
}

FlowMaterial flow_material(const Model& model, const SeepageInput& input, const MaterialInput& material,
                           double unit_weight) {
  FlowMaterial m;
  m.conductivity = conductivity(model, material);
  m.porosity = material.porosity;
  m.specific_storage = unit_weight * material.porosity / model.water.bulk_modulus;
  for (const MaterialRetention& given : input.retentions)
    if (given.material == material.name) m.retention = given.retention, m.curve = given.curve;
  return m;
}

}  // namespace

std::array<double, 2> conductivity(const Model& model, const MaterialInput& material) {
  if (material.permeability) return *material.permeability;
  if (!(material.grain_diameter > 0))
    throw std::invalid_argument(
        fmt::format("seepage: material '{}' has neither a permeability nor a grain_diameter; give one", material.name));
  const double n = material.porosity, d = material.grain_diameter;
  const double k = model.water.density * model.gravity * d * d * n * n * n /
                   (model.water.viscosity * material.ergun_a * (1 - n) * (1 - n));
  return {k, k};
}

MeshRequest ground_outlines(const Model& model, double size) {
  MeshRequest request;
  request.size = size;
  for (const SoilBody& soil : model.soils) request.polygons.push_back(soil.region.polygon);
  for (const Boundary& boundary : model.boundaries)
    if (!boundary.side && boundary.line.size() == 2) request.lines.push_back(boundary.line);
  for (const WallInput& wall : model.walls) request.cuts.push_back(wall.line);
  return request;
}

ModelFlow model_flow(const Model& model, const SeepageInput& input) {
  if (model.space != SpaceKind::plane_strain)
    throw std::invalid_argument("seepage: the case is three-dimensional; seepage is computed in sections");
  if (model.soils.empty()) throw std::invalid_argument("seepage: the case has no [[soil]]");
  if (model.tilt != 0) throw std::invalid_argument("seepage: gravity leans (model.tilt); draw the slope as it stands");
  ModelFlow flow;
  flow.unit_weight = model.water.density * model.gravity;
  MeshRequest request =
      ground_outlines(model, input.mesh_size > 0 ? input.mesh_size : std::max(model.cell[0], model.cell[1]));
  for (const SoilBody& soil : model.soils)
    flow.materials.push_back(flow_material(model, input, model.materials[soil.material], flow.unit_weight));
  for (const SeepageCondition& condition : input.conditions) request.lines.push_back(condition.line);
  flow.mesh = input.mesh_file.empty() ? make_mesh(request) : mesh_of_file(input.mesh_file, request);
  if (!input.mesh_file.empty()) request.size = typical_size(flow.mesh);
  const double near = 1e-4 * request.size;
  std::vector<FlowBoundary> kinds;  // without their lines
  std::vector<std::vector<std::array<Point2, 2>>> sides;
  for (const MeshEdge& side : outline(flow.mesh)) {
    const Point2 &a = flow.mesh.nodes[side.a], &b = flow.mesh.nodes[side.b];
    if (std::any_of(input.conditions.begin(), input.conditions.end(), [&](const SeepageCondition& condition) {
          return side_lies_on(flow.mesh, side, condition.line, near);
        }))
      continue;
    const auto boundary = condition_of(model, a, b, near);
    if (!boundary) continue;
    const auto known =
        std::find_if(kinds.begin(), kinds.end(), [&](const FlowBoundary& k) { return same(k, *boundary); });
    const auto place = static_cast<std::size_t>(known - kinds.begin());
    if (known == kinds.end()) kinds.push_back(*boundary), sides.emplace_back();
    sides[place].push_back({a, b});
  }
  for (std::size_t k = 0; k < kinds.size(); ++k)
    for (auto& line : chain_sides(std::move(sides[k]))) {
      flow.boundaries.push_back(kinds[k]);
      flow.boundaries.back().line = std::move(line);
    }
  for (const SeepageCondition& condition : input.conditions)
    if (condition.kind != SeepageCondition::Kind::closed) flow.boundaries.push_back(boundary_of(condition));
  return flow;
}

FlowState initial_flow(const Model& model, const FlowSolver& solver) {
  FlowState state = solver.hydrostatic(0);
  Table table;
  for (const auto& p : model.water_table) table.x.push_back(p[0]), table.y.push_back(p[1]);
  const Mesh& mesh = *solver.problem().mesh;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) state.head[n] = table(mesh.nodes[n][0]);
  return state;
}

}  // namespace polder
