#pragma once
// From one action to another in steps that adapt to how hard equilibrium is to find.
#include "polder/stability/fem_solver.hpp"

namespace polder {

struct LoadingOptions {
  double first = 0.25;  ///< share of the way in the first step
  double least = 1e-3;  ///< smaller steps mean that the section cannot carry more
  FemOptions newton{};
};

struct LoadingResult {
  bool reached = false;
  double share = 0;  ///< of the way, in equilibrium
  int steps = 0, iterations = 0;
};

/// Everything in the action is interpolated: pore pressures, weight, loads, strength. `state` ends in equilibrium at
/// `share` of the way.
LoadingResult load_in_steps(const FemSolver& solver, FemState& state, const FemAction& from, const FemAction& to,
                            const LoadingOptions& options = {});

}  // namespace polder
