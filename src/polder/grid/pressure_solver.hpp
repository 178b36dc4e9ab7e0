#pragma once
// Conjugate gradients for the pressure: symmetric positive definite, five or seven points, preconditioned by multigrid.
#include "polder/grid/multigrid.hpp"

namespace polder {

struct SolveResult {
  int iterations = 0;
  double residual = 0;  ///< ‖r‖/‖b‖ at the end
  bool converged = true;
};

template <class Space>
class PressureSolver {
 public:
  explicit PressureSolver(const Lattice<Space>& lattice);

  CellMatrix<Space> matrix;
  Array right_side;

  /// Solves matrix · x = right_side from the x given, to a residual of `tolerance`·‖right_side‖. Cells outside the
  /// system end with x = 0.
  SolveResult solve(Array& x, double tolerance, int most_iterations, Team& team);

 private:
  SolveResult solve_together(Array& x, double tolerance, int most_iterations, Team& team);
  void multiply_row(const double* x, double* y, std::ptrdiff_t at) const;
  template <class Term>
  double sum_rows(Team& team, int rank, int slot, Term&& term);

  Lattice<Space> lattice_;
  Multigrid<Space> multigrid_;
  Array residual_, preconditioned_, direction_, product_;
  std::array<std::vector<double>, 4> partial_;  // per row, one array per kind of sum
};

}  // namespace polder
