#include "polder/stability/piping.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace polder::stability {
namespace {

PipingInput ijkdijk() {
  PipingInput input;
  input.seepage_length = 15;
  input.aquifer_thickness = 3;
  input.conductivity = 8e-5;
  input.d70 = 180e-6;
  return input;
}

TEST(Sellmeijer, FactorsAreThoseOfThePublishedFormula) {
  const PipingResult result = sellmeijer(ijkdijk());
  // By hand: 0.25 · 16.5/9.81 · tan 37° = 0.42049 · 0.75355; κ = 1.33e-6 · 8e-5/9.81 = 1.08461e-11;
  // ∛(κ · 15) = 5.45918e-4; (180/208)^0.4 = 0.943813; 0.2^2.8 = 0.0110377, exponent −0.243125.
  EXPECT_NEAR(result.resistance, 0.316861, 1e-5);
  EXPECT_NEAR(result.scale, 0.359602, 1e-5);
  EXPECT_NEAR(result.geometry, 0.91 * std::pow(0.2, -0.243125), 1e-5);
  EXPECT_NEAR(result.critical_head, 15 * 0.316861 * 0.359602 * 0.91 * std::pow(0.2, -0.243125), 1e-4);
  EXPECT_TRUE(result.outside.empty());
}

TEST(Sellmeijer, IsSmoothWhereTheAquiferIsAsThickAsThePathIsLong) {
  PipingInput input = ijkdijk();
  input.aquifer_thickness = input.seepage_length;
  EXPECT_NEAR(sellmeijer(input).geometry, 0.91 * std::exp(0.1), 1e-12);
  input.aquifer_thickness *= 1 + 1e-5;
  EXPECT_NEAR(sellmeijer(input).geometry, 0.91 * std::exp(0.1), 1e-5);
}

TEST(Sellmeijer, ScalesWithTheRootsOfTheFormula) {
  const PipingInput one = ijkdijk();
  PipingInput other = one;
  other.conductivity *= 8;
  EXPECT_NEAR(sellmeijer(other).critical_head / sellmeijer(one).critical_head, 0.5, 1e-12);
  other = one;
  other.d70 *= 2;
  EXPECT_NEAR(sellmeijer(other).critical_head / sellmeijer(one).critical_head, std::pow(2, 0.4), 1e-12);
  other = one;
  other.relative_density *= 0.8;
  EXPECT_NEAR(sellmeijer(other).critical_head / sellmeijer(one).critical_head, std::pow(0.8, 0.35), 1e-12);
}

TEST(Sellmeijer, SandOutsideTheTestsIsNamed) {
  PipingInput coarse = ijkdijk();
  coarse.d70 = 900e-6;
  ASSERT_EQ(sellmeijer(coarse).outside.size(), 1u);
  EXPECT_NE(sellmeijer(coarse).outside[0].find("d70 900"), std::string::npos);
}

TEST(Piping, BlanketTakesThreeTenthsOfItsThickness) {
  const PipingResult result = sellmeijer(ijkdijk());
  EXPECT_NEAR(piping_factor(result, 2.0, 1.5), result.critical_head / 1.55, 1e-12);
  EXPECT_TRUE(std::isinf(piping_factor(result, 0.4, 1.5)));
}

TEST(Uplift, LeveeOnItsBareClayHasThePublishedRatios) {
  // P4, clay 3.6 m of 20.4 kN/m³ at x = 35 m of 50: base pressure linear from p(0) to 82 kPa, sand base 5.96 m deep.
  for (const auto& [pressure, factor] : {std::pair{102e3, 1.132}, std::pair{122e3, 1.036}, std::pair{142e3, 0.956}}) {
    const double head = (pressure + (82e3 - pressure) * 0.7) / 9810 - 5.96;
    EXPECT_NEAR(uplift_factor({3.6, 20.4e3, head, 0, 0, 9810}), factor, 2e-3) << pressure;
  }
}

TEST(Uplift, FactorIsOneAtTheCriticalDifference) {
  ExitPoint exit{4, 17e3, 0, 1.5, 0, 9810};
  exit.aquifer_head = exit.exit_head + critical_uplift_difference(exit);
  EXPECT_NEAR(uplift_factor(exit), 1, 1e-12);
}

TEST(Heave, SandBoilsAtTerzaghisGradient) {
  EXPECT_NEAR(critical_gradient(0.4, 2.65), 0.99, 1e-12);
  EXPECT_NEAR(heave_factor({2, 17e3, 3.3, 3, 0, 9810}, 0.3), 2.0, 1e-12);
}

}  // namespace
}  // namespace polder::stability
