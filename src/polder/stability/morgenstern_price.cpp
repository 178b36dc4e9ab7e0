// In the direction of sliding s, for a slice with E, X on its upper side and E', X' = λ f' E' on its lower side, the
// base at the angle α, total normal force N and shear S = [c l + (N − u l) tan φ] / F:
//   along the base     (E − E' + H) cos α + (V + X − X') sin α = S
//   across it          N = (V + X − X') cos α − (E − E' + H) sin α
// Eliminating N gives E' from E, so the slices are marched from the high end with E = 0 (or the crack's water); the
// last E' must vanish (F), and so must the moment of all forces (λ).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "polder/stability/equilibrium.hpp"
#include "polder/stability/root.hpp"

namespace polder::stability {
namespace {

struct March {
  double last_force = 0;     // N/m, E' of the last slice
  double moment = 0;         // N, about the pole, positive drives
  double thrust_inside = 1;  // share of sides
  bool valid = true;
};

class Interfaces {
 public:
  Interfaces(const Slices& slices, Interslice shape) : slices_(slices) {
    const auto& list = slices.list;
    const double start = along(list.front(), true), end = along(list.back(), false);
    shares_.reserve(list.size() + 1);
    shares_.push_back(shape == Interslice::constant ? 1.0 : 0.0);
    for (const Slice& slice : list) {
      const double t = std::clamp((along(slice, false) - start) / (end - start), 0.0, 1.0);
      shares_.push_back(shape == Interslice::constant ? 1.0 : std::sin(std::numbers::pi * t));
    }
    double highest = -1e300;
    for (const Slice& slice : list) highest = std::max(highest, slice.top());
    pole_ = {(start + end) / 2, highest + (end - start) / 2};
  }

  March march(double factor, double lambda) const {
    March result;
    double e = slices_.entry_force, thrust = slices_.entry_level;
    double moment = slices_.entry_force * (pole_[1] - slices_.entry_level);
    int sides = 0, inside = 0;
    for (std::size_t i = 0; i < slices_.list.size(); ++i) {
      const Slice& slice = slices_.list[i];
      const double sin_a = std::sin(slice.angle), cos_a = std::cos(slice.angle);
      const double x = lambda * shares_[i] * e, share = lambda * shares_[i + 1];
      const double down = slice.vertical + x, push = e + slice.horizontal;
      const double friction = slice.tan_friction / factor;
      const double adhesion = (slice.cohesion - slice.pore_pressure * slice.tan_friction) * slice.length / factor;
      const double divisor = cos_a + share * sin_a - friction * (share * cos_a - sin_a);
      if (divisor < 0.05) return {0, 0, 0, false};
      double next = (push * cos_a + down * sin_a - adhesion - friction * (down * cos_a - push * sin_a)) / divisor;
      double normal = (down - share * next) * cos_a - (push - next) * sin_a;
      double shear = adhesion + friction * normal;
      if (shear < 0) {  // no slice resists less than nothing
        shear = 0;
        next = (push * cos_a + down * sin_a) / (cos_a + share * sin_a);
        normal = (down - share * next) * cos_a - (push - next) * sin_a;
      }
      const double lever_s = pole_[0] - slices_.direction * slice.middle(), lever_z = pole_[1] - slice.base();
      moment += slice.vertical * lever_s + slice.horizontal * (pole_[1] - slice.horizontal_level);
      moment += (normal * sin_a - shear * cos_a) * lever_z - (normal * cos_a + shear * sin_a) * lever_s;

      // Line of thrust, from moments about the middle of the base.
      const double about = e * (thrust - slice.base()) + slice.horizontal * (slice.horizontal_level - slice.base());
      const double turning = (x + share * next) * slice.width / 2;
      thrust = std::abs(next) > 1e-9 ? slice.base() + (about - turning) / next : slice.base();
      if (i + 1 < slices_.list.size()) {
        const bool right = slices_.direction > 0;
        const double base = right ? slice.base_right : slice.base_left, top = right ? slice.top_right : slice.top_left;
        ++sides;
        if (next >= 0 && thrust >= base - 1e-6 && thrust <= top + 1e-6) ++inside;
      }
      e = next;
    }
    result.last_force = e;
    result.moment = moment;
    result.thrust_inside = sides > 0 ? static_cast<double>(inside) / sides : 1;
    return result;
  }

