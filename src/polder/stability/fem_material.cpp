#include "polder/stability/fem_material.hpp"

#include <algorithm>
#include <cmath>

namespace polder {
namespace {

PlacedPrincipal returned(const FemStrength& m, double high, double low, double axis) {
  const PrincipalOrder order = sort_principal(high, low, axis);
  if (!yields(m.strength, order.sorted)) return {high, low, axis};
  return place_principal(order, mohr_coulomb_return(order.sorted, m.strength, m.dilation, m.elasticity));
}

}  // namespace

FemStress update_stress(const FemStrength& m, const std::array<double, 4>& start, const Eigen::Vector3d& de) {
  const double lambda = m.elasticity.lambda, G = m.elasticity.shear;
  const double volume = lambda * (de[0] + de[1]);
  FemStress out{
      {start[0] + volume + 2 * G * de[0], start[1] + volume + 2 * G * de[1], start[2] + volume, start[3] + G * de[2]},
      Eigen::Matrix3d::Zero(),
      false};
  out.tangent << lambda + 2 * G, lambda, 0, lambda, lambda + 2 * G, 0, 0, 0, G;
  if (m.elastic) return out;

  const PlanePair trial = principal_pair(out.stress[0], out.stress[1], out.stress[3]);
  const double axis = out.stress[2];
  if (!yields(m.strength, sort_principal(trial.high, trial.low, axis).sorted)) return out;
  out.yields = true;
  const PlacedPrincipal now = returned(m, trial.high, trial.low, axis);
  const double mean = (now.high + now.low) / 2, half = (now.high - now.low) / 2;
  out.stress = {mean + half * trial.cosine, mean - half * trial.cosine, now.axis, half * trial.sine};

  // Slopes of the returned in-plane pair; high is moved up and low down so that their order stays.
  const double step = 1e-6 * (std::abs(trial.high) + std::abs(trial.low) + std::abs(axis) + 1e-6 * G);
  const PlacedPrincipal by_high = returned(m, trial.high + step, trial.low, axis);
  const PlacedPrincipal by_low = returned(m, trial.high, trial.low - step, axis);
  const PlacedPrincipal by_axis = returned(m, trial.high, trial.low, axis + step);
  Eigen::Matrix<double, 2, 3> slope;
  slope << by_high.high - now.high, now.high - by_low.high, by_axis.high - now.high,  //
      by_high.low - now.low, now.low - by_low.low, by_axis.low - now.low;
  slope /= step;
  Eigen::Matrix<double, 3, 2> elastic;
  elastic << lambda + 2 * G, lambda, lambda, lambda + 2 * G, lambda, lambda;
  Eigen::Matrix3d principal = Eigen::Matrix3d::Zero();
  principal.topLeftCorner<2, 2>() = slope * elastic;
  const double spread = trial.high - trial.low;
  principal(2, 2) = spread > 1e-12 * G ? G * std::max(now.high - now.low, 0.0) / spread : G;

  const double c2 = (1 + trial.cosine) / 2, s2 = (1 - trial.cosine) / 2, cs = trial.sine / 2;
  Eigen::Matrix3d turn;  // strains in the principal axes from strains in x, y
  turn << c2, s2, cs, s2, c2, -cs, -2 * cs, 2 * cs, c2 - s2;
  out.tangent = turn.transpose() * principal * turn;
  return out;
}

}  // namespace polder
