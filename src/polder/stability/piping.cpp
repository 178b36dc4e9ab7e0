#include "polder/stability/piping.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace polder::stability {
namespace {

double ratio(double resistance, double load) {
  return load > 0 ? resistance / load : std::numeric_limits<double>::infinity();
}

// (D/L)^(0.28/((D/L)^2.8 − 1) + 0.04): at D = L the exponent is singular and the power tends to e^0.1.
double geometry_power(double d) {
  const double x = std::log(d);
  const double singular = std::abs(x) < 1e-8 ? 0.28 / 2.8 : 0.28 * x / std::expm1(2.8 * x);
  return std::exp(singular + 0.04 * x);
}

}  // namespace

double uplift_factor(const ExitPoint& exit) {
  const double base = exit.exit_head - exit.free_water - exit.blanket_thickness;
  const double weight = exit.blanket_weight * exit.blanket_thickness + exit.water_weight * exit.free_water;
  return ratio(weight, exit.water_weight * (exit.aquifer_head - base));
}

double critical_uplift_difference(const ExitPoint& exit) {
  return exit.blanket_thickness * (exit.blanket_weight - exit.water_weight) / exit.water_weight;
}

double heave_factor(const ExitPoint& exit, double critical) {
  return ratio(critical, (exit.aquifer_head - exit.exit_head) / exit.blanket_thickness);
}

double critical_gradient(double porosity, double grain_density_ratio) {
  return (1 - porosity) * (grain_density_ratio - 1);
}

PipingResult sellmeijer(const PipingInput& input) {
  constexpr double mean_d70 = 2.08e-4;  // m, of the small-scale tests
  PipingResult result;
  result.resistance = input.drag_factor * input.grain_weight / input.water_weight * std::tan(input.rolling_angle) *
                      std::pow(input.relative_density / 0.725, 0.35) * std::pow(input.uniformity / 1.81, 0.13);
  const double intrinsic = input.viscosity * input.conductivity / input.gravity;
  result.scale = mean_d70 / std::cbrt(intrinsic * input.seepage_length) * std::pow(input.d70 / mean_d70, 0.4);
  result.geometry = 0.91 * geometry_power(input.aquifer_thickness / input.seepage_length);
  result.critical_head = input.seepage_length * result.resistance * result.scale * result.geometry;
  const auto check = [&](const char* what, double value, double low, double high, const char* unit) {
    if (value < low || value > high)
      result.outside.push_back(
          fmt::format("{} {:g}{} is outside the tests' {:g} to {:g}{}", what, value, unit, low, high, unit));
  };
  check("d70", input.d70 * 1e6, 150, 430, " µm");
  check("relative density", input.relative_density, 0.34, 1.0, "");
  check("uniformity", input.uniformity, 1.3, 2.6, "");
  return result;
}

double piping_factor(const PipingResult& result, double head_difference, double blanket) {
  return ratio(result.critical_head, head_difference - 0.3 * blanket);
}

}  // namespace polder::stability
