// The Mohr–Coulomb return: properties over random states, and agreement with two slow and different ways to compute it.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <optional>

#include "support.hpp"

namespace polder {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using support::degrees;
using support::make_law;
using support::Random;

struct Soil {
  double young = 1e7, poisson = 0.3, cohesion = 0, friction = 0.6, dilation = 0.1;
  double tension = std::numeric_limits<double>::quiet_NaN();

  std::unique_ptr<SoilLaw> law() const {
    return make_law("mohr-coulomb", {{"young_modulus", young},
                                     {"poisson_ratio", poisson},
                                     {"cohesion", cohesion},
                                     {"friction_angle", friction},
                                     {"dilatancy_angle", dilation},
                                     {"tension_strength", tension},
                                     {"dilatancy", 1}});
  }
  double slope() const { return (1 + std::sin(friction)) / (1 - std::sin(friction)); }
  double flow() const { return (1 + std::sin(dilation)) / (1 - std::sin(dilation)); }
  double offset() const { return 2 * cohesion * std::cos(friction) / (1 - std::sin(friction)); }
  double apex() const { return friction > 0 ? cohesion / std::tan(friction) : 1e30; }
  double cut_off() const { return std::isnan(tension) ? apex() : std::min(tension, apex()); }
  double shear() const { return young / (2 * (1 + poisson)); }
  double lambda() const { return young * poisson / ((1 + poisson) * (1 - 2 * poisson)); }
  Matrix3d stiffness() const {  // in principal space
    return Matrix3d::Constant(lambda()) + 2 * shear() * Matrix3d::Identity();
  }
};

Soil random_soil(Random& random) {
  Soil soil;
  soil.young = std::pow(10, random.uniform(5, 9));
  soil.poisson = random.uniform(0, 0.49);
  soil.friction = random.chance(0.05) ? 0 : random.uniform(0.01, 0.9);
  soil.dilation = random.chance(0.3) ? 0 : random.uniform(0, soil.friction);
  soil.cohesion = random.chance(0.3) && soil.friction > 0 ? 0 : random.uniform(0.1e3, 20e3);
  if (random.chance(0.5)) soil.tension = random.uniform(0, 20e3);
  return soil;
}

constexpr double scale = 30e3;  // Pa, size of the random stresses

template <int N>
void set_point(StressBatch<N>& batch, int i, const Matrix3d& stress, const Matrix3d& strain) {
  const int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  for (int k = 0; k < N; ++k) {
    batch.stress[k][i] = stress(row[k], column[k]);
    batch.strain[k][i] = strain(row[k], column[k]);
  }
  batch.porosity[i] = 0.4;
}

template <int N>
Matrix3d stress_of(const StressBatch<N>& batch, int i) {
  const double yz = N == 6 ? batch.stress[N - 2][i] : 0, zx = N == 6 ? batch.stress[N - 1][i] : 0;
  const double xy = batch.stress[3][i];
  Matrix3d s;
  s << batch.stress[0][i], xy, zx, xy, batch.stress[1][i], yz, zx, yz, batch.stress[2][i];
  return s;
}

/// Principal values, largest first.
Vector3d principal(const Matrix3d& s) { return Eigen::SelfAdjointEigenSolver<Matrix3d>(s).eigenvalues().reverse(); }

/// How far outside the surface, Pa; negative inside.
double excess(const Soil& soil, const Matrix3d& s) {
  const Vector3d e = principal(s);
  return std::max((soil.slope() * e[0] - e[2] - soil.offset()) / soil.slope(), e[0] - soil.cut_off());
}

Matrix3d random_symmetric(Random& random, double size, bool plane) {
  Matrix3d s = Matrix3d::Zero();
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      if (!plane || i == j || (i == 0 && j == 1)) s(i, j) = s(j, i) = size * random.normal();
  return s;
}

/// A stress on or inside the surface: a random one, shrunk towards a point inside where needed.
Matrix3d admissible(const Soil& soil, Random& random, bool plane) {
  const Matrix3d inside = -2 * scale * Matrix3d::Identity();
  Matrix3d offset = random_symmetric(random, scale, plane);
  if (random.chance(0.1)) offset = Matrix3d(Vector3d(1, 1, random.normal()).asDiagonal()) * scale;  // equal pair
  for (double shrink = 1; shrink > 1e-6; shrink *= 0.9)
    if (excess(soil, inside + shrink * offset) <= 0) return inside + shrink * offset;
  return inside;
}

Matrix3d elastic_strain(const Soil& soil, const Matrix3d& stress) {
  return ((1 + soil.poisson) * stress - soil.poisson * stress.trace() * Matrix3d::Identity()) / soil.young;
}

/// Runs `check(soil, law, stress, strain)` on random states, in plane strain and in three dimensions.
template <class Check>
void over_random_states(unsigned seed, int count, const Check& check) {
  Random random(seed);
  for (int i = 0; i < count; ++i) {
    const Soil soil = random_soil(random);
    const bool plane = i % 2 == 0;
    const Matrix3d stress = admissible(soil, random, plane);
    const double size = std::pow(10, random.uniform(-3, 1)) * scale / soil.young;
    check(soil, stress, random_symmetric(random, size, plane), plane);
  }
}

template <int N>
Matrix3d updated(const SoilLaw& law, const Matrix3d& stress, const Matrix3d& strain, double* plastic = nullptr) {
  StressBatch<N> batch{};
  batch.count = 1;
  set_point(batch, 0, stress, strain);
  law.update(batch);
  if (plastic) *plastic = batch.state[0][0];
  return stress_of(batch, 0);
}

TEST(MohrCoulomb, ReturnsOnOrInsideTheSurface) {
  over_random_states(11, 40000, [](const Soil& soil, const Matrix3d& stress, const Matrix3d& strain, bool plane) {
    const auto law = soil.law();
    const Matrix3d s = plane ? updated<4>(*law, stress, strain) : updated<6>(*law, stress, strain);
    ASSERT_LE(excess(soil, s), 1e-9 * std::max(s.norm(), scale));
  });
}

TEST(MohrCoulomb, KeepsAnElasticStepToTheLastBit) {
  over_random_states(12, 20000, [](const Soil& soil, const Matrix3d& stress, const Matrix3d& strain, bool) {
    const Matrix3d trial = updated<6>(
        *make_law("linear-elastic", {{"young_modulus", soil.young}, {"poisson_ratio", soil.poisson}}), stress, strain);
    if (excess(soil, trial) > -1e-9 * scale) return;
    double plastic = -1;
    ASSERT_EQ(updated<6>(*soil.law(), stress, strain, &plastic), trial);
    ASSERT_EQ(plastic, 0);
  });
}

TEST(MohrCoulomb, NeverCreatesEnergyInPlasticFlow) {
  over_random_states(13, 40000, [](const Soil& soil, const Matrix3d& stress, const Matrix3d& strain, bool) {
    const Matrix3d s = updated<6>(*soil.law(), stress, strain);
    const Matrix3d plastic_strain = strain - elastic_strain(soil, s - stress);
    const double work = (s.cwiseProduct(plastic_strain)).sum();
    ASSERT_GE(work, -1e-9 * s.norm() * strain.norm() - 1e-9 * scale * strain.norm());
  });
}

TEST(MohrCoulomb, IsIdempotent) {
  over_random_states(14, 20000, [](const Soil& soil, const Matrix3d& stress, const Matrix3d& strain, bool plane) {
    const auto law = soil.law();
    const Matrix3d none = Matrix3d::Zero();
    const Matrix3d once = plane ? updated<4>(*law, stress, strain) : updated<6>(*law, stress, strain);
    const Matrix3d twice = plane ? updated<4>(*law, once, none) : updated<6>(*law, once, none);
    ASSERT_LE((once - twice).norm(), 1e-11 * std::max(once.norm(), scale));
  });
}

TEST(MohrCoulomb, IsIsotropic) {
  Random random(15);
  for (int i = 0; i < 20000; ++i) {
    const Soil soil = random_soil(random);
    const Matrix3d stress = admissible(soil, random, false);
    const Matrix3d strain = random_symmetric(random, scale / soil.young, false);
    const Eigen::Quaterniond q(random.normal(), random.normal(), random.normal(), random.normal());
    const Matrix3d R = q.normalized().toRotationMatrix();
    const auto law = soil.law();
    const Matrix3d rotated = updated<6>(*law, R * stress * R.transpose(), R * strain * R.transpose());
    const Matrix3d straight = updated<6>(*law, stress, strain);
    ASSERT_LE((rotated - R * straight * R.transpose()).norm(), 1e-10 * std::max(straight.norm(), scale)) << i;
  }
}

TEST(MohrCoulomb, AgreesBetweenPlaneStrainAndThreeDimensions) {
  over_random_states(16, 20000, [](const Soil& soil, const Matrix3d& stress, const Matrix3d& strain, bool plane) {
    if (!plane) return;
    Matrix3d flat = strain;
    flat(2, 2) = 0;
    double plastic2 = 0, plastic3 = 0;
    const Matrix3d s2 = updated<4>(*soil.law(), stress, flat, &plastic2);
    const Matrix3d s3 = updated<6>(*soil.law(), stress, flat, &plastic3);
    ASSERT_LE((s2 - s3).norm(), 1e-10 * std::max(s2.norm(), scale));
    ASSERT_NEAR(plastic2, plastic3, 1e-10 * std::max(flat.norm(), scale / soil.young));
  });
}

TEST(MohrCoulomb, CountsTheLargestDifferenceOfPrincipalPlasticStrains) {
  over_random_states(17, 20000, [](const Soil& soil, const Matrix3d& stress, const Matrix3d& strain, bool) {
    double counted = 0;
    const Matrix3d s = updated<6>(*soil.law(), stress, strain, &counted);
    const Vector3d plastic = principal(strain - elastic_strain(soil, s - stress));
    ASSERT_NEAR(counted, plastic[0] - plastic[2], 1e-9 * (strain.norm() + scale / soil.young));
  });
}

TEST(MohrCoulomb, TreatsEveryPointOfABatchAlikeWhateverItsNeighbours) {
  Random random(18);
  for (int trial = 0; trial < 200; ++trial) {
    const Soil soil = random_soil(random);
    const auto law = soil.law();
    StressBatch<6> batch{};
    batch.count = 1 + static_cast<int>(random.uniform(0, 63.99));
    std::array<Matrix3d, 64> alone;
    for (int i = 0; i < batch.count; ++i) {
      const Matrix3d stress = admissible(soil, random, false);
      const Matrix3d strain = random_symmetric(random, 0.3 * scale / soil.young, false);
      set_point(batch, i, stress, strain);
      alone[static_cast<std::size_t>(i)] = updated<6>(*law, stress, strain);
    }
    law->update(batch);
    for (int i = 0; i < batch.count; ++i) ASSERT_EQ(stress_of(batch, i), alone[static_cast<std::size_t>(i)]);
  }
}

/// The step as a complementarity problem in principal space, by trying every set of active planes: all six
/// F_ij = k s_i − s_j − o ≤ 0 and the three s_i ≤ T. No order, no regions: nothing shared with the law.
std::optional<Vector3d> by_enumeration(const Soil& soil, const Vector3d& trial) {
  struct Plane {
    Vector3d normal, flow;
    double limit;
  };
  std::vector<Plane> planes;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (i == j) continue;
      Vector3d normal = Vector3d::Zero(), flow = Vector3d::Zero();
      normal[i] = soil.slope(), normal[j] = -1;
      flow[i] = soil.flow(), flow[j] = -1;
      planes.push_back({normal, flow, soil.offset()});
    }
    planes.push_back({Vector3d::Unit(i), Vector3d::Unit(i), soil.cut_off()});
  }
  const double tolerance = 1e-9 * scale;
  const auto inside = [&](const Vector3d& s) {
    for (const Plane& p : planes)
      if (p.normal.dot(s) - p.limit > tolerance * p.normal.norm()) return false;
    return true;
  };
  if (inside(trial)) return trial;
  const Matrix3d D = soil.stiffness();
  const unsigned sets = 1u << planes.size();
  for (unsigned set = 1; set < sets; ++set) {
    std::vector<int> active;
    for (unsigned p = 0; p < planes.size(); ++p)
      if (set >> p & 1u) active.push_back(static_cast<int>(p));
    const int n = static_cast<int>(active.size());
    if (n > 3) continue;
    Eigen::MatrixXd A(n, n);
    Eigen::VectorXd f(n);
    for (int a = 0; a < n; ++a) {
      const Plane& p = planes[static_cast<std::size_t>(active[static_cast<std::size_t>(a)])];
      f[a] = p.normal.dot(trial) - p.limit;
      for (int b = 0; b < n; ++b)
        A(a, b) = p.normal.dot(D * planes[static_cast<std::size_t>(active[static_cast<std::size_t>(b)])].flow);
    }
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(A);
    if (!lu.isInvertible()) continue;
    const Eigen::VectorXd multipliers = lu.solve(f);
    if (multipliers.minCoeff() < 0) continue;
    Vector3d s = trial;
    for (int a = 0; a < n; ++a)
      s -= multipliers[a] * (D * planes[static_cast<std::size_t>(active[static_cast<std::size_t>(a)])].flow);
    if (inside(s)) return s;
  }
  return std::nullopt;
}

