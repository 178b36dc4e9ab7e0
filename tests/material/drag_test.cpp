// Drag laws against the seepage column, the onset of fluidisation and the fall of a single grain (REFERENCES A7, A8).
#include "polder/material/drag.hpp"

#include <gtest/gtest.h>

#include "support.hpp"

namespace polder {
namespace {

constexpr double g = 9.81, rho = 1000;

Drag drag_of(DragLaw law, double diameter, double viscosity) {
  DragInput in;
  in.law = law;
  in.grain_diameter = diameter;
  in.viscosity = viscosity;
  return make_drag(in);
}

/// q at which the rising c(n, q) q meets `load`.
double discharge(const Drag& drag, double n, double load) {
  double low = 0, high = 10;
  for (int i = 0; i < 200; ++i) {
    const double q = 0.5 * (low + high);
    (drag_coefficient(drag, n, q) * q < load ? low : high) = q;
  }
  return low;
}

constexpr DragLaw all_laws[] = {DragLaw::ergun, DragLaw::darcy, DragLaw::beetstra, DragLaw::gidaspow};

TEST(ErgunDrag, GivesTheDischargeOfTheSeepageColumn) {
  const struct {
    double diameter, viscosity, gradient, q;
  } table[] = {{2e-3, 8.905e-4, .1, 4.3834e-3}, {2e-3, 8.905e-4, .5, 1.5551e-2}, {2e-3, 8.905e-4, 1, 2.4978e-2},
               {.2e-3, 1e-3, .1, 4.6498e-5},    {.2e-3, 1e-3, .5, 2.3232e-4},    {.2e-3, 1e-3, 1, 4.6423e-4}};
  for (const auto& row : table) {
    const Drag drag = drag_of(DragLaw::ergun, row.diameter, row.viscosity);
    EXPECT_NEAR(discharge(drag, 0.40, rho * g * row.gradient), row.q, 1e-4 * row.q)
        << row.diameter << " " << row.gradient;
  }
}

TEST(Permeability, FollowsTheVoidRatioByDecadesWithACk) {
  for (const DragLaw law : all_laws) {
    DragInput in;
    in.law = law;
    in.grain_diameter = 2e-3;
    in.conductivity = 1e-3;
    in.initial_porosity = 0.4;
    in.c_k = 0.875;
    const Drag drag = make_drag(in);
    EXPECT_NEAR(hydraulic_conductivity(drag, 0.4, 9.81), 1e-3, 1e-12);
    const double e = 0.4 / 0.6 + 0.875;  // a decade
    EXPECT_NEAR(hydraulic_conductivity(drag, e / (1 + e), 9.81), 1e-2, 1e-11);
  }
}

TEST(ErgunDrag, RelaxesTheWaterInTheTimeOfPermeabilityOverPorosityAndGravity) {
  const Drag drag = drag_of(DragLaw::ergun, 2e-3, 8.905e-4);
  // nρ dv/dt = −β v with β = n²c.
  EXPECT_NEAR(0.4 * rho / (0.4 * 0.4 * drag_coefficient(drag, 0.4, 0)), 13.3e-3, 0.05e-3);
}

TEST(ErgunDrag, LiftsTheBedAtTheMinimumFluidisationVelocity) {
  const struct {
    double diameter, n, grain_density, viscosity, q;
  } table[] = {{.9e-3, .34, 2660, 8.905e-4, 5.366e-3},
               {2e-3, .40, 2700, 8.905e-4, 2.5305e-2},
               {.2e-3, .40, 2680, 1e-3, 4.68e-4}};
  for (const auto& row : table) {
    const double weight = (1 - row.n) * (row.grain_density - rho) * g;
    EXPECT_NEAR(discharge(drag_of(DragLaw::ergun, row.diameter, row.viscosity), row.n, weight), row.q, 3e-4 * row.q);
  }
}

/// Speed at which one grain falls: φ(ρs − ρw)g = β v.
double terminal_velocity(const Drag& drag, double grain_density) {
  const double n = 1 - 1e-9;
  return discharge(drag, n, (1 - n) * (grain_density - rho) * g);
}

TEST(GidaspowDrag, LetsASingleGrainFallAtItsTerminalVelocity) {
  const struct {
    double diameter, grain_density, viscosity, v;
  } table[] = {{.9e-3, 2660, 8.9e-4, .1460}, {2e-3, 2700, 8.905e-4, .2963}, {.2e-3, 2680, 1e-3, .02517}};
  for (const auto& row : table)
    EXPECT_NEAR(terminal_velocity(drag_of(DragLaw::gidaspow, row.diameter, row.viscosity), row.grain_density), row.v,
                1e-3 * row.v);
}

TEST(DiluteDragLaws, TendToStokes) {
  const double diameter = 20e-6, mu = 1e-3;
  const double stokes = 1650 * g * diameter * diameter / (18 * mu);
  for (const DragLaw law : {DragLaw::gidaspow, DragLaw::beetstra})
    EXPECT_NEAR(terminal_velocity(drag_of(law, diameter, mu), 2650), stokes, 0.01 * stokes);
}

TEST(GidaspowDrag, IsErgunInPackedSoilAndContinuous) {
  const Drag ergun = drag_of(DragLaw::ergun, 1e-3, 1e-3), both = drag_of(DragLaw::gidaspow, 1e-3, 1e-3);
  EXPECT_DOUBLE_EQ(drag_coefficient(both, 0.5, 0.02), drag_coefficient(ergun, 0.5, 0.02));
  for (double n = 0.70; n < 0.90; n += 1e-4) {
    const double a = drag_coefficient(both, n, 0.02), b = drag_coefficient(both, n + 1e-4, 0.02);
    EXPECT_NEAR(a, b, 5e-3 * a) << n;
  }
}

TEST(BeetstraDrag, IsItsPublishedFormula) {
  // φ 0.4, Re 10: F = 10φ/n² + n²(1 + 1.5√φ) + 0.413 Re/(24 n²)·[1/n + 3nφ + 8.4 Re^−.343]/[1 + 10^{3φ} Re^{−(1+4φ)/2}]
  // = 11.1111 + 0.70152 + 0.47801·[1.66667 + 0.72 + 3.81339]/[1 + 15.8489·0.0501187] = 13.4643 and β = 18 n φ μ F/D².
  const double n = 0.6, diameter = 1e-3, mu = 1e-3;
  const double beta = n * n * drag_coefficient(drag_of(DragLaw::beetstra, diameter, mu), n, 10 * mu / (rho * diameter));
  EXPECT_NEAR(beta, 18 * n * 0.4 * mu * 13.4643 / (diameter * diameter), 1e-4 * beta);
}

TEST(DragLaws, KeepAGivenConductivityAndScaleItByKozenyCarman) {
  for (const DragLaw law : all_laws) {
    for (const double diameter : {0.0, 0.9e-3}) {
      DragInput in;
      in.law = law;
      in.grain_diameter = diameter;
      in.conductivity = 4.3e-4;
      in.initial_porosity = 0.34;
      const Drag drag = make_drag(in);
      EXPECT_NEAR(hydraulic_conductivity(drag, 0.34, g), 4.3e-4, 1e-12);
      if (law == DragLaw::beetstra) continue;  // its suspended term does not follow Kozeny–Carman
      const double ratio = std::pow(0.45 / 0.34, 3) * std::pow(0.66 / 0.55, 2);
      EXPECT_NEAR(hydraulic_conductivity(drag, 0.45, g), 4.3e-4 * ratio, 1e-12);
    }
  }
}

TEST(DragLaws, SplitIntoTheResistancesThatTheStepGathers) {
  support::Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const double n = random.uniform(0.2, 0.9), q = random.uniform(0, 0.5), diameter = random.uniform(1e-4, 1e-2);
    const Drag drag = drag_of(DragLaw::ergun, diameter, 1e-3);
    const double kappa = intrinsic_permeability(drag, n);
    EXPECT_NEAR(kappa, diameter * diameter * n * n * n / (150 * (1 - n) * (1 - n)), 1e-12 * kappa);
    EXPECT_NEAR(quadratic_resistance(drag, n), rho * 1.75 / std::sqrt(150 * n * n * n * kappa),
                1e-12 * quadratic_resistance(drag, n));
    const double sum = linear_resistance(drag, n) + quadratic_resistance(drag, n) * q;
    EXPECT_NEAR(drag_coefficient(drag, n, q), sum, 1e-12 * sum);
  }
}

TEST(DragLaws, DissipateAndGrowWithTheFlow) {
  support::Random random(4);
  for (int i = 0; i < 20000; ++i) {
    const DragLaw law = all_laws[i % 4];
    const Drag drag = drag_of(law, std::pow(10, random.uniform(-5, -1.5)), std::pow(10, random.uniform(-4, -2)));
    const double n = random.uniform(0.2, 0.999), q = std::pow(10, random.uniform(-9, 0.5));
    const double still = drag_coefficient(drag, n, 0);
    ASSERT_GT(still, 0);
    ASSERT_TRUE(std::isfinite(still));
    const double slow = drag_coefficient(drag, n, q) * q, fast = drag_coefficient(drag, n, 1.01 * q) * 1.01 * q;
    ASSERT_GT(slow, 0);
    ASSERT_GT(fast, slow) << static_cast<int>(law) << " n " << n << " q " << q;
  }
}

TEST(DragLaws, NeedADiameterOrAConductivity) { EXPECT_THROW(make_drag(DragInput{}), std::invalid_argument); }

TEST(MixtureViscosity, IsThatOfWaterWithoutGrains) {
  EXPECT_DOUBLE_EQ(mixture_viscosity_beenakker(1e-3, 0), 1e-3);
  EXPECT_DOUBLE_EQ(mixture_viscosity_beenakker(1e-3, 0.3), 1e-3 * 2.218);
  EXPECT_DOUBLE_EQ(mixture_viscosity_einstein(1e-3, 0.3), 1e-3 * 1.75);
}

}  // namespace
}  // namespace polder
