#include "polder/stability/fem_strength_reduction.hpp"

#include <algorithm>
#include <cmath>

namespace polder {
namespace {

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> d(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) d[i] = a[i] - b[i];
  return d;
}

double largest(const std::vector<double>& u) {
  double most = 0;
  for (std::size_t n = 0; n + 1 < u.size(); n += 2) most = std::max(most, std::hypot(u[n], u[n + 1]));
  return most;
}

}  // namespace

StrengthReductionResult strength_reduction(const FemSolver& solver, FemState from, FemAction action,
                                           const StrengthReductionOptions& options) {
  StrengthReductionResult result;
  std::fill(from.displacement.begin(), from.displacement.end(), 0.0);
  const auto attempt = [&](FemState& state, double factor) {
    action.strength_factor = factor;
    const FemOutcome outcome = solver.solve(state, action, options.newton);
    result.iterations += outcome.iterations;
    result.curve.push_back({factor, largest(state.displacement), outcome.converged, false, outcome.iterations});
    return outcome;
  };

  // The first equilibrium, if need be with a stronger soil: that a first step from a poor start fails bounds nothing.
  // Any state in balance will do: where Newton misses it without dilation, as in cohesionless soil, associated flow may
  // still find it.
  FemState state = from;
  double stable = 0;
  const auto first = [&](bool associated, double least) {
    action.associated = associated;
    for (double factor = options.start; stable == 0 && factor >= least; factor *= 0.8) {
      state = from;
      if (attempt(state, factor).converged) stable = factor;
    }
    return stable > 0;
  };
  if (!first(false, 0.5 * options.start) && !first(true, 0.05)) return result;
  action.associated = false;
  std::fill(state.displacement.begin(), state.displacement.end(), 0.0);

  double step = options.step, first_rate = 0;
  bool confirmed = false;  // that the failure at the end of the bracket is not one of too long a step
  while (!confirmed && stable < options.highest) {
    double factor = stable + step;
    if (result.failed > 0 && factor >= result.failed - 1e-12) {
      step = (result.failed - stable) / 2;
      confirmed = step < options.resolution / 2;
      factor = confirmed ? result.failed : stable + step;
    }
    FemState next = state;
    const FemOutcome outcome = attempt(next, factor);
    const double rate = outcome.largest_displacement / (factor - stable);
    if (outcome.converged && (first_rate == 0 || rate < options.runaway * first_rate)) {
      if (first_rate == 0) first_rate = rate;
      stable = factor;
      state = std::move(next);
      if (confirmed) {
        confirmed = false;
        result.failed = 0;
        step = options.step / 4;
      }
      continue;
    }
    if (outcome.converged) result.curve.back().runs_away = true;
    result.failed = factor;
    result.mechanism = difference(next.displacement, state.displacement);
    if (!confirmed) step /= 2;
  }
  result.stable = stable;
  result.found = result.failed > 0;
  result.factor = result.found ? (stable + result.failed) / 2 : stable;
  result.shear = solver.deviatoric_strain(result.mechanism.empty() ? state.displacement : result.mechanism);
  result.state = std::move(state);
  std::erase_if(result.curve, [&](const auto& p) { return !p.converged && p.factor <= stable; });
  std::stable_sort(result.curve.begin(), result.curve.end(),
                   [](const auto& a, const auto& b) { return a.factor < b.factor; });
  return result;
}

}  // namespace polder
