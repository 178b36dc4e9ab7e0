#include "polder/material/retention.hpp"

#include <gtest/gtest.h>

namespace {

using namespace polder;

TEST(Retention, VanGenuchtenTakesTheDikePapersParameters) {
  // g_a 25 1/m, g_n 3, S_res .05: at s = P0 (4 cm of suction) Se = 2^(−2/3).
  const VanGenuchtenRetention r = van_genuchten(25, 3, 0.05, 1, 9810);
  EXPECT_NEAR(r.entry_pressure, 392.4, 1e-9);
  EXPECT_NEAR(saturation(r, 392.4), 0.05 + 0.95 * std::pow(2.0, -2.0 / 3.0), 1e-12);
  EXPECT_DOUBLE_EQ(saturation(r, -5.0), 1.0);
  // Mualem with l = 5: Se^5 [1 − (1 − Se^1.5)^(2/3)]² and Se^1.5 = 1/2.
  const double se = std::pow(2.0, -2.0 / 3.0);
  EXPECT_NEAR(relative_conductivity(MualemConductivity{5, r.lambda}, Retention{r}, 392.4),
              std::pow(se, 5) * std::pow(1 - std::pow(0.5, 2.0 / 3.0), 2), 1e-12);
}

TEST(Retention, CapacityIsTheSlopeOfSaturation) {
  const std::vector<Retention> all{LinearRetention{6e-6, 0.1}, VanGenuchtenRetention{2e3, 0.6, 0.05, 1},
                                   GardnerRetention{1e-3, 0.15, 1}, TableRetention{{{0, 1000, 5000}, {1, 0.9, 0.2}}}};
  for (const auto& r : all)
    for (const double s : {-100.0, 50.0, 700.0, 2500.0, 4e5}) {
      const double d = 1e-3;
      EXPECT_NEAR(capacity(r, s), (saturation(r, s - d) - saturation(r, s + d)) / (2 * d), 1e-9)
          << r.index() << " " << s;
    }
}

TEST(Retention, ConductivityFallsFromOneAsSuctionRises) {
  const Retention r = VanGenuchtenRetention{2e3, 0.6, 0.05, 1};
  const std::vector<ConductivityCurve> all{MualemConductivity{0.5, 0.6}, HillelConductivity{3},
                                           GardnerConductivity{1e-3}, TableConductivity{{{0.05, 1}, {0, 1}}}};
  for (const auto& c : all) {
    double last = relative_conductivity(c, r, 0);
    EXPECT_DOUBLE_EQ(last, 1);
    for (double s = 10; s < 1e5; s *= 1.5) {
      const double now = relative_conductivity(c, r, s);
      EXPECT_LT(now, last) << c.index() << " " << s;
      EXPECT_GE(now, 0);
      last = now;
    }
  }
}

TEST(Retention, TheVoidRatioScalesConductivityByDecades) { EXPECT_NEAR(conductivity_factor(0.875, 0.875), 10, 1e-12); }

}  // namespace
