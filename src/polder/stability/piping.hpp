#pragma once
// The chain of checks on a dike on sand under a blanket of clay: water lifts the blanket (uplift), flows up through the
// crack and carries sand (heave), and erodes a pipe backwards under the dike (piping). A dike fails by piping only
// where all three go wrong.
#include <string>
#include <vector>

namespace polder::stability {

/// The landside exit point: a blanket on an aquifer. SI units, heads above one datum.
struct ExitPoint {
  double blanket_thickness = 0;  ///< m, d
  double blanket_weight = 0;     ///< N/m³, saturated
  double aquifer_head = 0;       ///< m, in the sand under the blanket
  double exit_head = 0;          ///< m, ground or ditch level at the exit
  double free_water = 0;         ///< m, water standing on the blanket
  double water_weight = 9810;    ///< N/m³
};

/// Uplift: weight of the blanket and of the water on it over the pressure under it, from `blanket base` = exit level −
/// free water − thickness. At least 1: it stays down.
double uplift_factor(const ExitPoint& exit);

/// Head difference over the blanket at which it floats, m: d (γ_sat − γw)/γw.
double critical_uplift_difference(const ExitPoint& exit);

/// Heave: critical gradient over the gradient (aquifer_head − exit_head)/d. Without a measured `critical_gradient` the
/// Dutch rule of 0.3 (no screen) is usual; (1 − n)(G_s − 1), Terzaghi's, holds for a bed of sand.
double heave_factor(const ExitPoint& exit, double critical_gradient);
double critical_gradient(double porosity, double grain_density_ratio);

/// What Sellmeijer's rule asks for.
struct PipingInput {
  double seepage_length = 0;                 ///< m, L, entry to exit
  double aquifer_thickness = 0;              ///< m, D
  double conductivity = 0;                   ///< m/s, k of the sand
  double d70 = 0;                            ///< m, of the top of the sand
  double grain_weight = 16.5e3;              ///< N/m³, γ'p, of grains under water
  double water_weight = 9810;                ///< N/m³
  double drag_factor = 0.25;                 ///< η, White's constant
  double rolling_angle = 0.645771823237902;  ///< rad, θ, 37°
  double viscosity = 1.33e-6;                ///< m²/s, kinematic, at 10 °C
  double gravity = 9.81;                     ///< m/s²
  double relative_density = 0.725;           ///< RD, the mean of the tests by default
  double uniformity = 1.81;                  ///< d60/d10, likewise
};

/// Sellmeijer et al. (2011), "Fine-tuning of the backward erosion piping model": H_c = L F_resistance F_scale
/// F_geometry,
///   F_resistance = η (γ'p/γw) tan θ (RD/0.725)^0.35 (U/1.81)^0.13,
///   F_scale = (d70m / ∛(κ L)) (d70/d70m)^0.4, κ = ν k/g, d70m = 2.08e-4 m,
///   F_geometry = 0.91 (D/L)^(0.28/((D/L)^2.8 − 1) + 0.04).
struct PipingResult {
  double resistance = 0, scale = 0, geometry = 0;
  double critical_head = 0;  ///< m, H_c
  std::vector<std::string>
      outside;  ///< inputs outside the range of the tests (150 < d70 < 430 µm, RD 0.34–1, U 1.3–2.6)
};
PipingResult sellmeijer(const PipingInput& input);

/// H_c over the head difference that drives the pipe, H − 0.3 d: the vertical channel through the blanket of thickness
/// `blanket` takes 0.3 d.
double piping_factor(const PipingResult& result, double head_difference, double blanket);

}  // namespace polder::stability
