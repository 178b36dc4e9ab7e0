#include <algorithm>
#include <cmath>
#include <span>

#include "polder/stability/equilibrium.hpp"
#include "polder/stability/moment_arc.hpp"
#include "polder/stability/root.hpp"

namespace polder::stability {
namespace {

// The three parts of the surface, in the direction of sliding.
struct Parts {
  std::span<const Slice> active, level, passive;
};

Parts split(const Slices& slices, const UpliftVanPlane& plane) {
  const auto beyond = [&](double x) {
    return [&slices, x](const Slice& slice) { return slices.direction * (slice.middle() - x) < 0; };
  };
  const auto begin = slices.list.begin(), end = slices.list.end();
  const auto a = std::partition_point(begin, end, beyond(plane.active[0]));
  const auto p = std::partition_point(a, end, beyond(plane.passive[0]));
  return {{begin, a}, {a, p}, {p, end}};
}

}  // namespace

Equilibrium uplift_van(const Slices& slices, const UpliftVanPlane& plane) {
  Equilibrium result;
  const Parts parts = split(slices, plane);
  if (parts.active.empty() || parts.passive.empty()) {
    result.problem = "the active or the passive circle has no soil";
    return result;
  }
  const double radius_a = plane.active[1] - plane.tangent, radius_p = plane.passive[1] - plane.tangent;
  // Heights of the verticals under the centres, on which the level forces E act at a third.
  const auto height = [&](const Slice& slice, bool far_side) {
    const bool right = (slices.direction > 0) == far_side;
    return right ? slice.top_right - slice.base_right : slice.top_left - slice.base_left;
  };
  const double arm_a = (radius_a - height(parts.active.back(), true) / 3) / radius_a;
  const double arm_p = (radius_p - height(parts.passive.front(), false) / 3) / radius_p;
  if (arm_a <= 0.05 || arm_p <= 0.05) {
    result.problem = "a centre lies too low: the force on its vertical has no lever";
    return result;
  }
  double driving_a = driving_force(parts.active, slices.direction, plane.active, radius_a);
  driving_a += slices.entry_force * (plane.active[1] - slices.entry_level) / radius_a;
  const double driving_p = driving_force(parts.passive, slices.direction, plane.passive, radius_p);
  double push = 0;
  for (const Slice& slice : parts.level) push += slice.horizontal;

  // Horizontal force that is left over at F: grows with F, zero at the factor of safety.
  const auto surplus = [&](double factor) {
    const double active = (driving_a - shear_resistance(parts.active, factor) / factor) / arm_a;
    const double passive = (shear_resistance(parts.passive, factor) / factor - driving_p) / arm_p;
    return active + push - shear_resistance(parts.level, factor) / factor - passive;
  };
  constexpr double low = 0.05, high = 20;
  const double at_low = surplus(low), at_high = surplus(high);
  if (at_low > 0 || at_high < 0) {
    result.problem = at_low > 0 ? "the factor of safety is below 0.05" : "the factor of safety is above 20";
    return result;
  }
  const Root root = bracketed_root(surplus, low, at_low, high, at_high, 1e-9, 1e-9 * (std::abs(driving_a) + 1));
  result.iterations = root.evaluations;
  if (root.found)
    result.factor = root.x;
  else
    result.problem = "Uplift-Van did not converge";
  return result;
}

}  // namespace polder::stability