TEST(MohrCoulomb, AgreesWithTheComplementarityProblemSolvedByEnumeration) {
  Random random(19);
  int apex = 0;
  for (int i = 0; i < 5000; ++i) {
    Soil soil = random_soil(random);
    soil.poisson = random.uniform(0, 0.45);
    Vector3d trial(scale * random.normal(), scale * random.normal(), scale * random.normal());
    if (random.chance(0.3)) trial += Vector3d::Constant(-2 * scale);
    const Matrix3d s = updated<6>(*soil.law(), trial.asDiagonal(), Matrix3d::Zero());
    ASSERT_LE((s - Matrix3d(s.diagonal().asDiagonal())).norm(), 1e-10 * scale);
    const std::optional<Vector3d> expected = by_enumeration(soil, trial);
    ASSERT_TRUE(expected.has_value());
    if (*expected == Vector3d::Constant(soil.cut_off())) ++apex;
    ASSERT_LE((s.diagonal() - *expected).norm(), 1e-8 * trial.norm())
        << i << ": trial " << trial.transpose() << ", law " << s.diagonal().transpose() << ", enumeration "
        << expected->transpose() << ", apex " << soil.apex() << ", cut-off " << soil.cut_off();
  }
  EXPECT_GT(apex, 0);
}

/// Forward integration of the rate equations: each substep is elastic, then pulled back along D m of the most violated
/// plane until none is violated. At the edges of the shear surface the pulls end in the right proportion; where shear
/// and tension act together they overshoot, so paths must stay away from the apex (the enumeration covers it).
Matrix3d by_cutting_planes(const Soil& soil, Matrix3d stress, const Matrix3d& strain, int substeps) {
  const Matrix3d D = soil.stiffness();
  const Matrix3d step = (soil.lambda() * strain.trace() * Matrix3d::Identity() + 2 * soil.shear() * strain) / substeps;
  for (int i = 0; i < substeps; ++i) {
    stress += step;
    for (int pull = 0; pull < 200; ++pull) {
      const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(stress);
      const Vector3d e = eigen.eigenvalues();
      const double shear = soil.slope() * e[2] - e[0] - soil.offset(), tension = e[2] - soil.cut_off();
      if (std::max(shear, tension) <= 1e-12 * scale) break;
      Vector3d normal(-1, 0, soil.slope()), flow(-1, 0, soil.flow());
      if (tension > shear / soil.slope()) normal = flow = Vector3d(0, 0, 1);
      const double f = tension > shear / soil.slope() ? tension : shear;
      const Vector3d back = e - f / normal.dot(D * flow) * (D * flow);
      stress = eigen.eigenvectors() * back.asDiagonal() * eigen.eigenvectors().transpose();
    }
  }
  return stress;
}

