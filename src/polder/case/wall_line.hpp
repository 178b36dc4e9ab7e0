#pragma once
// A wall thinner than a cell, as the faces of the grid nearest to its line.
#include <cmath>
#include <span>
#include <vector>

#include "polder/case/model.hpp"

namespace polder {

/// A face in the section: upright, the low face on x of cell (i, j), or level, its low face on the height.
struct WallFace {
  bool upright;
  int i, j;
};

/// Whether the wall vanishes during the run.
inline bool is_gate(const WallInput& wall) { return wall.until_stage >= 0 || std::isfinite(wall.until); }

struct SteppedWall {
  std::vector<WallFace> faces;  ///< from end to end
  std::vector<Point2> corners;  ///< m; the line that the faces form, corners only
  double distance = 0;          ///< m; largest distance of a corner or end of `corners` from the line
  bool oblique = false;         ///< a part of the line is neither upright nor level
};

/// Steps from corner to corner of the polyline over the vertices of the grid, as close to the line as they go.
SteppedWall stepped_wall(std::span<const Point2> line, const GridAxis& x, const GridAxis& height);
SteppedWall stepped_wall(std::span<const Point2> line, const Model& model);

}  // namespace polder
