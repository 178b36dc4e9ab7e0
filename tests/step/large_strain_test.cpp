// Strain and rotation to second order: a neo-Hookean point that is turned and sheared far, in many steps or in twice as
// many, against the stress of the whole deformation.
#include "polder/step/large_strain.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

namespace polder {
namespace {

using Matrix = Eigen::Matrix3d;

constexpr double young = 1e3, poisson = 0.3, porosity = 0.5;  // Pa
constexpr double shear = young / (2 * (1 + poisson)), lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));

/// Shear, then a turn, about an axis in the plane's normal or (3D) askew; `at` from 0 to 1.
template <class Space>
Matrix deformation(double at) {
  Matrix sheared = Matrix::Identity();
  sheared(0, 1) = 1.5 * at * at;
  sheared(1, 1) = 1 + 0.2 * std::sin(3 * at);
  if (Space::axes == 3) sheared(2, 0) = 0.7 * at;
  const Eigen::Vector3d axis = Space::axes == 2 ? Eigen::Vector3d(0, 0, 1) : Eigen::Vector3d(1, 2, -2) / 3;
  Matrix k = Matrix::Zero();
  k << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  const double angle = 1.2 * at;
  return (Matrix::Identity() + std::sin(angle) * k + (1 - std::cos(angle)) * k * k) * sheared;
}

Matrix exact_stress(const Matrix& f) {
  const double volume = f.determinant();
  return (shear * (f * f.transpose() - Matrix::Identity()) + lambda * std::log(volume) * Matrix::Identity()) / volume;
}

/// Largest error of a component at the end, over the largest component.
template <class Space>
double error_after(int steps) {
  const LawDescription* law = find_soil_law("neo-hookean");
  const std::array values{young, poisson};
  const auto body = law->make(values, {1, porosity, 0.9});
  SoilPoints<Space> soil;
  for (Array& s : soil.stress) s.assign(1, 0.0);
  double n = porosity;
  for (int step = 0; step < steps; ++step) {
    const double dt = 1.0 / steps;
    const Matrix gradient =
        (deformation<Space>((step + 1) * dt) * deformation<Space>(step * dt).inverse() - Matrix::Identity()) / dt;
    VelocityGradients<Space> gradients;
    double dilation = 0;
    for (int a = 0; a < Space::axes; ++a) {
      dilation += gradient(a, a);
      for (int b = 0; b < Space::axes; ++b) gradients.at[a][b][0] = gradient(a, b);
    }
    StressBatch<Space::stress> batch{};
    stretch_and_turn(gradients, dt, 0, 1, soil, &dilation, batch);
    EXPECT_NEAR(batch.strain[0][0] + batch.strain[1][0] + batch.strain[2][0], dilation * dt, 1e-14);
    n = 1 - (1 - n) * std::exp(-dilation * dt);
    batch.porosity[0] = n;
    batch.count = 1;
    body->update(batch);
    for (int s = 0; s < Space::stress; ++s) soil.stress[s][0] = batch.stress[s][0];
  }
  const Matrix exact = exact_stress(deformation<Space>(1));
  double worst = 0;
  for (int a = 0; a < Space::axes; ++a)
    for (int b = 0; b < Space::axes; ++b)
      worst = std::max(worst, std::abs(soil.stress[stress_index<Space>(a, b)][0] - exact(a, b)));
  worst = std::max(worst, std::abs(soil.stress[2][0] - exact(2, 2)));
  return worst / exact.cwiseAbs().maxCoeff();
}

template <class Space>
void expect_second_order() {
  const double once = error_after<Space>(50), twice = error_after<Space>(100);
  EXPECT_LT(once, 5e-3);
  EXPECT_GT(std::log2(once / twice), 1.85) << once << " with 50 steps, " << twice << " with 100";
}

TEST(LargeStrain, IsOfSecondOrderInTheStepInPlaneStrain) { expect_second_order<PlaneStrain>(); }
TEST(LargeStrain, IsOfSecondOrderInTheStepIn3d) { expect_second_order<Solid>(); }

TEST(LargeStrain, LeavesStressAndVolumeAloneInATurn) {
  SoilPoints<PlaneStrain> soil;
  const double before[] = {-100, -40, -30, 20};
  for (int s = 0; s < 4; ++s) soil.stress[s].assign(1, before[s]);
  const double angle = 0.01, c = std::cos(angle), s = std::sin(angle);
  VelocityGradients<PlaneStrain> gradients;
  gradients.at[0][0][0] = gradients.at[1][1][0] = c - 1;
  gradients.at[0][1][0] = -s;
  gradients.at[1][0][0] = s;
  double dilation = 2 * (c - 1);
  StressBatch<4> batch{};
  stretch_and_turn(gradients, 1.0, 0, 1, soil, &dilation, batch);
  EXPECT_NEAR(dilation, 0, 1e-8);  // angle⁴; the divergence itself says −angle² = −1e-4
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(batch.strain[k][0], 0, 1e-8) << k;
  EXPECT_NEAR(batch.stress[0][0], c * c * -100 + s * s * -40 - 2 * s * c * 20, 1e-4);
  EXPECT_NEAR(batch.stress[1][0], s * s * -100 + c * c * -40 + 2 * s * c * 20, 1e-4);
  EXPECT_NEAR(batch.stress[3][0], s * c * (-100 + 40) + (c * c - s * s) * 20, 1e-4);
  EXPECT_EQ(batch.stress[2][0], -30);
}

}  // namespace
}  // namespace polder