TEST(MohrCoulomb, ConvergesToTheIntegratedRateEquations) {
  Random random(20);
  for (int i = 0; i < 12; ++i) {
    Soil soil = random_soil(random);
    soil.friction = random.uniform(0.3, 0.7);
    soil.dilation = random.uniform(0.05, soil.friction);
    soil.cohesion = random.uniform(1e3, 20e3);
    soil.tension = std::numeric_limits<double>::quiet_NaN();
    const Matrix3d start = admissible(soil, random, false);
    Matrix3d strain = random_symmetric(random, 3 * scale / soil.young, false);
    strain -= strain.trace() / 3 * Matrix3d::Identity();  // dilation at constant volume presses away from the apex
    const Matrix3d slow = by_cutting_planes(soil, start, strain, 4000);
    const auto law = soil.law();
    const auto miss = [&](int steps) {
      Matrix3d s = start;
      for (int k = 0; k < steps; ++k) s = updated<6>(*law, s, strain / steps);
      return (s - slow).norm() / std::max(slow.norm(), scale);
    };
    EXPECT_LE(miss(4), 5e-2) << i;
    EXPECT_LE(miss(400), 1e-3) << i;
    EXPECT_LE(miss(1000), 3e-4) << i;
  }
}

TEST(MohrCoulomb, StopsDilatingAtTheScaledCriticalPorosity) {
  // n_ch = n₀ + (n_c − n₀) min(1, w_b/4h): 0.45 on fine grids, 0.425 where four cells are twice the band.
  const struct { double cell, end; } table[] = {{0.01, 0.45}, {0.025, 0.45}, {0.05, 0.425}};
  for (const auto& row : table) {
    const support::Given given = {
        {"young_modulus", 1e6}, {"friction_angle", degrees(35)}, {"dilatancy_angle", degrees(5)}};
    const auto law = make_law("mohr-coulomb", given, {row.cell, 0.4, 0.5});
    const auto dilation_at = [&](double porosity) {
      StressBatch<4> b{};
      b.count = 1;
      b.porosity[0] = porosity;
      const double K = 1e6 / (3 * (1 - 2 * 0.3));
      b.stress[0][0] = b.stress[1][0] = b.stress[2][0] = -1e5;
      b.strain[3][0] = 1;
      law->update(b);
      // tr Δε^p = −(Δp)/K as the imposed strain has no volume; tan ψ from it and γ_p.
      const double volume = -(b.stress[0][0] + b.stress[1][0] + b.stress[2][0] + 3e5) / 3 / K;
      const double sine = volume / b.state[0][0];
      return std::tan(std::asin(sine));
    };
    EXPECT_NEAR(dilation_at(0.38), std::tan(degrees(5)), 1e-9);
    EXPECT_NEAR(dilation_at(0.4), std::tan(degrees(5)), 1e-9);
    EXPECT_NEAR(dilation_at(0.5 * (0.4 + row.end)), 0.5 * std::tan(degrees(5)), 1e-9);
    EXPECT_NEAR(dilation_at(row.end), 0, 1e-9);
    EXPECT_NEAR(dilation_at(0.49), 0, 1e-9);
  }
}

TEST(MohrCoulomb, ComplainsAboutParametersThatContradictEachOther) {
  const LawDescription* law = find_soil_law("mohr-coulomb");
  const auto complaints = [&](const support::Given& given) {
    return law->check(support::values_of(*law, given), {0.05, 0.4, 0.5});
  };
  EXPECT_TRUE(complaints({{"friction_angle", 0.6}, {"dilatancy_angle", 0.1}}).empty());
  ASSERT_EQ(complaints({{"friction_angle", 0.1}, {"dilatancy_angle", 0.2}}).size(), 1u);
  EXPECT_EQ(complaints({{"friction_angle", 0.1}, {"dilatancy_angle", 0.2}})[0].key, "dilatancy_angle");
  ASSERT_EQ(complaints({{"friction_angle", 0.6}, {"critical_porosity", 0.5}}).size(), 1u);
  EXPECT_EQ(complaints({{"friction_angle", 0.6}, {"critical_porosity", 0.5}})[0].key, "critical_porosity");
}

}  // namespace
}  // namespace polder
