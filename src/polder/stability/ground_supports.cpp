#include "polder/stability/ground_supports.hpp"

#include <cmath>

namespace polder {
namespace {

/// What holds a side of the outline: along the boundaries of the model as they say, sides of the model by default
/// smooth.
SoilCondition held(const Model& model, const Point2& middle, bool upright, double near) {
  const bool at_side = upright ? middle[0] < near || middle[0] > model.size[0] - near : middle[1] < near;
  for (const Boundary& given : model.boundaries) {
    const bool on = given.side
                        ? (*given.side == Side::base    ? !upright && middle[1] < near
                           : *given.side == Side::left  ? upright && middle[0] < near
                           : *given.side == Side::right ? upright && middle[0] > model.size[0] - near
                                                        : false)
                        : given.line.size() == 2 && distance_to_segment(middle, given.line[0], given.line[1]) < near;
    if (on && (given.soil != SoilCondition::none || !at_side)) return given.soil;
  }
  return at_side ? SoilCondition::roller : SoilCondition::none;
}

}  // namespace

std::vector<FemSupport> ground_supports(const Model& model, const Mesh& mesh, double near) {
  std::vector<FemSupport> supports;
  for (const MeshEdge& side : outline(mesh)) {
    const Point2 &a = mesh.nodes[side.a], &b = mesh.nodes[side.b];
    const bool upright = std::abs(a[0] - b[0]) < near, level = std::abs(a[1] - b[1]) < near;
    if (!upright && !level) continue;
    const SoilCondition condition = held(model, mesh.nodes[side.middle], upright, near);
    if (condition == SoilCondition::none) continue;
    FemSupport support{{a, b}, {}, {}};
    if (upright || condition == SoilCondition::rough) support.x = 0.0;
    if (level || condition == SoilCondition::rough) support.y = 0.0;
    supports.push_back(std::move(support));
  }
  return supports;
}

}  // namespace polder
