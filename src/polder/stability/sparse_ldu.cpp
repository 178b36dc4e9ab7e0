#include "polder/stability/sparse_ldu.hpp"

#include <Eigen/OrderingMethods>
#include <algorithm>
#include <cmath>

namespace polder {

void SparseLdu::analyse(const Eigen::SparseMatrix<double>& matrix) {
  n_ = static_cast<int>(matrix.cols());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(matrix, permutation);
  order_.assign(permutation.indices().data(), permutation.indices().data() + n_);
  place_.assign(n_, 0);
  for (int k = 0; k < n_; ++k) place_[order_[k]] = k;

  parent_.assign(n_, -1);
  std::vector<int> mark(n_, -1), count(n_, 0);
  for (int k = 0; k < n_; ++k) {
    mark[k] = k;
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, order_[k]); it; ++it)
      for (int i = place_[it.row()]; i < k && mark[i] != k; i = parent_[i]) {
        if (parent_[i] < 0) parent_[i] = k;
        ++count[i];
        mark[i] = k;
      }
  }
  start_.assign(n_ + 1, 0);
  for (int k = 0; k < n_; ++k) start_[k + 1] = start_[k] + count[k];
  index_.assign(start_[n_], 0);
  lower_.assign(start_[n_], 0);
  upper_.assign(start_[n_], 0);
  diagonal_.assign(n_, 0);
}

void SparseLdu::factorise(const Eigen::SparseMatrix<double>& matrix) {
  std::vector<double> column(n_, 0), row(n_, 0);
  std::vector<int> mark(n_, -1), pattern(n_), path(n_), filled(start_.begin(), start_.end() - 1);
  const Eigen::SparseMatrix<double> transposed = matrix.transpose();
  double largest = 0;
  for (int k = 0; k < n_; ++k) {
    int top = n_;
    mark[k] = k;
    const int old = order_[k];
    Eigen::SparseMatrix<double>::InnerIterator across(transposed, old);
    for (Eigen::SparseMatrix<double>::InnerIterator down(matrix, old); down; ++down, ++across) {
      int i = place_[down.row()];
      if (i > k) continue;
      column[i] += down.value();
      row[i] += across.value();
      int length = 0;
      for (; i < k && mark[i] != k; i = parent_[i]) {
        path[length++] = i;
        mark[i] = k;
      }
      while (length > 0) pattern[--top] = path[--length];
    }
    double pivot = column[k];
    column[k] = row[k] = 0;
    for (; top < n_; ++top) {
      const int i = pattern[top];
      const double c = column[i], r = row[i];
      column[i] = row[i] = 0;
      const int end = filled[i];
      for (int p = start_[i]; p < end; ++p) {
        const int j = index_[p];
        column[j] -= lower_[p] * c;
        row[j] -= upper_[p] * r;
      }
      const double l = r / diagonal_[i];
      pivot -= l * c;
      index_[end] = k;
      lower_[end] = l;
      upper_[end] = c / diagonal_[i];
      ++filled[i];
    }
    largest = std::max(largest, std::abs(pivot));
    diagonal_[k] = std::abs(pivot) < 1e-10 * largest ? std::copysign(1e-10 * largest, pivot) : pivot;
  }
}

Eigen::VectorXd SparseLdu::solve(const Eigen::VectorXd& b) const {
  std::vector<double> x(n_);
  for (int k = 0; k < n_; ++k) x[k] = b[order_[k]];
  for (int k = 0; k < n_; ++k)
    for (int p = start_[k]; p < start_[k + 1]; ++p) x[index_[p]] -= lower_[p] * x[k];
  for (int k = n_ - 1; k >= 0; --k) {
    double sum = x[k] / diagonal_[k];
    for (int p = start_[k]; p < start_[k + 1]; ++p) sum -= upper_[p] * x[index_[p]];
    x[k] = sum;
  }
  Eigen::VectorXd out(n_);
  for (int k = 0; k < n_; ++k) out[order_[k]] = x[k];
  return out;
}

}  // namespace polder
