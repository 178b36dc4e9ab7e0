#pragma once
// Slip surfaces through a section, and the vertical slices into which they cut the soil above them.
#include <string>
#include <vector>

#include "polder/stability/columns.hpp"

namespace polder::stability {

enum class SurfaceKind { circle, uplift_van, free };

/// A slip surface between `left` and `right`, where it meets the ground.
struct SlipSurface {
  SurfaceKind kind = SurfaceKind::circle;
  double left = 0, right = 0;  ///< m
  Circle circle;               ///< of a circle
  UpliftVanPlane plane;        ///< of an Uplift-Van surface
  Line points;                 ///< of a free surface, left to right
  std::string problem;         ///< why there is no such surface; empty: there is one
  explicit operator bool() const { return problem.empty(); }
};

/// Height of the slip surface at x in [left, right].
double base_level(const SlipSurface& surface, double x);

/// The widest part of the lower half of the circle that lies below the ground.
SlipSurface circle_surface(const PreparedSection& prepared, const Circle& circle);
/// Circle under the active centre, level plane, circle under the passive centre. Radii follow from the plane's level.
SlipSurface uplift_van_surface(const PreparedSection& prepared, const UpliftVanPlane& plane);
/// The part of the polyline that lies below the ground, its end segments prolonged or cut at the ground.
SlipSurface free_surface(const PreparedSection& prepared, const Line& points);

/// Per metre of dike. Angles, levers and horizontal forces count positive in the direction of sliding.
struct Slice {
  double left = 0, right = 0;            ///< m, x of its sides; left < right
  double base_left = 0, base_right = 0;  ///< m
  double top_left = 0, top_right = 0;    ///< m
  double width = 0, length = 0;          ///< m; length along the base
  double angle = 0;                      ///< rad, of the base; positive where it dips in the direction of sliding
  double weight = 0;                     ///< N/m, soil
  double vertical = 0;                   ///< N/m, all that presses down: soil, loads, free water, earthquake
  double load = 0, free_water = 0;       ///< N/m, shares of `vertical`
  double horizontal = 0;                 ///< N/m, from free water, loads and earthquake
  double horizontal_level = 0;           ///< m, height at which `horizontal` acts
  double pore_pressure = 0;              ///< Pa at the base, with what loads have added
  double effective_stress = 0;           ///< Pa, vertical, vertical/width − pore pressure
  double cohesion = 0;                   ///< Pa; s_u where undrained
  double tan_friction = 0;
  double yield_stress = 0;  ///< Pa
  int layer = -1;
  double middle() const { return (left + right) / 2; }
  double base() const { return (base_left + base_right) / 2; }
  double top() const { return (top_left + top_right) / 2; }
};

struct Slices {
  std::vector<Slice> list;  ///< from the high end to the low end, in the direction of sliding
  double direction = 1;     ///< +1: slides towards +x, −1: towards −x
  double entry_force = 0;   ///< N/m, water in the tension crack, in the direction of sliding
  double entry_level = 0;   ///< m, where it acts
  std::string problem;      ///< why the surface cannot slide; empty: it can
  explicit operator bool() const { return problem.empty(); }
};

/// At least `count` slices; more where ground, layers, water or loads have kinks, so that each has one soil and
/// straight sides. The surface must be one that exists.
Slices cut_slices(const PreparedSection& prepared, const SlipSurface& surface, int count = 40);

/// Why the surface breaks the limits of the section (entry, exit, depth, length, forbidden zones); empty: it does not.
std::string broken_limit(const PreparedSection& prepared, const SlipSurface& surface, const Slices& slices);

}  // namespace polder::stability
