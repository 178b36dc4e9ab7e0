#pragma once
// Where bodies that move are: functions of time alone.
#include <algorithm>

#include "polder/case/model.hpp"

namespace polder {

inline bool moves(const WallInput& wall) {
  const auto acts = [](const Table& t) { return std::any_of(t.y.begin(), t.y.end(), [](double v) { return v != 0; }); };
  return std::any_of(wall.velocity.begin(), wall.velocity.end(), acts) ||
         std::any_of(wall.displacement.begin(), wall.displacement.end(), acts);
}

inline bool any_body_moves(const Model& model) {
  return std::any_of(model.walls.begin(), model.walls.end(), [](const WallInput& w) { return moves(w); });
}

/// m, along x and upwards, at `time` (s; a body moves from t = 0 on).
inline Point2 displacement_at(const WallInput& wall, double time) {
  Point2 d{0, 0};
  for (std::size_t k = 0; time > 0 && k < 2; ++k)
    d[k] = !wall.displacement[k].y.empty() ? wall.displacement[k](time)
           : !wall.velocity[k].y.empty()   ? wall.velocity[k].integral(time)
                                           : 0;
  return d;
}

inline std::vector<Point2> outline_at(const WallInput& wall, double time) {
  std::vector<Point2> outline = wall.polygon;
  const Point2 d = displacement_at(wall, time);
  for (Point2& p : outline)
    for (std::size_t k = 0; k < 2; ++k) p[k] += d[k];
  return outline;
}

}  // namespace polder
