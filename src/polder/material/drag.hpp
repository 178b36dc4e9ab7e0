#pragma once
// Drag between water and grains, and the viscosity of their mixture.
//
// Force per volume of mixture on the grains: f_d = β (v_w − v_s), in the form of the equations where the pressure acts
// on the water as −n∇p (docs/theory.md). All laws are given as β = n² c(n, |q|), q = n (v_w − v_s), so that water
// moving steadily under the gradient i has c q = ρ_w g i, and Darcy's law reads c = ρ_w g/K = μ/κ.
//   Ergun      c = A μ(1−n)²/(n³D²) + B ρ_w(1−n)|q|/(n³D)                       A 150, B 1.75
//   Darcy      the same without its second term
//   Gidaspow   Ergun in packed soil, Wen and Yu's c = ¾ C_d ρ_w(1−n)|q| n^−2.65/(n²D) in suspensions, C_d after
//   Schiller
//              and Naumann; blended linearly in n over 0.75–0.85, where the original jumps at 0.8
//   Beetstra   c = 18 φμ/(n²D²) {10φ/n + n³(1 + 1.5√φ) + 0.413 Re/(24n) [1/n + 3nφ + 8.4 Re^−0.343]/[1 + 10^{3φ}
//              Re^{−(1+4φ)/2}]}, φ = 1 − n, Re = ρ_w|q|D/μ
// The last two tend to one grain in still water as n → 1; Ergun's does not and belongs to packed soil.
// Sources: Ergun (1952), Chem. Eng. Prog. 48; Wen and Yu (1966), Chem. Eng. Prog. Symp. 62; Gidaspow (1994), Multiphase
// Flow and Fluidization; Beetstra, van der Hoef and Kuipers (2007), AIChE J. 53.
//
// With an exponent m the linear part follows K = K(n₀) [(1 − n₀)/(1 − n)]^m instead: (1 − n₀)/(1 − n) is the ratio of
// a volume of soil to its volume at the start. With a c_k it follows K = K(n₀) 10^(Δe/c_k), e = n/(1 − n) (Taylor
// 1948).
//
// A given hydraulic conductivity K(n₀) is kept as the grain diameter that Kozeny–Carman (κ = D²n³/(A(1−n)²)) assigns
// to it: all laws then scale with the porosity alike, and Ergun's b = ρ_w B/√(A n³κ) follows.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace polder {

enum class DragLaw { ergun, darcy, beetstra, gidaspow };

/// What a drag law needs of the material and of the water, plain numbers in SI.
struct DragInput {
  DragLaw law = DragLaw::ergun;
  double ergun_a = 150, ergun_b = 1.75;
  double grain_diameter = 0;           ///< m; 0: not given
  std::optional<double> conductivity;  ///< hydraulic conductivity in this direction, m/s, at initial_porosity
  double initial_porosity = 0.4;
  double water_density = 1000, viscosity = 1e-3;  ///< kg/m³, Pa s
  double gravity = 9.81;                          ///< m/s², the one that the conductivity refers to
  std::optional<double> exponent;  ///< m of K = K(n₀) [(1 − n₀)/(1 − n)]^m; absent: Kozeny–Carman
  std::optional<double> c_k;       ///< of K = K(n₀) 10^(Δe/c_k), instead
};

/// Coefficients of one material in one direction (make two where horizontal and vertical permeability differ).
struct Drag {
  DragLaw law;
  double viscous;   ///< Pa s/m², factor of (1−n)²/n³ (Beetstra: of the term in 10φ/n)
  double inertial;  ///< kg/m⁴, factor of (1−n)|q|/n³
  double diameter;  ///< m, of the grain in a suspension
  double density, viscosity;
  bool power = false;      ///< the linear part follows [(1 − n)/(1 − n₀)]^exponent or c_k, not Kozeny–Carman
  double exponent = 0;     ///< m
  double at_start = 0;     ///< Pa s/m², the linear part at n₀
  double solid_start = 1;  ///< 1 − n₀
  double void_rate = 0;    ///< ln 10/c_k; 0: the exponent

  /// Whether linear_resistance() and quadratic_resistance() say it all.
  bool plain() const { return law == DragLaw::ergun || law == DragLaw::darcy; }
  /// Whether packed_resistance() does.
  bool packed() const { return plain() && !power; }
};

/// μ/κ(n), Pa s/m²: what resists slow flow in packed soil.
inline double linear_resistance(const Drag& drag, double n) {
  const double phi = 1 - n;
  if (drag.void_rate > 0) return drag.at_start * std::exp(-drag.void_rate * (1 / phi - 1 / drag.solid_start));
  if (drag.power && drag.exponent == 0) return drag.at_start;
  if (drag.power) return drag.at_start * std::pow(phi / drag.solid_start, drag.exponent);
  double c = drag.viscous * phi * phi / (n * n * n);
  if (drag.law == DragLaw::beetstra)
    c += 18 * phi * drag.viscosity / (drag.diameter * drag.diameter) * n * (1 + 1.5 * std::sqrt(phi));
  return c;
}

/// ρ_w B/√(A n³κ), kg/m⁴: β = n²(linear + quadratic |q|) for Ergun; 0 for Darcy.
inline double quadratic_resistance(const Drag& drag, double n) { return drag.inertial * (1 - n) / (n * n * n); }

struct PackedResistance {
  double linear;     ///< Pa s/m²
  double quadratic;  ///< kg/m⁴
};

