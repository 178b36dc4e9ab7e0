// What must hold for every registered law, over random states. A law that is added without parameters here fails.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <map>

#include "support.hpp"

namespace polder {
namespace {

using Eigen::Matrix3d;
using support::degrees;
using support::Random;

const std::map<std::string_view, support::Given>& examples() {
  static const std::map<std::string_view, support::Given> table = {
      {"linear-elastic", {{"young_modulus", 1e7}}},
      {"neo-hookean", {{"young_modulus", 1e7}}},
      {"mohr-coulomb",
       {{"young_modulus", 1e7},
        {"friction_angle", degrees(32)},
        {"cohesion", 3e3},
        {"dilatancy_angle", degrees(8)},
        {"tension_strength", 1e3}}},
      {"softening-mohr-coulomb",
       {{"young_modulus", 1e7},
        {"friction_angle", degrees(32)},
        {"cohesion", 3e3},
        {"dilatancy_angle", degrees(8)},
        {"residual_friction_angle", degrees(20)},
        {"residual_cohesion", 500},
        {"softening_slip", 1e-2}}},
      {"tresca", {{"young_modulus", 1e7}, {"undrained_shear_strength", 2e4}}},
      {"drucker-prager",
       {{"young_modulus", 1e7}, {"friction_angle", degrees(32)}, {"cohesion", 3e3}, {"dilatancy_angle", degrees(8)}}},
      {"modified-cam-clay",
       {{"compression_index", 0.2},
        {"swelling_index", 0.03},
        {"friction_angle", degrees(25)},
        {"preconsolidation_pressure", 1e5}}},
  };
  return table;
}

template <int N>
StressBatch<N> start_of(const SoilLaw& law, const Matrix3d& stress, const Matrix3d& strain) {
  StressBatch<N> batch{};
  batch.count = 1;
  const int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  for (int k = 0; k < N; ++k) {
    batch.stress[k][0] = stress(row[k], column[k]);
    batch.strain[k][0] = strain(row[k], column[k]);
  }
  batch.porosity[0] = 0.41;
  double state[StressBatch<N>::max_state - 1] = {};
  const std::size_t used = law.state_names().size();
  law.initial_state(-stress.trace() / 3, 0.41, std::span(state).first(used));
  for (std::size_t k = 0; k < used; ++k) batch.state[k + 1][0] = state[k];
  return batch;
}

template <int N>
Matrix3d stress_of(const StressBatch<N>& batch, int i = 0) {
  const double xy = batch.stress[3][i], yz = N == 6 ? batch.stress[N - 2][i] : 0,
               zx = N == 6 ? batch.stress[N - 1][i] : 0;
  Matrix3d s;
  s << batch.stress[0][i], xy, zx, xy, batch.stress[1][i], yz, zx, yz, batch.stress[2][i];
  return s;
}

Matrix3d random_symmetric(Random& random, double size, bool plane) {
  Matrix3d s = Matrix3d::Zero();
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      if (!plane || i == j || (i == 0 && j == 1)) s(i, j) = s(j, i) = size * random.normal();
  return s;
}

template <class Check>
void for_every_law(unsigned seed, int count, bool plane, const Check& check) {
  for (const LawDescription& description : soil_laws()) {
    ASSERT_TRUE(examples().contains(description.name)) << "give " << description.name << " parameters in this file";
    SCOPED_TRACE(description.name);
    Random random(seed);
    const auto law = support::make_law(description.name, examples().at(description.name), {0.05, 0.4, 0.5});
    for (int i = 0; i < count && !::testing::Test::HasFatalFailure(); ++i) {
      const Matrix3d stress = random_symmetric(random, 1e4, plane) - 6e4 * Matrix3d::Identity();
      Matrix3d strain = random_symmetric(random, std::pow(10, random.uniform(-5, -2)), plane);
      if (plane) strain(2, 2) = 0;
      check(*law, stress, strain, random);
    }
  }
}

TEST(EverySoilLaw, AgreesBetweenPlaneStrainAndThreeDimensions) {
  for_every_law(31, 3000, true, [](const SoilLaw& law, const Matrix3d& stress, const Matrix3d& strain, Random&) {
    auto plane = start_of<4>(law, stress, strain);
    auto solid = start_of<6>(law, stress, strain);
    law.update(plane);
    law.update(solid);
    ASSERT_LE((stress_of(plane) - stress_of(solid)).norm(), 1e-9 * stress.norm());
    for (std::size_t k = 0; k < 2; ++k)
      ASSERT_NEAR(plane.state[k][0], solid.state[k][0], 1e-7 * (std::abs(plane.state[k][0]) + strain.norm()));
  });
}

TEST(EverySoilLaw, IsIsotropic) {
  for_every_law(
      32, 3000, false, [](const SoilLaw& law, const Matrix3d& stress, const Matrix3d& strain, Random& random) {
        const Eigen::Quaterniond q(random.normal(), random.normal(), random.normal(), random.normal());
        const Matrix3d R = q.normalized().toRotationMatrix();
        auto straight = start_of<6>(law, stress, strain);
        auto rotated = start_of<6>(law, R * stress * R.transpose(), R * strain * R.transpose());
        law.update(straight);
        law.update(rotated);
        ASSERT_LE((stress_of(rotated) - R * stress_of(straight) * R.transpose()).norm(), 1e-8 * stress.norm());
      });
}

TEST(EverySoilLaw, LeavesARestingPointAtRest) {
  for_every_law(33, 1000, false, [](const SoilLaw& law, const Matrix3d& stress, const Matrix3d& strain, Random&) {
    auto point = start_of<6>(law, stress, strain);
    for (int i = 0; i < 50; ++i) law.update(point);  // towards failure, so that it rests on the surface
    for (auto& row : point.strain) row[0] = 0;
    for (int i = 0; i < 40; ++i) law.update(point);  // a law may take a step to notice that its strength has fallen
    const auto before = point;
    law.update(point);
    ASSERT_LE((stress_of(point) - stress_of(before)).norm(), 1e-9 * std::max(stress.norm(), stress_of(before).norm()));
    ASSERT_NEAR(point.state[0][0], before.state[0][0], 1e-9 * (1 + before.state[0][0]));
  });
}

TEST(EverySoilLaw, TreatsPointsOfABatchAlikeWhateverTheirNeighbours) {
  for_every_law(34, 100, true, [](const SoilLaw& law, const Matrix3d&, const Matrix3d&, Random& random) {
    StressBatch<4> batch{};
    batch.count = 1 + static_cast<int>(random.uniform(0, 63.99));
    std::vector<Matrix3d> alone;
    for (int i = 0; i < batch.count; ++i) {
      auto point = start_of<4>(law, random_symmetric(random, 1e4, true) - 6e4 * Matrix3d::Identity(),
                               random_symmetric(random, 3e-3, true));
      for (int k = 0; k < 4; ++k) batch.stress[k][i] = point.stress[k][0], batch.strain[k][i] = point.strain[k][0];
      batch.porosity[i] = point.porosity[0];
      for (int k = 0; k < 4; ++k) batch.state[k][i] = point.state[k][0];
      law.update(point);
      alone.push_back(stress_of(point));
    }
    law.update(batch);
    for (int i = 0; i < batch.count; ++i)
      ASSERT_LE((stress_of(batch, i) - alone[static_cast<std::size_t>(i)]).norm(), 1e-9 * 1e5);
  });
}

TEST(EverySoilLaw, IsElasticallyNoStifferThanItSays) {
  // (Plastic flow that is not associated can answer a few percent more stiffly in some directions.)
  for_every_law(35, 1000, false, [](const SoilLaw& law, const Matrix3d& stress, const Matrix3d&, Random& random) {
    const double pressure = -stress.trace() / 3;
    const Eigen::Vector3d n = Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    const Matrix3d start = -pressure * Matrix3d::Identity();
    auto point = start_of<6>(law, start, 1e-6 * n * n.transpose());
    law.update(point);
    const double stiffness = n.dot((stress_of(point) - start) * n) / 1e-6;
    ASSERT_LE(stiffness, law.constrained_modulus(pressure) * (1 + 1e-9));
    ASSERT_GT(stiffness, 0.2 * law.constrained_modulus(pressure));
  });
}

}  // namespace
}  // namespace polder
