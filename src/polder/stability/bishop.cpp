#include <algorithm>
#include <cmath>
#include <numbers>

#include "polder/stability/equilibrium.hpp"
#include "polder/stability/moment_arc.hpp"

namespace polder::stability {

double driving_force(std::span<const Slice> slices, double direction, const Point& centre, double radius) {
  double moment = 0;
  for (const Slice& slice : slices)
    moment += slice.vertical * direction * (centre[0] - slice.middle()) +
              slice.horizontal * (centre[1] - slice.horizontal_level);
  return moment / radius;
}

double shear_resistance(std::span<const Slice> slices, double factor) {
  double sum = 0;
  for (const Slice& slice : slices) {
    const double sin_a = std::sin(slice.angle), mobilised = slice.tan_friction / factor;
    const double steepest = std::atan(mobilised) / 2 - std::numbers::pi / 4;
    const double m = slice.angle > steepest ? std::cos(slice.angle) + sin_a * mobilised
                                            : std::cos(steepest) + std::sin(steepest) * mobilised;
    const double adhesion = slice.cohesion * slice.length;
    const double normal = (slice.vertical - slice.pore_pressure * slice.width - adhesion * sin_a / factor) / m;
    sum += adhesion + std::max(0.0, normal) * slice.tan_friction;
  }
  return sum;
}

Equilibrium bishop(const Slices& slices, const Circle& circle) {
  Equilibrium result;
  double driving = driving_force(slices.list, slices.direction, circle.centre, circle.radius);
  driving += slices.entry_force * (circle.centre[1] - slices.entry_level) / circle.radius;
  double weight = 0;
  for (const Slice& slice : slices.list) weight += slice.vertical;
  if (driving <= 1e-6 * weight) {
    result.problem = "nothing drives the soil in the direction of sliding";
    return result;
  }
  double factor = 1;
  for (result.iterations = 1; result.iterations <= 200; ++result.iterations) {
    const double next = shear_resistance(slices.list, factor) / driving;
    if (next < 1e-3) {
      result.problem = "the slip surface has no strength";
      return result;
    }
    const bool done = std::abs(next - factor) < 1e-7 * next;
    factor = next;
    if (done) {
      result.factor = factor;
      return result;
    }
  }
  result.problem = "Bishop's iteration did not converge in 200 steps";
  return result;
}

}  // namespace polder::stability
