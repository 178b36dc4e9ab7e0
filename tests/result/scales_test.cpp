// Colour maps and ticks: the scales of every figure.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "polder/result/colour.hpp"
#include "polder/result/ticks.hpp"

using namespace polder;

namespace {
double lightness(ColourMap map, double t) { return to_oklab(colour_at(map, t)).lightness; }
}  // namespace

TEST(ColourMap, LightnessIsLinearFromEndToEnd) {
  for (const ColourMap map : {ColourMap::field, ColourMap::strain, ColourMap::water}) {
    const double first = lightness(map, 0), last = lightness(map, 1);
    EXPECT_GT(std::abs(last - first), 0.5);
    for (double t = 0; t <= 1; t += 1.0 / 256) EXPECT_NEAR(lightness(map, t), first + t * (last - first), 0.02) << t;
  }
}

TEST(ColourMap, LightnessIsStrictlyMonotone) {
  for (const ColourMap map : {ColourMap::field, ColourMap::strain, ColourMap::water}) {
    const double sign = lightness(map, 1) > lightness(map, 0) ? 1 : -1;
    for (int i = 0; i < 100; ++i)
      EXPECT_GT(sign * (lightness(map, (i + 1) / 100.0) - lightness(map, i / 100.0)), 0) << i;
  }
}

TEST(ColourMap, OfSignsIsLightestInTheMiddleAndAsDarkAtBothEnds) {
  for (int i = 0; i < 50; ++i) {
    EXPECT_LT(lightness(ColourMap::signs, i / 100.0), lightness(ColourMap::signs, (i + 1) / 100.0));
    EXPECT_LT(lightness(ColourMap::signs, 1 - i / 100.0), lightness(ColourMap::signs, 1 - (i + 1) / 100.0));
  }
  EXPECT_NEAR(lightness(ColourMap::signs, 0), lightness(ColourMap::signs, 1), 0.02);
}

TEST(ColourMap, OklabAndBackIsTheIdentity) {
  for (std::uint32_t hex : {0x000000u, 0xffffffu, 0x123456u, 0xfe8001u}) {
    const Colour there = rgb(hex), back = from_oklab(to_oklab(there));
    EXPECT_NEAR(back.red, there.red, 1e-6);
    EXPECT_NEAR(back.green, there.green, 1e-6);
    EXPECT_NEAR(back.blue, there.blue, 1e-6);
  }
}

TEST(Ticks, AreRoundAndWrittenWithoutNeedlessDigits) {
  using Labels = std::vector<std::string>;
  EXPECT_EQ(nice_ticks({0, 1}, 5).labels, (Labels{"0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
  EXPECT_EQ(nice_ticks({-3.2, 7.9}, 5).labels, (Labels{"−2", "0", "2", "4", "6"}));
  EXPECT_EQ(nice_ticks({0.3881, 0.4523}, 3).labels, (Labels{"0.40", "0.42", "0.44"}));
  EXPECT_EQ(nice_ticks({0, 8000}, 4).labels, (Labels{"0", "2000", "4000", "6000", "8000"}));
  EXPECT_EQ(nice_ticks({0, 2.1e6}, 2).labels, (Labels{"0", "10⁶", "2·10⁶"}));
  EXPECT_EQ(nice_ticks({5, 5}, 2).labels, (Labels{"4.5", "5.0", "5.5"}));
}

TEST(Ticks, OfAnyRangeLieInItAndAreEvenlySpaced) {
  const unsigned seed = 20261124;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> exponent(-12, 12), share(-1, 1);
  for (int i = 0; i < 2000; ++i) {
    const double size = std::pow(10, exponent(random)), low = size * share(random);
    const Range range{low, low + size * (0.01 + std::abs(share(random)))};
    const Ticks ticks = nice_ticks(range, 5);
    ASSERT_GE(ticks.at.size(), 2u) << "seed " << seed << ", range " << range.low << " to " << range.high;
    ASSERT_LE(ticks.at.size(), 10u);
    const double slack = 2e-3 * ticks.step;
    for (std::size_t k = 0; k < ticks.at.size(); ++k) {
      EXPECT_GE(ticks.at[k], range.low - slack);
      EXPECT_LE(ticks.at[k], range.high + slack);
      if (k > 0) {
        EXPECT_NEAR(ticks.at[k] - ticks.at[k - 1], ticks.step, 1e-6 * ticks.step);
      }
    }
    const Range round = nice_range(range, 5);
    EXPECT_LE(round.low, range.low + slack);
    EXPECT_GE(round.high, range.high - slack);
  }
}

TEST(Numbers, AreWrittenForReaders) {
  EXPECT_EQ(number_text(0.25), "0.25");
  EXPECT_EQ(number_text(-12.345), "−12.3");
  EXPECT_EQ(number_text(100), "100");
  EXPECT_EQ(number_text(3.2e-7), "3.2·10⁻⁷");
  EXPECT_EQ(number_text(1e9), "10⁹");
  EXPECT_EQ(number_text(std::nan("")), "–");
  EXPECT_EQ(time_text(4), "4.00 s");
  EXPECT_EQ(time_text(90), "90.0 s");
  EXPECT_EQ(time_text(600), "10.0 min");
  EXPECT_EQ(time_text(86400), "24.0 h");
  EXPECT_EQ(display_unit("Pa", 8000).name, "kPa");
  EXPECT_EQ(display_unit("m", 0.004).name, "mm");
}