/// linear_resistance() and quadratic_resistance() of a drag that is packed(), with one division.
inline PackedResistance packed_resistance(const Drag& drag, double n) {
  const double c = (1 - n) / (n * n * n);
  return {drag.viscous * (1 - n) * c, drag.inertial * c};
}

namespace drag_detail {

/// Below this Reynolds number every law is its Stokes limit to round-off.
inline constexpr double still = 1e-12;

inline double wen_yu(const Drag& drag, double n, double q) {
  const double reynolds = drag.density * q * drag.diameter / drag.viscosity;
  // C_d Re/24 = 1 + 0.15 Re^0.687, and C_d = 0.44 beyond Re 1000.
  const double over_stokes =
      reynolds < 1000 ? 1 + 0.15 * std::pow(std::max(reynolds, still), 0.687) : 0.44 / 24 * reynolds;
  return 18 * drag.viscosity * (1 - n) / (drag.diameter * drag.diameter) * over_stokes * std::pow(n, -4.65);
}

inline double gidaspow(const Drag& drag, double n, double q) {
  const double dilute = std::clamp((n - 0.75) / 0.1, 0.0, 1.0);
  double c = 0;
  if (dilute < 1) c += (1 - dilute) * (linear_resistance(drag, n) + quadratic_resistance(drag, n) * q);
  if (dilute > 0) c += dilute * wen_yu(drag, n, q);
  return c;
}

inline double beetstra_inertia(const Drag& drag, double n, double q) {
  const double phi = 1 - n;
  const double reynolds = std::max(drag.density * q * drag.diameter / drag.viscosity, still);
  const double logarithm = std::log(reynolds);
  const double rise = 1 / n + 3 * n * phi + 8.4 * std::exp(-0.343 * logarithm);
  const double onset = 1 + std::exp(6.907755278982137 * phi - (0.5 + 2 * phi) * logarithm);
  return 18 * phi * drag.viscosity / (n * n * n * drag.diameter * drag.diameter) * (0.413 / 24) * reynolds * rise /
         onset;
}

}  // namespace drag_detail

/// c(n, |q|), Pa s/m², with β = n²c: the one call of the hot loop. q in m/s, 0 < n < 1.
inline double drag_coefficient(const Drag& drag, double n, double q) {
  switch (drag.law) {
    case DragLaw::gidaspow:
      return drag_detail::gidaspow(drag, n, q);
    case DragLaw::beetstra:
      return linear_resistance(drag, n) + drag_detail::beetstra_inertia(drag, n, q);
    case DragLaw::ergun:
    case DragLaw::darcy:
      break;
  }
  if (drag.power) return linear_resistance(drag, n) + quadratic_resistance(drag, n) * q;
  const double phi = 1 - n;
  return phi / (n * n * n) * (drag.viscous * phi + drag.inertial * q);
}

/// κ(n), m², intrinsic permeability to slow flow.
inline double intrinsic_permeability(const Drag& drag, double n) { return drag.viscosity / linear_resistance(drag, n); }

/// K(n), m/s, hydraulic conductivity to slow flow under the gravity g.
inline double hydraulic_conductivity(const Drag& drag, double n, double gravity) {
  return drag.density * gravity / linear_resistance(drag, n);
}

/// Throws std::invalid_argument where neither a grain diameter nor a conductivity is given.
inline Drag make_drag(const DragInput& in) {
  if (in.grain_diameter <= 0 && !in.conductivity)
    throw std::invalid_argument("drag needs a grain diameter or a hydraulic conductivity");
  const double n = in.initial_porosity, phi = 1 - n;
  const bool beetstra = in.law == DragLaw::beetstra;
  const double a = beetstra ? 180 : in.ergun_a;
  double packed = in.grain_diameter, grain = in.grain_diameter;
  if (in.conductivity) {
    const double wanted = in.water_density * in.gravity / *in.conductivity;
    double carman = a * in.viscosity * phi * phi / (n * n * n);
    const double suspended = beetstra ? 18 * phi * in.viscosity * n * (1 + 1.5 * std::sqrt(phi)) : 0.0;
    const double left = grain > 0 ? wanted - suspended / (grain * grain) : 0.0;
    if (grain > 0 && left > 0) {
      packed = std::sqrt(carman / left);
    } else {
      packed = std::sqrt((carman + suspended) / wanted);
      grain = packed;
    }
  }
  const double b = in.law == DragLaw::darcy || beetstra ? 0.0 : in.ergun_b;
  Drag drag{in.law,      a * in.viscosity / (packed * packed), b * in.water_density / packed, grain, in.water_density,
            in.viscosity};
  if (in.exponent || in.c_k) {
    drag.at_start = linear_resistance(drag, n);
    drag.solid_start = phi;
    drag.exponent = in.exponent.value_or(0);
    drag.void_rate = in.c_k ? std::numbers::ln10 / *in.c_k : 0;
    drag.power = true;
  }
  return drag;
}

/// Viscosity of water that carries grains, Pa s; φ = 1 − n. Beenakker (1984), as the published studies use it.
inline double mixture_viscosity_beenakker(double viscosity, double solid_fraction) {
  return viscosity * (1 + 2.5 * solid_fraction + 5.2 * solid_fraction * solid_fraction);
}

/// Einstein's, for a law in which the friction of the grains is accounted for by itself.
inline double mixture_viscosity_einstein(double viscosity, double solid_fraction) {
  return viscosity * (1 + 2.5 * solid_fraction);
}

}  // namespace polder
