#include "polder/stability/reliability.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "polder/stability/search.hpp"
#include "reference_slopes.hpp"

namespace polder::stability {
namespace {

double sigma_of(double variation) { return std::sqrt(std::log(1 + variation * variation)); }

// F = (c1 c2) / 50 in kPa², for which first-order reliability is exact: ln F is normal.
Section two_soils() {
  Section section;
  section.soils = {testing::drained(10, 0, 18), testing::drained(8, 0, 18)};
  return section;
}
double product(const Section& section) {
  return section.soils[0].above.cohesion * section.soils[1].above.cohesion / 50e6;
}
const std::vector<Uncertainty> both = {{"one", 0, 0.2}, {"two", 1, 0.3}};

double exact_index() {
  const double s1 = sigma_of(0.2), s2 = sigma_of(0.3), total = s1 * s1 + s2 * s2;
  return (std::log(80.0 / 50) - total / 2) / std::sqrt(total);
}

TEST(Form, IsExactForAProductOfLognormalStrengths) {
  const Reliability result = form(two_soils(), both, product);
  EXPECT_TRUE(result.converged);
  EXPECT_NEAR(result.index, exact_index(), 2e-3);
  EXPECT_NEAR(result.probability, normal_probability(-exact_index()), 1e-3);
  const double s1 = sigma_of(0.2), s2 = sigma_of(0.3);
  EXPECT_NEAR(result.influence[0], s1 * s1 / (s1 * s1 + s2 * s2), 0.01);
}

TEST(MonteCarlo, AgreesWithTheExactProbability) {
  const Reliability result = monte_carlo(two_soils(), both, product, 20000);
  EXPECT_NEAR(result.probability, normal_probability(-exact_index()), 3 * result.deviation);
  EXPECT_EQ(result.probability, monte_carlo(two_soils(), both, product, 20000).probability);
}

TEST(Form, MeanThatFailsHasANegativeIndex) {
  Section weak = two_soils();
  weak.soils[0].above.cohesion *= 0.4;
  EXPECT_LT(form(weak, both, product).index, 0);
}

TEST(CharacteristicValue, FivePerCentLieBelowIt) {
  // A D-Stability model states mean 0.30, deviation 0.05 and computes with 0.225386 in its design calculation.
  EXPECT_NEAR(characteristic_value(0.30, 0.05 / 0.30), 0.22538642811925502, 1e-8);
  EXPECT_EQ(characteristic_value(5, 0), 5);
}

TEST(DesignSection, DividesBishopsFactorByTheCommonPartialFactor) {
  // With one factor on c' and tan φ', F of the design section is F over that factor, on any surface.
  const Section section = testing::acads_1a();
  PartialFactors factors;
  factors.cohesion = factors.tan_friction = 1.25;
  const auto factor = [](const Section& s) {
    const PreparedSection prepared = prepare(s);
    const Circle circle{{32, 48}, 23.2};
    return bishop(cut_slices(prepared, circle_surface(prepared, circle)), circle).factor;
  };
  EXPECT_GT(factor(section), 0.5);
  EXPECT_NEAR(factor(design_section(section, factors)), factor(section) / 1.25, 1e-6);
}

TEST(Form, SlopeWithScatterAgreesWithMonteCarlo) {
  const Section section = testing::griffiths_lane_1();
  const std::vector<Uncertainty> strength = {{"soil", 0, 0.2}};
  const auto factor = [](const Section& s) {
    const PreparedSection prepared = prepare(s);
    const Circle circle{{17, 20}, 19.8};
    return bishop(cut_slices(prepared, circle_surface(prepared, circle)), circle).factor;
  };
  const Reliability first = form(section, strength, factor);
  const Reliability sampled = monte_carlo(section, strength, factor, 2000);
  EXPECT_TRUE(first.converged);
  EXPECT_NEAR(first.probability, sampled.probability, 3 * sampled.deviation + 1e-3);
}

}  // namespace
}  // namespace polder::stability
