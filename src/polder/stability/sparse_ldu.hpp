#pragma once
// A = L D U of a sparse matrix with symmetric pattern but unsymmetric values, without pivoting: the tangent of
// non-associated plasticity. Row by row along the elimination tree, as LDLᵀ (Davis 2005), with both factors' values on
// one pattern; ordered by minimum degree once.
#include <Eigen/Sparse>
#include <vector>

namespace polder {

class SparseLdu {
 public:
  /// Orders and finds the pattern of the factors. The pattern of `matrix` must be symmetric.
  void analyse(const Eigen::SparseMatrix<double>& matrix);
  /// Factorises a matrix of the analysed pattern. A pivot that vanishes is replaced by a tiny one, as a stiff spring
  /// would; the caller's iteration corrects for it.
  void factorise(const Eigen::SparseMatrix<double>& matrix);
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

 private:
  int n_ = 0;
  std::vector<int> order_, place_;  ///< order_[new] = old
  std::vector<int> parent_;
  std::vector<int> start_, index_;  ///< columns of L (rows of U)
  std::vector<double> lower_, upper_, diagonal_;
};

}  // namespace polder
