#include "polder/stability/fem_material.hpp"

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace polder;

TEST(FemStressPoint, TangentIsTheSlopeOfTheStress) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  int yielded = 0;
  for (int i = 0; i < 4000; ++i) {
    const double phi = 0.3 + 0.25 * unit(random), sine = std::sin(0.5 * phi * (1 + unit(random)));
    const FemStrength m{Elasticity::from_young(1e7, 0.3), mohr_coulomb_strength(5e3, phi, NAN), (1 + sine) / (1 - sine),
                        false};
    const std::array<double, 4> start{-5e4 + 4e4 * unit(random), -5e4 + 4e4 * unit(random), -5e4 + 4e4 * unit(random),
                                      2e4 * unit(random)};
    const Eigen::Vector3d de{8e-3 * unit(random), 8e-3 * unit(random), 8e-3 * unit(random)};
    const FemStress at = update_stress(m, start, de);
    yielded += at.yields;
    Eigen::Matrix3d numeric;
    bool smooth = true;
    for (int j = 0; j < 3; ++j) {
      Eigen::Vector3d up = de, down = de;
      const double h = 1e-8;
      up[j] += h;
      down[j] -= h;
      const FemStress a = update_stress(m, start, up), b = update_stress(m, start, down);
      const std::array<int, 3> part{0, 1, 3};
      for (int k = 0; k < 3; ++k) {
        numeric(k, j) = (a.stress[part[k]] - b.stress[part[k]]) / (2 * h);
        const double left = (at.stress[part[k]] - b.stress[part[k]]) / h,
                     right = (a.stress[part[k]] - at.stress[part[k]]) / h;
        smooth = smooth && std::abs(left - right) < 1e-3 * 1e7;
      }
    }
    if (smooth) {
      EXPECT_LT((numeric - at.tangent).norm(), 2e-3 * 1e7) << "sample " << i;
    }
  }
  EXPECT_GT(yielded, 2000);
}

}  // namespace
