#include "polder/step/large_strain.hpp"

#include <Eigen/Core>

namespace polder {

namespace {

using Matrix = Eigen::Matrix3d;

/// The turn by the skew matrix `w` (Cayley's form: a rotation whatever the size of `w`, by its angle to second order).
Matrix turn(const Matrix& w) {
  const double quarter = 0.25 * (w(0, 1) * w(0, 1) + w(1, 2) * w(1, 2) + w(2, 0) * w(2, 0));
  return Matrix::Identity() + (w + 0.5 * w * w) / (1 + quarter);
}

template <class Space>
Matrix stress_of(const SoilPoints<Space>& soil, std::size_t p) {
  Matrix s = Matrix::Zero();
  s(2, 2) = soil.stress[2][p];
  for (int a = 0; a < Space::axes; ++a)
    for (int b = 0; b < Space::axes; ++b) s(a, b) = soil.stress[stress_index<Space>(a, b)][p];
  return s;
}

template <class Space>
void put(const Matrix& m, int l, double (&components)[Space::stress][StressBatch<Space::stress>::capacity]) {
  components[2][l] = m(2, 2);
  for (int a = 0; a < Space::axes; ++a)
    for (int b = a; b < Space::axes; ++b) components[stress_index<Space>(a, b)][l] = m(a, b);
}

}  // namespace

template <class Space>
void stretch_and_turn(const VelocityGradients<Space>& gradients, double dt, std::size_t first, int count,
                      const SoilPoints<Space>& soil, double* dilation, StressBatch<Space::stress>& batch) {
  constexpr int axes = Space::axes;
  for (int l = 0; l < count; ++l) {
    Matrix gradient = Matrix::Zero();
    for (int a = 0; a < axes; ++a)
      for (int b = 0; b < axes; ++b) gradient(a, b) = dt * gradients.at[a][b][l];
    const Matrix d = 0.5 * (gradient + gradient.transpose()), w = 0.5 * (gradient - gradient.transpose());
    const double second = -0.5 * (gradient * gradient).trace();
    const double mean = (dilation[l] * dt - gradient.trace()) / axes;
    Matrix strain = d + 0.5 * (w * d - d * w - w * w - d * d);
    for (int a = 0; a < axes; ++a) strain(a, a) += mean;
    dilation[l] += second / dt;
    put<Space>(strain, l, batch.strain);
    const Matrix r = turn(w - 0.5 * (d * w + w * d));
    put<Space>(r * stress_of(soil, first + static_cast<std::size_t>(l)) * r.transpose(), l, batch.stress);
  }
}

template void stretch_and_turn(const VelocityGradients<PlaneStrain>&, double, std::size_t, int,
                               const SoilPoints<PlaneStrain>&, double*, StressBatch<PlaneStrain::stress>&);
template void stretch_and_turn(const VelocityGradients<Solid>&, double, std::size_t, int, const SoilPoints<Solid>&,
                               double*, StressBatch<Solid::stress>&);

}  // namespace polder
