#include "polder/seepage/model_flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "polder/seepage/mesher.hpp"

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
  boundary.line = {a, b};
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

ModelFlow model_flow(const Model& model, const ModelFlowOptions& options) {
  if (model.space != SpaceKind::plane_strain)
    throw std::invalid_argument("seepage: the case is three-dimensional; seepage is computed in sections");
  if (model.soils.empty()) throw std::invalid_argument("seepage: the case has no [[soil]]");
  ModelFlow flow;
  flow.unit_weight = model.water.density * model.gravity;
  MeshRequest request;
  request.size = options.size > 0 ? options.size : model.cell[0];
  for (const SoilBody& soil : model.soils) {
    const MaterialInput& material = model.materials[soil.material];
    request.polygons.push_back(soil.region.polygon);
    FlowMaterial m;
    m.conductivity = conductivity(model, material);
    m.porosity = material.porosity;
    m.specific_storage = flow.unit_weight * material.porosity / model.water.bulk_modulus;
    m.retention = options.retention;
    m.curve = options.curve;
    flow.materials.push_back(m);
  }
  for (const Boundary& boundary : model.boundaries)
    if (!boundary.side && boundary.line.size() == 2) request.lines.push_back(boundary.line);
  flow.mesh = make_mesh(request);
  const double near = 1e-4 * request.size;
  for (const MeshEdge& side : outline(flow.mesh))
    if (auto boundary = condition_of(model, flow.mesh.nodes[side.a], flow.mesh.nodes[side.b], near))
      flow.boundaries.push_back(std::move(*boundary));
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
