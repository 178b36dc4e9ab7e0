#include "polder/stability/sparse_ldu.hpp"

#include <gtest/gtest.h>

#include <random>

TEST(SparseLdu, SolvesUnsymmetricSystemsOfSymmetricPattern) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int n : {1, 7, 60, 400}) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n; ++i) entries.emplace_back(i, i, 8 + unit(random));
    for (int k = 0; k < 3 * n; ++k) {
      const int i = static_cast<int>(random() % n), j = static_cast<int>(random() % n);
      entries.emplace_back(i, j, unit(random));
      entries.emplace_back(j, i, unit(random));
    }
    Eigen::SparseMatrix<double> a(n, n);
    a.setFromTriplets(entries.begin(), entries.end());
    const Eigen::VectorXd exact = Eigen::VectorXd::Random(n), b = a * exact;
    polder::SparseLdu ldu;
    ldu.analyse(a);
    for (int again = 0; again < 2; ++again) {
      ldu.factorise(a);
      EXPECT_LT((ldu.solve(b) - exact).norm(), 1e-10 * std::sqrt(n)) << "n " << n;
    }
  }
}