 private:
  double along(const Slice& slice, bool upper) const {
    const bool right = (slices_.direction > 0) != upper;
    return slices_.direction * (right ? slice.right : slice.left);
  }

  const Slices& slices_;
  std::vector<double> shares_;  // f at every side
  Point pole_{0, 0};
};

// F for which the last interslice force vanishes, near `guess`; 0 where there is none.
double force_factor(const Interfaces& interfaces, double lambda, double guess, double scale, int& marches) {
  const auto force = [&](double factor) {
    const March m = interfaces.march(factor, lambda);
    ++marches;
    return m.valid ? m.last_force : std::nan("");
  };
  double low = guess, high = guess;
  double at_low = force(guess), at_high = at_low;
  for (int k = 0; k < 40 && !(at_high >= 0); ++k) {  // invalid marches come from factors that are too small
    low = high, at_low = at_high;
    high *= 1.15;
    at_high = force(high);
  }
  if (!(at_high >= 0)) return 0;
  for (int k = 0; k < 60 && !(at_low < 0); ++k) {
    if (std::isnan(at_low)) {  // too small: halve the way back
      low = (low + high) / 2;
      at_low = force(low);
      if (at_low >= 0) high = low, at_high = at_low, low = high * 0.97, at_low = force(low);
      continue;
    }
    high = low, at_high = at_low;
    low /= 1.15;
    at_low = force(low);
  }
  if (!(at_low < 0)) return 0;
  const Root root = bracketed_root(force, low, at_low, high, at_high, 1e-10, 1e-9 * scale);
  return root.found ? root.x : 0;
}

}  // namespace

Equilibrium morgenstern_price(const Slices& slices, Interslice shape) {
  Equilibrium result;
  if (slices.list.size() < 2) {
    result.problem = "the slip surface has fewer than two slices";
    return result;
  }
  const Interfaces interfaces(slices, shape);
  double scale = 1;
  for (const Slice& slice : slices.list) scale += std::abs(slice.vertical);

  double factor = 1;
  const auto moment = [&](double lambda) {
    const double f = force_factor(interfaces, lambda, factor, scale, result.iterations);
    if (f <= 0) return std::nan("");
    factor = f;
    return interfaces.march(f, lambda).moment;
  };
  // λ by scanning outwards from an ordinary slope's value until the moment changes sign, then closing in.
  constexpr double start = 0.2, step = 0.2;
  constexpr int steps = 9;
  const double middle = moment(start);
  const double middle_factor = factor;
  if (std::isnan(middle)) {
    result.problem = "no factor of safety balances the horizontal forces";
    return result;
  }
  // The moment falls with λ where the surface is ordinary, so look there first.
  for (const double way : {middle > 0 ? 1.0 : -1.0, middle > 0 ? -1.0 : 1.0}) {
    double last = start, at_last = middle;
    factor = middle_factor;
    for (int k = 1; k <= steps; ++k) {
      const double lambda = start + way * step * k;
      const double at = moment(lambda);
      if (std::isnan(at)) break;
      if (at * at_last <= 0) {
        const Root root = bracketed_root(moment, last, at_last, lambda, at, 1e-9, 1e-7 * scale);
        if (!root.found) break;
        const March final = interfaces.march(factor, root.x);
        result.factor = factor;
        result.lambda = root.x;
        result.thrust_inside = final.thrust_inside;
        return result;
      }
      last = lambda, at_last = at;
    }
  }
  result.problem = "no interslice inclination balances the moments";
  return result;
}

}  // namespace polder::stability
