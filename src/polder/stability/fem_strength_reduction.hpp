#pragma once
// Factor of safety by strength reduction: c and tan φ are divided by F until equilibrium can no longer be found
// (Griffiths & Lane 1999), following the deformation from one F to the next.
//
// A step counts as failure where no equilibrium is found, or where displacements run away: where they grow with F
// hundreds of times faster than in the first step, although the out-of-balance force is small. A step that fails is
// tried again with half of it, and the end of the bracket once more from close by, so that a step too long for Newton
// is not taken for failure.
#include <vector>

#include "polder/stability/fem_solver.hpp"

namespace polder {

struct StrengthReductionOptions {
  double start = 1;           ///< F of the first equilibrium; lowered where there is none
  double step = 0.1;          ///< first increase of F
  double resolution = 0.005;  ///< F is bracketed within this
  double highest = 10;        ///< the search ends here: the section does not fail
  double runaway = 300;       ///< growth of displacement with F over that of the first step that means failure
  FemOptions newton{};
};

struct StrengthReductionResult {
  double factor = 0;              ///< middle of the bracket
  double stable = 0, failed = 0;  ///< its ends: the last F in equilibrium, the first without
  bool found = false;             ///< false: no failure up to `highest`, or no equilibrium even at small F
  /// Largest displacement (m) at every F tried, in equilibrium or not, in the order of F. Steps that failed below
  /// `stable` are left out.
  struct Point {
    double factor, displacement;
    bool converged;
    bool runs_away;  ///< found balance, but only after displacements that mean failure
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
