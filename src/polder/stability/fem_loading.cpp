#include "polder/stability/fem_loading.hpp"

#include <algorithm>

namespace polder {
namespace {

FemAction between(const FemAction& a, const FemAction& b, double s) {
  const auto mix = [s](double x, double y) { return x + s * (y - x); };
  FemAction c{{}, mix(a.weight, b.weight), mix(a.load, b.load), mix(a.strength_factor, b.strength_factor)};
  const std::size_t count = std::max(a.pore_pressure.size(), b.pore_pressure.size());
  for (std::size_t i = 0; i < count; ++i)
    c.pore_pressure.push_back(
        mix(a.pore_pressure.empty() ? 0.0 : a.pore_pressure[i], b.pore_pressure.empty() ? 0.0 : b.pore_pressure[i]));
  return c;
}

}  // namespace

LoadingResult load_in_steps(const FemSolver& solver, FemState& state, const FemAction& from, const FemAction& to,
                            const LoadingOptions& options) {
  LoadingResult result;
  double step = options.first;
  while (result.share < 1 && step >= options.least) {
    const double target = std::min(1.0, result.share + step);
    FemState next = state;
    const FemOutcome outcome = solver.solve(next, between(from, to, target), options.newton);
    result.iterations += outcome.iterations;
    if (!outcome.converged) {
      step = (target - result.share) / 2;
      continue;
    }
    state = std::move(next);
    result.share = target;
    ++result.steps;
    if (outcome.iterations <= 8) step *= 1.5;
  }
  result.reached = result.share >= 1;
  return result;
}

}  // namespace polder
