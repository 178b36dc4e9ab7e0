// Single-element tests whose answers are closed forms (REFERENCES: drained and undrained triaxial test, Rankine).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "polder/material/element.hpp"
#include "support.hpp"

namespace polder {
namespace {

using support::degrees;
using support::make_law;

TEST(DrainedTriaxial, YieldsAndFailsWhereMohrCoulombSays) {
  const double sine = std::sin(degrees(7));
  const auto law = make_law("mohr-coulomb", {{"young_modulus", 55.86e6},
                                             {"poisson_ratio", 0.33},
                                             {"friction_angle", degrees(37)},
                                             {"dilatancy_angle", degrees(7)},
                                             {"dilatancy", 1}});
  ElementPath path{.test = ElementTest::triaxial_drained, .vertical_stress = 100e3, .strain = 0.02, .steps = 20000};
  const ElementResult result = run_element_test(*law, path, 0.4, 1);
  ASSERT_TRUE(result.stopped.empty()) << result.stopped;
  const auto& rows = result.rows;
  double yield_strain = 0;
  for (std::size_t i = 1; i < rows.size() && yield_strain == 0; ++i)
    if (rows[i].plastic_shear_strain > 0) yield_strain = rows[i].axial_strain;
  EXPECT_NEAR(yield_strain, 0.5411e-2, 0.001 * 0.5411e-2);
  EXPECT_NEAR(rows.back().deviator, 302.28e3, 0.001 * 302.28e3);
  EXPECT_NEAR(rows.back().lateral, 100e3, 1e-6 * 100e3);
  const ElementRow &a = rows[rows.size() - 1000], &b = rows.back();
  const double slope = (b.volumetric_strain - a.volumetric_strain) / (b.axial_strain - a.axial_strain);
  EXPECT_NEAR(slope, -2 * sine / (1 - sine), 0.001 * 2 * sine / (1 - sine));
}

TEST(DrainedTriaxial, EndsDilatingAtTheCriticalPorosity) {
  const auto law = make_law("mohr-coulomb", {{"young_modulus", 20e6},
                                             {"friction_angle", degrees(35)},
                                             {"dilatancy_angle", degrees(10)},
                                             {"critical_porosity", 0.43}});
  ElementPath path{.test = ElementTest::triaxial_drained, .vertical_stress = 50e3, .strain = 2, .steps = 4000};
  const ElementResult result = run_element_test(*law, path, 0.40, 0.5);
  ASSERT_TRUE(result.stopped.empty()) << result.stopped;
  EXPECT_LT(result.rows.back().porosity, 0.43);
  EXPECT_NEAR(result.rows.back().porosity, 0.43, 1e-3);
}

TEST(UndrainedTriaxial, WithoutDilationKeepsTheMeanStress) {
  const auto law =
      make_law("mohr-coulomb", {{"young_modulus", 30e6}, {"poisson_ratio", 0.2}, {"friction_angle", degrees(30)}});
  ElementPath path{.test = ElementTest::triaxial_undrained, .vertical_stress = 100e3, .strain = 0.03, .steps = 3000};
  const ElementRow end = run_element_test(*law, path, 0.4, 1).rows.back();
  EXPECT_NEAR(end.deviator, 120e3, 0.001 * 120e3);
  EXPECT_NEAR(end.pore_pressure, 40e3, 0.001 * 40e3);
  EXPECT_NEAR(end.mean, 100e3, 1e-6 * 100e3);
}

TEST(Rankine, LateralStressUnderVerticalStressReachesKaAndKp) {
  // Plane strain: the vertical stress is held, the sample yields sideways.
  const struct {
    double angle, active, passive;
  } table[] = {{22, .45496, 2.19799}, {30, 1.0 / 3, 3}, {35, .27099, 3.69017}};
  for (const auto& row : table) {
    const auto law = make_law("mohr-coulomb", {{"young_modulus", 20e6}, {"friction_angle", degrees(row.angle)}});
    for (const double way : {1.0, -1.0}) {
      StressBatch<4> point{};
      point.count = 1;
      point.porosity[0] = 0.4;
      for (int k = 0; k < 3; ++k) point.stress[k][0] = -100e3;
      for (int step = 0; step < 20000; ++step) {
        // Vertical strain from the last miss of the held stress: a first-order servo, exact once the stress is steady.
        point.strain[0][0] = way * 1e-5;
        point.strain[1][0] = 0.2 * (-100e3 - point.stress[1][0]) / law->constrained_modulus(100e3);
        law->update(point);
      }
      const double coefficient = point.stress[0][0] / point.stress[1][0];
      const double expected = way > 0 ? row.active : row.passive;
      EXPECT_NEAR(coefficient, expected, 0.001 * expected) << row.angle;
    }
  }
}

TEST(Oedometer, OfAnElasticSampleHasTheConstrainedModulus) {
  const auto law = make_law("linear-elastic", {{"young_modulus", 10e6}, {"poisson_ratio", 0.25}});
  ElementPath path{.test = ElementTest::oedometer, .vertical_stress = 10e3, .loads = {110e3, 60e3}, .steps = 10};
  const ElementResult result = run_element_test(*law, path, 0.4, 1);
  ASSERT_EQ(result.rows.size(), 21u);
  EXPECT_NEAR(result.rows[10].axial_strain, 100e3 / 12e6, 1e-9);
  EXPECT_NEAR(result.rows[20].axial_strain, 50e3 / 12e6, 1e-9);
  EXPECT_NEAR(result.rows[20].lateral - 10e3, 50e3 / 3, 1e-3);
}

TEST(SimpleShear, OfSandReachesTheStressRatioOfCoaxialFlow) {
  // At constant vertical stress and steady state there is no normal strain, so the principal axes of stress and strain
  // rate coincide at ψ = 0: τ/σ'_v = sin φ.
  const auto law = make_law("mohr-coulomb", {{"young_modulus", 20e6}, {"friction_angle", degrees(30)}});
  ElementPath path{.test = ElementTest::simple_shear, .vertical_stress = 100e3, .strain = 0.3, .steps = 6000};
  const ElementResult result = run_element_test(*law, path, 0.4, 1);
  ASSERT_TRUE(result.stopped.empty()) << result.stopped;
  EXPECT_NEAR(result.rows.back().shear / 100e3, 0.5, 0.001 * 0.5);
}

}  // namespace
}  // namespace polder
