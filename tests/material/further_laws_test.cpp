// Tresca, Drucker–Prager, softening Mohr–Coulomb and Modified Cam Clay against their closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "polder/material/element.hpp"
#include "support.hpp"

namespace polder {
namespace {

using support::degrees;
using support::make_law;

ElementRow end_of(const SoilLaw& law, const ElementPath& path, double porosity = 0.4) {
  const ElementResult result = run_element_test(law, path, porosity, 1);
  EXPECT_TRUE(result.stopped.empty()) << result.stopped;
  return result.rows.back();
}

TEST(Tresca, HasItsUndrainedStrengthInCompressionExtensionAndShear) {
  const auto law =
      make_law("tresca", {{"young_modulus", 3e6}, {"poisson_ratio", 0.45}, {"undrained_shear_strength", 15e3}});
  const double tolerance = 1e-3 * 30e3;
  EXPECT_NEAR(end_of(*law, {.test = ElementTest::triaxial_drained, .strain = 0.05}).deviator, 30e3, tolerance);
  EXPECT_NEAR(end_of(*law, {.test = ElementTest::triaxial_drained, .strain = -0.05}).deviator, 30e3, tolerance);
  EXPECT_NEAR(end_of(*law, {.test = ElementTest::simple_shear, .strain = 0.05}).shear, 15e3, tolerance);
}

TEST(Tresca, IsTheSameForATotalStressOfAnyPressure) {
  const auto law = make_law("tresca", {{"young_modulus", 3e6}, {"undrained_shear_strength", 15e3}});
  const ElementPath low{.test = ElementTest::simple_shear, .vertical_stress = 0, .strain = 0.02};
  ElementPath high = low;
  high.vertical_stress = 1e6;
  EXPECT_NEAR(end_of(*law, low).shear, end_of(*law, high).shear, 1e-3);
}

TEST(DruckerPrager, MeetsMohrCoulombInTriaxialCompressionAndExtension) {
  const double sine = std::sin(degrees(30)), cosine = std::cos(degrees(30)), c = 5e3, cell = 100e3;
  const double k = (1 + sine) / (1 - sine);
  const support::Given base = {{"young_modulus", 20e6},
                               {"friction_angle", degrees(30)},
                               {"cohesion", c},
                               {"dilatancy_angle", degrees(5)},
                               {"dilatancy", 1}};
  support::Given given = base;
  given.push_back({"match", 1});
  const double compression = (k - 1) * cell + 2 * c * cosine / (1 - sine);
  EXPECT_NEAR(end_of(*make_law("drucker-prager", given), {.strain = 0.05}).deviator, compression, 1e-3 * compression);
  given.back().second = 2;
  const double extension = (1 - 1 / k) * cell + 2 * c * cosine / (1 + sine);
  EXPECT_NEAR(end_of(*make_law("drucker-prager", given), {.strain = -0.05}).deviator, extension, 1e-3 * extension);
}

TEST(DruckerPrager, MeetsMohrCoulombInPlaneStrainForAnyDilation) {
  for (const double psi : {0.0, 10.0, 30.0}) {
    const support::Given given = {{"young_modulus", 20e6},
                                  {"friction_angle", degrees(30)},
                                  {"cohesion", 5e3},
                                  {"dilatancy_angle", degrees(psi)},
                                  {"dilatancy", 1}};
    const ElementPath path{.test = ElementTest::simple_shear, .strain = 0.4, .steps = 4000};
    const double cone = end_of(*make_law("drucker-prager", given), path).shear;
    const double hexagon = end_of(*make_law("mohr-coulomb", given), path).shear;
    EXPECT_NEAR(cone, hexagon, 1e-3 * hexagon) << psi;
  }
}

TEST(DruckerPrager, ReturnsOnTheConeAndNeverCreatesEnergy) {
  support::Random random(41);
  const double sine = std::sin(degrees(30)), E = 1e7, nu = 0.3, c = 2e3;
  const double root = std::sqrt(3.0), slope = 6 * sine / (root * (3 - sine));
  const double offset = 6 * c * std::cos(degrees(30)) / (root * (3 - sine));
  const auto law = make_law("drucker-prager", {{"young_modulus", E},
                                               {"poisson_ratio", nu},
                                               {"cohesion", c},
                                               {"friction_angle", degrees(30)},
                                               {"dilatancy_angle", degrees(12)},
                                               {"match", 1},
                                               {"tension_strength", 1e3},
                                               {"dilatancy", 1}});
  for (int i = 0; i < 20000; ++i) {
    StressBatch<6> b{};
    b.count = 1;
    double trial[6];
    for (int k = 0; k < 6; ++k) b.stress[k][0] = trial[k] = 2e4 * random.normal() - (k < 3 ? 1e4 : 0);
    law->update(b);  // a trial stress reached from rest in one elastic step
    const auto s = [&](int k) { return b.stress[k][0]; };
    const double mean = (s(0) + s(1) + s(2)) / 3;
    double j2 = s(3) * s(3) + s(4) * s(4) + s(5) * s(5), work = 0;
    const double relaxed = trial[0] + trial[1] + trial[2] - 3 * mean;
    for (int k = 0; k < 6; ++k) {
      if (k < 3) j2 += 0.5 * (s(k) - mean) * (s(k) - mean);
      work += (k < 3 ? 1 : 2) * s(k) * ((1 + nu) * (trial[k] - s(k)) - (k < 3 ? nu * relaxed : 0)) / E;
    }
    ASSERT_LE(std::sqrt(j2) + slope * mean - offset, 1e-9 * 2e4) << i;
    ASSERT_LE(mean, 1e3 + 1e-9 * 2e4) << i;
    ASSERT_GE(work, -1e-9 * 2e4) << i;
  }
}

TEST(SofteningMohrCoulomb, GoesFromPeakToResidualStrength) {
  const auto law = make_law("softening-mohr-coulomb", {{"young_modulus", 20e6},
                                                       {"friction_angle", degrees(35)},
                                                       {"cohesion", 10e3},
                                                       {"residual_friction_angle", degrees(25)},
                                                       {"residual_cohesion", 1e3},
                                                       {"softening_slip", 0.02},
                                                       {"band_width", 0.1}});
  const ElementPath path{.strain = 0.4, .steps = 40000};
  const ElementResult result = run_element_test(*law, path, 0.4, 1);
  ASSERT_TRUE(result.stopped.empty()) << result.stopped;
  double peak = 0;
  for (const ElementRow& row : result.rows) peak = std::max(peak, row.deviator);
  const auto strength = [](double angle, double c) {
    const double k = (1 + std::sin(angle)) / (1 - std::sin(angle));
    return (k - 1) * 100e3 + 2 * c * std::sqrt(k);
  };
  EXPECT_NEAR(peak, strength(degrees(35), 10e3), 1e-3 * peak);
  EXPECT_NEAR(result.rows.back().deviator, strength(degrees(25), 1e3), 1e-3 * peak);
}

TEST(SofteningMohrCoulomb, SpendsTheSameEnergyPerAreaOfBandOnEveryGrid) {
  // Energy above the residual strength per area of a band of 4 cells, which shears at a constant vertical stress.
  const auto energy = [](double cell) {
    const auto law = make_law("softening-mohr-coulomb",
                              {{"young_modulus", 400e6},
                               {"friction_angle", degrees(35)},
                               {"residual_friction_angle", degrees(25)},
                               {"softening_slip", 0.05},
                               {"band_width", 0.01}},
                              {cell, 0.4, 0.5});
    const ElementPath path{
        .test = ElementTest::simple_shear, .stress_ratio = 0.6, .strain = 0.2 / (4 * cell), .steps = 20000};
    const ElementResult result = run_element_test(*law, path, 0.4, 1);
    double sum = 0;
    const double residual = result.rows.back().shear;
    for (std::size_t i = 1; i < result.rows.size(); ++i)
      sum += (result.rows[i].shear - residual) *
             (result.rows[i].plastic_shear_strain - result.rows[i - 1].plastic_shear_strain) * 4 * cell;
    return sum;
  };
  const double reference = energy(0.05);
  EXPECT_GT(reference, 0);
  EXPECT_NEAR(energy(0.025), reference, 0.01 * reference);
  EXPECT_NEAR(energy(0.0125), reference, 0.01 * reference);
}

constexpr double lambda = 0.2, kappa = 0.04;

std::unique_ptr<SoilLaw> clay(double preconsolidation, double attraction = 1) {
  return make_law("modified-cam-clay",
                  {{"compression_index", lambda},
                   {"swelling_index", kappa},
                   {"friction_angle", degrees(25)},
                   {"poisson_ratio", 0.25},
                   {"preconsolidation_pressure", preconsolidation},
                   {"attraction", attraction}},
                  {0, 0.55, 0.9});
}
double slope_m() { return 6 * std::sin(degrees(25)) / (3 - std::sin(degrees(25))); }

/// An isotropic compression by equal strains of all axes, to and fro.
TEST(ModifiedCamClay, FollowsTheVirginAndTheSwellingLine) {
  const auto law = clay(100e3);
  StressBatch<6> b{};
  b.count = 1;
  for (int k = 0; k < 3; ++k) b.stress[k][0] = -100e3;
  b.porosity[0] = 0.55;
  b.state[1][0] = 100e3;
  const auto strained = [&](double volume, int steps) {
    for (int i = 0; i < steps; ++i) {
      for (int k = 0; k < 3; ++k) b.strain[k][0] = volume / 3 / steps;
      b.porosity[0] = 1 - (1 - b.porosity[0]) * std::exp(-volume / steps);
      law->update(b);
    }
  };
  const double v0 = 1 / 0.45;
  strained(-0.10, 5000);
  const double p1 = -b.stress[0][0], v1 = 1 / (1 - b.porosity[0]);
  EXPECT_NEAR(v0 - v1, lambda * std::log((p1 + 1) / (100e3 + 1)), 1e-3 * (v0 - v1));
  strained(0.01, 1000);
  const double p2 = -b.stress[0][0], v2 = 1 / (1 - b.porosity[0]);
  EXPECT_NEAR(v2 - v1, kappa * std::log((p1 + 1) / (p2 + 1)), 1e-3 * (v2 - v1));
}

TEST(ModifiedCamClay, FailsUndrainedAtTheStrengthOfTheCriticalState) {
  // q_f = M p₀ (R/2)^Λ, Λ = 1 − κ/λ, u_f = p₀ + q_f/3 − q_f/M.
  for (const double ratio : {1.0, 2.0, 4.0, 8.0}) {
    const auto law = clay(ratio * 100e3);
    const ElementPath path{.test = ElementTest::triaxial_undrained, .strain = 0.4, .steps = 8000};
    const ElementRow end = end_of(*law, path, 0.55);
    const double q = slope_m() * 100e3 * std::pow(ratio / 2, 1 - kappa / lambda);
    EXPECT_NEAR(end.deviator, q, 2e-3 * q) << ratio;
    EXPECT_NEAR(end.pore_pressure, 100e3 + q / 3 - q / slope_m(), 2e-3 * q) << ratio;
  }
}

TEST(ModifiedCamClay, EndsDrainedShearAtTheCriticalState) {
  const ElementPath path{.strain = 1.2, .steps = 12000};
  const ElementResult result = run_element_test(*clay(100e3), path, 0.55, 0.9);
  ASSERT_TRUE(result.stopped.empty()) << result.stopped;
  const ElementRow &end = result.rows.back(), &before = result.rows[result.rows.size() - 100];
  const double p = 3 * 100e3 / (3 - slope_m());
  EXPECT_NEAR(end.mean, p, 2e-3 * p);
  EXPECT_NEAR(end.deviator, slope_m() * p, 2e-3 * slope_m() * p);
  EXPECT_NEAR(end.volumetric_strain, before.volumetric_strain, 1e-3 * (end.axial_strain - before.axial_strain) * 10);
}

TEST(ModifiedCamClay, ObeysItsFlowRuleAndHardeningOverRandomSteps) {
  support::Random random(42);
  const double M = slope_m(), a = 100, nu = 0.25;
  int wet = 0, dry = 0;
  for (int i = 0; i < 20000; ++i) {
    const double pc = std::pow(10, random.uniform(4, 6));
    const auto law = clay(pc, a);
    StressBatch<6> b{};
    b.count = 1;
    b.porosity[0] = 0.5;
    b.state[1][0] = pc;
    const double p0 = pc * std::pow(10, random.uniform(-2, 0));
    double trial[6], strain[6];
    for (int k = 0; k < 6; ++k) {
      b.stress[k][0] = k < 3 ? -p0 : 0;
      b.strain[k][0] = strain[k] = 1e-2 * random.normal();
    }
    law->update(b);
    const double compression = -(strain[0] + strain[1] + strain[2]), v = 2;
    const double G = v * (p0 + a) / kappa * 1.5 * (1 - 2 * nu) / (1 + nu);
    double q2 = 0, q2_trial = 0;
    const double p = -(b.stress[0][0] + b.stress[1][0] + b.stress[2][0]) / 3;
    for (int k = 0; k < 6; ++k) {
      trial[k] = 2 * G * (strain[k] + (k < 3 ? compression / 3 : 0));
      q2_trial += (k < 3 ? 1.5 : 3.0) * trial[k] * trial[k];
      const double s = b.stress[k][0] + (k < 3 ? p : 0);
      q2 += (k < 3 ? 1.5 : 3.0) * s * s;
    }
    const double q = std::sqrt(q2), P = p + a, Pc = b.state[1][0] + a;
    ASSERT_GT(P, 0);
    ASSERT_LE(q2 / (M * M) + P * (P - Pc), 1e-9 * Pc * Pc) << i;
    const double plastic_volume = compression - kappa / v * std::log(P / (p0 + a));
    ASSERT_NEAR(Pc, (pc + a) * std::exp(v * plastic_volume / (lambda - kappa)), 1e-9 * Pc) << i;
    const double plastic_shear = (std::sqrt(q2_trial) - q) / (3 * G);
    ASSERT_NEAR(plastic_volume * 2 * q / (M * M), plastic_shear * (2 * P - Pc), 1e-9 * Pc) << i;
    ASSERT_GE(plastic_shear, -1e-12) << i;
    if (b.state[0][0] > 0) ++(2 * P > Pc ? wet : dry);
  }
  EXPECT_GT(wet, 1000);
  EXPECT_GT(dry, 1000);
}

}  // namespace
}  // namespace polder
