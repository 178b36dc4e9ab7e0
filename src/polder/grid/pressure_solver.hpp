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

  /// Solves matrix · x = right_side from the x given, to a residual of `tolerance`·‖right_side‖, in the rows given,
  /// where the caller has filled matrix and right side; elsewhere x is 0 and the matrix empty. Cells outside the system
  /// end with x = 0. With a `trend` the multiple of it is added first that comes closest to the solution (in the
  /// matrix's norm); afterwards it is by what x has changed: where solutions follow each other steadily, the next
  /// change.
  SolveResult solve(const ActiveRows<Space>& rows, Array& x, double tolerance, int most_iterations, Team& team,
                    Array* trend = nullptr);

 private:
  SolveResult solve_together(const ActiveRows<Space>& rows, Array& x, double tolerance, int most_iterations, Team& team,
                             Array* trend);
  void leave(const std::vector<RowSpan>& now);  // empties the matrix where it was filled once, but is no longer
  void multiply_row(const double* x, double* y, std::ptrdiff_t at, std::ptrdiff_t n) const;
  void close_row(const double* x, double* y, std::ptrdiff_t row) const;
  template <class Term>
  double sum_rows(const std::vector<RowSpan>& spans, const std::vector<std::ptrdiff_t>& bounds, Team& team, int rank,
                  int slot, Term&& term);

  Lattice<Space> lattice_;
  Multigrid<Space> multigrid_;
  Array residual_, preconditioned_, direction_, product_;
  std::array<std::vector<double>, 4> partial_;  // per row, one array per kind of sum
  std::vector<RowSpan> inside_;                 // the cells of the system
  std::vector<RowSpan> last_;                   // the rows of the last call
};

}  // namespace polder
