#pragma once
// Points that have gone into a body.
#include <algorithm>

#include "polder/points/tiles.hpp"
#include "polder/step/setup.hpp"

namespace polder {

/// Takes a point that is in a body as it is `dt` later out of it, and what moves it further in off its velocity.
template <class Space, class Points>
void leave_body(const Setup<Space>& setup, const PhaseBox& box, double dt, std::size_t p, Points& points) {
  constexpr int up = Space::up;
  const auto& lattice = setup.lattice;
  const BodyContact at = setup.bodies.contact({points.position[0][p], points.position[up][p]}, dt);
  if (at.distance >= 0) return;
  std::array<double, 3> x = position_of(points, p);
  setup.bodies.push_out(x, dt);
  for (int a = 0; a < Space::axes; ++a)
    points.position[a][p] = std::clamp(x[a], lattice.axis[a].at_place(box.low[a] + wall_gap),
                                       lattice.axis[a].at_place(box.high[a] - wall_gap));
  const double into = (points.velocity[0][p] - at.velocity[0]) * at.normal[0] +
                      (points.velocity[up][p] - at.velocity[1]) * at.normal[1];
  if (into >= 0) return;
  points.velocity[0][p] -= into * at.normal[0];
  points.velocity[up][p] -= into * at.normal[1];
}

}  // namespace polder
