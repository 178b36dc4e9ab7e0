#include "polder/math/units.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace polder {
namespace {

constexpr double degree = std::numbers::pi / 180;

struct Unit {
  std::string_view name;
  double factor;
  Dimension dimension;
};

constexpr Unit units[] = {
    {"m", 1, {0, 1, 0, 0}},
    {"km", 1e3, {0, 1, 0, 0}},
    {"dm", 1e-1, {0, 1, 0, 0}},
    {"cm", 1e-2, {0, 1, 0, 0}},
    {"mm", 1e-3, {0, 1, 0, 0}},
    {"um", 1e-6, {0, 1, 0, 0}},
    {"µm", 1e-6, {0, 1, 0, 0}},
    {"l", 1e-3, {0, 3, 0, 0}},
    {"s", 1, {0, 0, 1, 0}},
    {"ms", 1e-3, {0, 0, 1, 0}},
    {"us", 1e-6, {0, 0, 1, 0}},
    {"min", 60, {0, 0, 1, 0}},
    {"h", 3600, {0, 0, 1, 0}},
    {"hour", 3600, {0, 0, 1, 0}},
    {"hours", 3600, {0, 0, 1, 0}},
    {"d", 86400, {0, 0, 1, 0}},
    {"day", 86400, {0, 0, 1, 0}},
    {"days", 86400, {0, 0, 1, 0}},
    {"week", 7 * 86400.0, {0, 0, 1, 0}},
    {"weeks", 7 * 86400.0, {0, 0, 1, 0}},
    {"year", 365.25 * 86400, {0, 0, 1, 0}},
    {"years", 365.25 * 86400, {0, 0, 1, 0}},
    {"Hz", 1, {0, 0, -1, 0}},
    {"g", 1e-3, {1, 0, 0, 0}},
    {"kg", 1, {1, 0, 0, 0}},
    {"t", 1e3, {1, 0, 0, 0}},
    {"N", 1, {1, 1, -2, 0}},
    {"kN", 1e3, {1, 1, -2, 0}},
    {"MN", 1e6, {1, 1, -2, 0}},
    {"Pa", 1, {1, -1, -2, 0}},
    {"mPa", 1e-3, {1, -1, -2, 0}},
    {"hPa", 1e2, {1, -1, -2, 0}},
    {"kPa", 1e3, {1, -1, -2, 0}},
    {"MPa", 1e6, {1, -1, -2, 0}},
    {"GPa", 1e9, {1, -1, -2, 0}},
    {"bar", 1e5, {1, -1, -2, 0}},
    {"mbar", 1e2, {1, -1, -2, 0}},
    {"rad", 1, {0, 0, 0, 1}},
    {"deg", degree, {0, 0, 0, 1}},
    {"°", degree, {0, 0, 0, 1}},
    {"%", 0.01, {0, 0, 0, 0}},
    {"1", 1, {0, 0, 0, 0}},
};

constexpr Dimension density_dimension{1, -3, 0, 0};
constexpr Dimension unit_weight_dimension{1, -2, -2, 0};

constexpr Quantity table[] = {
    {"length", "a length", "m", "0.05 m", {0, 1, 0, 0}},
    {"area", "an area", "m2", "4e-11 m2", {0, 2, 0, 0}},
    {"volume", "a volume", "m3", "2 m3", {0, 3, 0, 0}},
    {"time", "a time", "s", "30 min", {0, 0, 1, 0}},
    {"frequency", "a frequency", "1/s", "10 1/s", {0, 0, -1, 0}},
    {"density", "a density", "kg/m3", "2650 kg/m3", density_dimension},
    {"unit weight", "a unit weight", "N/m3", "18 kN/m3", unit_weight_dimension},
    {"pressure", "a pressure", "Pa", "10 kPa", {1, -1, -2, 0}},
    {"compressibility", "a compressibility", "1/Pa", "6e-3 1/kPa", {-1, 1, 2, 0}},
    {"velocity", "a velocity", "m/s", "0.5 m/s", {0, 1, -1, 0}},
    {"permeability", "a permeability (hydraulic conductivity)", "m/s", "5.3 cm/s", {0, 1, -1, 0}},
    {"discharge", "a discharge per metre", "m2/s", "1e-3 m2/s", {0, 2, -1, 0}},
    {"acceleration", "an acceleration", "m/s2", "9.81 m/s2", {0, 1, -2, 0}},
    {"viscosity", "a viscosity", "Pa s", "1e-3 Pa s", {1, -1, -1, 0}},
    {"inverse length", "an inverse length", "1/m", "0.1 1/cm", {0, -1, 0, 0}},
    {"mass", "a mass", "kg", "1 kg", {1, 0, 0, 0}},
    {"force", "a force", "N", "1 kN", {1, 1, -2, 0}},
    {"line force", "a force per metre", "N/m", "20 kN/m", {1, 0, -2, 0}},
    {"angle", "an angle", "rad", "35 deg", {0, 0, 0, 1}},
    {"ratio", "a ratio", "", "0.4", {0, 0, 0, 0}},
};

std::string_view trim(std::string_view s) {
  while (!s.empty() && (s.front() == ' ' || s.front() == '\t')) s.remove_prefix(1);
  while (!s.empty() && (s.back() == ' ' || s.back() == '\t')) s.remove_suffix(1);
  return s;
}

/// Takes an exponent off the end of a unit: "m3", "m^3", "m³", "s-1". 1 where there is none.
int take_exponent(std::string_view& name) {
  static constexpr std::pair<std::string_view, int> raised[] = {{"²", 2}, {"³", 3}, {"⁴", 4}, {"⁻¹", -1}};
  for (const auto& [mark, power] : raised)
    if (name.size() > mark.size() && name.ends_with(mark)) {
      name.remove_suffix(mark.size());
      return power;
    }
  std::size_t digits = name.size();
  while (digits > 0 && name[digits - 1] >= '0' && name[digits - 1] <= '9') --digits;
  if (digits == name.size() || digits == 0 || name.size() - digits > 2) return 1;
  int power = 0;
  for (std::size_t i = digits; i < name.size(); ++i) power = 10 * power + (name[i] - '0');
  if (name[digits - 1] == '-') {
    power = -power;
    --digits;
  }
  if (digits > 1 && name[digits - 1] == '^') --digits;
  if (digits == 0) return 1;
  name = name.substr(0, digits);
  return power;
}

struct Product {
  double factor = 1;
  Dimension dimension{};
  std::string error;
};

/// "kg/m3", "Pa s", "1/kPa", "N·s/m2": factors separated by blanks, '*' or '·'; '/' divides by the factor after it.
Product read_units(std::string_view text) {
  Product product;
  text = trim(text);
  int sign = 1;
  while (!text.empty()) {
    if (text.front() == '/') {
      sign = -1;
      text = trim(text.substr(1));
      if (text.empty()) product.error = "ends with a '/'";
      continue;
    }
    if (text.front() == '*') {
      text = trim(text.substr(1));
      continue;
    }
    if (text.starts_with("·")) {
      text = trim(text.substr(std::string_view("·").size()));
      continue;
    }
    std::size_t end = text.find_first_of(" \t/*");
    end = std::min({end, text.find("·"), text.size()});
    std::string_view name = text.substr(0, end);
    const std::string_view whole = name;
    const int power = sign * (name == "1" ? 1 : take_exponent(name));
    const Unit* unit = nullptr;
    for (const Unit& u : units)
      if (u.name == name) unit = &u;
    if (!unit) {
      product.error = "has the unknown unit \"" + std::string(whole) + "\"";
      return product;
    }
    product.factor *= std::pow(unit->factor, power);
    for (std::size_t i = 0; i < 4; ++i) product.dimension[i] += power * unit->dimension[i];
    sign = 1;
    text = trim(text.substr(end));
  }
  return product;
}

std::string name_of(const Dimension& dimension) {
  for (const Quantity& q : table)
    if (q.dimension == dimension) return std::string(q.article);
  return "another quantity";
}

}  // namespace

