#pragma once
// Factor of safety by strength reduction: c and tan φ are divided by F until equilibrium can no longer be found
// (Griffiths & Lane 1999), following the deformation from one F to the next.
//
// Failure is called only where both signs of it are there: the out-of-balance force stops falling, and displacements
// run away compared with the steps before. A step that fails for another reason is tried again with half of it.
#include <vector>

#include "polder/stability/fem_solver.hpp"

namespace polder {

struct StrengthReductionOptions {
  double start = 1;           ///< F of the first equilibrium; lowered where there is none
  double step = 0.1;          ///< first increase of F
  double resolution = 0.005;  ///< F is bracketed within this
  double highest = 10;        ///< the search ends here: the section does not fail
  FemOptions newton{};
};

struct StrengthReductionResult {
  double factor = 0;              ///< middle of the bracket
  double stable = 0, failed = 0;  ///< its ends: the last F in equilibrium, the first without
  bool found = false;             ///< false: no failure up to `highest`, or no equilibrium even at small F
  /// Largest displacement (m) at every F tried, in equilibrium or not, in the order of F.
  struct Point {
    double factor, displacement;
    bool converged;
    int iterations;
  };
  std::vector<Point> curve;
  FemState state;                 ///< at `stable`
  std::vector<double> mechanism;  ///< displacement increments (x, y per node) of the failing step
  std::vector<double> shear;      ///< their deviatoric strain, per Gauss point
  int iterations = 0;
};

/// `from` is an equilibrium (or K0) state under `action`; the reduction starts with displacements counted from it.
StrengthReductionResult strength_reduction(const FemSolver& solver, FemState from, FemAction action,
                                           const StrengthReductionOptions& options = {});

}  // namespace polder
