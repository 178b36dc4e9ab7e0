#include "polder/case/wall_line.hpp"

#include <algorithm>
#include <cmath>

namespace polder {

namespace {

double distance_to_segment(const Point2& p, const Point2& a, const Point2& b) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
  const double share = square > 0 ? std::clamp(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square, 0.0, 1.0) : 0.0;
  return std::hypot(p[0] - a[0] - share * dx, p[1] - a[1] - share * dy);
}

double distance_to_line(const Point2& p, std::span<const Point2> line) {
  double least = distance_to_segment(p, line.front(), line.back());
  for (std::size_t k = 0; k + 1 < line.size(); ++k)
    least = std::min(least, distance_to_segment(p, line[k], line[k + 1]));
  return least;
}

}  // namespace

SteppedWall stepped_wall(std::span<const Point2> line, const Model& model) {
  return stepped_wall(line, grid_axis(model, 0), grid_axis(model, model.space == SpaceKind::solid ? 2 : 1));
}

SteppedWall stepped_wall(std::span<const Point2> line, const GridAxis& x, const GridAxis& height) {
  SteppedWall wall;
  std::vector<std::array<int, 2>> vertices;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const std::array<int, 2> goal{x.nearest_edge(line[k][0]), height.nearest_edge(line[k][1])};
    if (vertices.empty()) {
      vertices.push_back(goal);
      continue;
    }
    std::array<int, 2> at = vertices.back();
    const int total[2] = {std::abs(goal[0] - at[0]), std::abs(goal[1] - at[1])};
    const int way[2] = {goal[0] > at[0] ? 1 : -1, goal[1] > at[1] ? 1 : -1};
    wall.oblique = wall.oblique || (total[0] > 0 && total[1] > 0);
    for (int done[2] = {0, 0}; done[0] < total[0] || done[1] < total[1];) {
      // the axis that is behind the line steps: compares (done + 1/2)/total
      const bool along_x =
          done[1] >= total[1] || (done[0] < total[0] && (2 * done[0] + 1) * total[1] <= (2 * done[1] + 1) * total[0]);
      const int axis = along_x ? 0 : 1;
      const int low = std::min(at[axis], at[axis] + way[axis]);
      wall.faces.push_back(along_x ? WallFace{false, low, at[1]} : WallFace{true, at[0], low});
      at[axis] += way[axis];
      ++done[axis];
      vertices.push_back(at);
    }
  }
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const bool bend = v == 0 || v + 1 == vertices.size() ||
                      vertices[v + 1][0] - vertices[v][0] != vertices[v][0] - vertices[v - 1][0] ||
                      vertices[v + 1][1] - vertices[v][1] != vertices[v][1] - vertices[v - 1][1];
    if (!bend) continue;
    wall.corners.push_back({x.edge(vertices[v][0]), height.edge(vertices[v][1])});
    wall.distance = std::max(wall.distance, distance_to_line(wall.corners.back(), line));
  }
  return wall;
}

}  // namespace polder
