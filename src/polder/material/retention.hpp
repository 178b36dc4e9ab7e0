#pragma once
// How much water a soil holds under suction, and how well it then conducts.
//
// Suction s = −p in Pa, positive above the water table; at s ≤ 0 the soil is saturated. Saturation S is the share of
// the pores filled with water, Se = (S − S_res)/(S_max − S_res) the effective one.
#include <algorithm>
#include <cmath>
#include <variant>

#include "polder/math/table.hpp"

namespace polder {

/// S = 1 − a_v s, not below `residual`.
struct LinearRetention {
  double slope = 0;     ///< a_v, 1/Pa
  double residual = 0;  ///< S_res
};

/// S = S_res + (S_max − S_res)[1 + (s/P0)^n]^−λ with n = 1/(1 − λ) (van Genuchten 1980, m = λ).
struct VanGenuchtenRetention {
  double entry_pressure = 1e4;  ///< P0, Pa
  double lambda = 0.5;
  double residual = 0;  ///< S_res
  double maximum = 1;   ///< S_max
};

/// S = S_res + (S_max − S_res) exp(−α s) (Gardner 1958; Srivastava & Yeh 1991).
struct GardnerRetention {
  double rate = 1e-4;  ///< α, 1/Pa
  double residual = 0;
  double maximum = 1;
};

/// S by suction, linear between the given points.
struct TableRetention {
  Table saturation;
};

using Retention = std::variant<LinearRetention, VanGenuchtenRetention, GardnerRetention, TableRetention>;

/// g_a (1/m) and g_n as geotechnical programs ask for them: P0 = γw/g_a, λ = 1 − 1/g_n.
inline VanGenuchtenRetention van_genuchten(double g_a, double g_n, double residual, double maximum,
                                           double unit_weight_of_water) {
  return {unit_weight_of_water / g_a, 1 - 1 / g_n, residual, maximum};
}

inline double saturation(const LinearRetention& r, double s) {
  return s <= 0 ? 1.0 : std::max(1 - r.slope * s, r.residual);
}
inline double saturation(const VanGenuchtenRetention& r, double s) {
  if (s <= 0) return r.maximum;
  return r.residual +
         (r.maximum - r.residual) * std::pow(1 + std::pow(s / r.entry_pressure, 1 / (1 - r.lambda)), -r.lambda);
}
inline double saturation(const GardnerRetention& r, double s) {
  return s <= 0 ? r.maximum : r.residual + (r.maximum - r.residual) * std::exp(-r.rate * s);
}
inline double saturation(const TableRetention& r, double s) { return r.saturation(std::max(s, 0.0)); }

/// −dS/ds in 1/Pa (positive: water released by a unit of suction); zero where saturated.
inline double capacity(const LinearRetention& r, double s) {
  return s <= 0 || 1 - r.slope * s <= r.residual ? 0.0 : r.slope;
}
inline double capacity(const VanGenuchtenRetention& r, double s) {
  if (s <= 0) return 0;
  const double n = 1 / (1 - r.lambda), x = s / r.entry_pressure, xn = std::pow(x, n);
  return (r.maximum - r.residual) * r.lambda * n * xn / (s * std::pow(1 + xn, r.lambda + 1));
}
inline double capacity(const GardnerRetention& r, double s) {
  return s <= 0 ? 0.0 : (r.maximum - r.residual) * r.rate * std::exp(-r.rate * s);
}
inline double capacity(const TableRetention& r, double s) {
  if (s <= 0) return 0;
  const auto& x = r.saturation.x;
  if (x.size() < 2 || s >= x.back()) return 0;
  const auto i = std::upper_bound(x.begin(), x.end(), s) - x.begin();
  return i == 0 ? 0.0 : (r.saturation.y[i - 1] - r.saturation.y[i]) / (x[i] - x[i - 1]);
}

/// Bounds of S that the effective saturation is measured between: {S_res, S_max}.
inline std::pair<double, double> saturation_bounds(const LinearRetention& r) { return {r.residual, 1.0}; }
inline std::pair<double, double> saturation_bounds(const VanGenuchtenRetention& r) { return {r.residual, r.maximum}; }
inline std::pair<double, double> saturation_bounds(const GardnerRetention& r) { return {r.residual, r.maximum}; }
inline std::pair<double, double> saturation_bounds(const TableRetention& r) {
  return {r.saturation.y.back(), r.saturation.y.front()};
}

inline double saturation(const Retention& retention, double s) {
  return std::visit([s](const auto& r) { return saturation(r, s); }, retention);
}
inline double capacity(const Retention& retention, double s) {
  return std::visit([s](const auto& r) { return capacity(r, s); }, retention);
}
inline double effective_saturation(const Retention& retention, double s) {
  const auto [low, high] = std::visit([](const auto& r) { return saturation_bounds(r); }, retention);
  return high > low ? std::clamp((saturation(retention, s) - low) / (high - low), 0.0, 1.0) : 1.0;
}

/// The same at every saturation.
struct ConstantConductivity {};
/// k_r = Se^l [1 − (1 − Se^{1/λ})^λ]² (Mualem 1976 with van Genuchten's retention); l is g_l.
struct MualemConductivity {
  double exponent = 0.5;  ///< l
  double lambda = 0.5;    ///< of the retention curve
};
/// k_r = S^r (Hillel 1971).
struct HillelConductivity {
  double exponent = 3;  ///< r
};
/// k_r = exp(−α s) (Gardner 1958).
struct GardnerConductivity {
  double rate = 1e-4;  ///< α, 1/Pa
};
/// k_r by saturation S, linear between the given points.
struct TableConductivity {
  Table relative;
};

using ConductivityCurve =
    std::variant<ConstantConductivity, MualemConductivity, HillelConductivity, GardnerConductivity, TableConductivity>;

inline double mualem(double se, double lambda, double exponent) {
  const double bracket = 1 - std::pow(1 - std::pow(se, 1 / lambda), lambda);
  return std::pow(se, exponent) * bracket * bracket;
}

/// Conductivity under suction s (Pa) over that of the saturated soil, 0 … 1.
inline double relative_conductivity(const ConductivityCurve& curve, const Retention& retention, double s) {
  if (s <= 0) return 1;
  struct Visitor {
    const Retention& retention;
    double s;
    double operator()(const ConstantConductivity&) const { return 1; }
    double operator()(const MualemConductivity& c) const {
      return mualem(effective_saturation(retention, s), c.lambda, c.exponent);
    }
    double operator()(const HillelConductivity& c) const { return std::pow(saturation(retention, s), c.exponent); }
    double operator()(const GardnerConductivity& c) const { return std::exp(-c.rate * s); }
    double operator()(const TableConductivity& c) const { return c.relative(saturation(retention, s)); }
  };
  return std::visit(Visitor{retention, s}, curve);
}

/// Factor on the conductivity when the void ratio changes by Δe: 10^(Δe/c_k) (Taylor 1948).
inline double conductivity_factor(double void_ratio_change, double c_k) {
  return std::pow(10.0, void_ratio_change / c_k);
}

}  // namespace polder