std::span<const Quantity> quantities() { return table; }

const Quantity* find_quantity(std::string_view name) {
  for (const Quantity& q : table)
    if (q.name == name) return &q;
  return nullptr;
}

Measured read_measure(std::string_view text, const Quantity& quantity) {
  std::string_view rest = trim(text);
  if (!rest.empty() && rest.front() == '+') rest.remove_prefix(1);
  double number = 0;
  const auto [end, status] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (status == std::errc::invalid_argument) return {0, "does not start with a number"};
  if (status != std::errc() || !std::isfinite(number)) return {0, "is not a finite number"};
  rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
  if (rest.starts_with(',')) return {0, "has a comma; the decimal mark is a point"};
  const Product unit = read_units(rest);
  if (!unit.error.empty()) return {0, unit.error};
  if (trim(rest).empty() && quantity.dimension != Dimension{}) return {0, "has no unit"};
  double factor = unit.factor;
  if (unit.dimension != quantity.dimension) {
    if (unit.dimension == unit_weight_dimension && quantity.dimension == density_dimension)
      factor /= standard_gravity;
    else if (unit.dimension == density_dimension && quantity.dimension == unit_weight_dimension)
      factor *= standard_gravity;
    else
      return {0, "is " + name_of(unit.dimension) + "; " + std::string(quantity.article) + " is needed"};
  }
  return {number * factor, {}};
}

std::string show_measure(double value, const Quantity& quantity) {
  if (std::isnan(value)) return "undefined";
  if (std::isinf(value)) return value > 0 ? "infinite" : "minus infinite";
  double shown = value;
  std::string unit(quantity.unit);
  const double size = std::abs(value);
  if (quantity.name == "pressure" && size >= 1e3) {
    const int step = size >= 1e9 ? 3 : size >= 1e6 ? 2 : 1;
    shown = value / std::pow(1e3, step);
    unit = step == 3 ? "GPa" : step == 2 ? "MPa" : "kPa";
  } else if (quantity.name == "unit weight" && size >= 1e3) {
    shown = value / 1e3;
    unit = "kN/m3";
  } else if (quantity.name == "angle") {
    shown = value / degree;
    unit = "deg";
  }
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", shown);
  return unit.empty() ? text : std::string(text) + " " + unit;
}

}  // namespace polder
