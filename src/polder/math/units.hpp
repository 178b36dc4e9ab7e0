#pragma once
// Quantities with units, as engineers write them: "27 kN/m3", "5.3 cm/s", "8.905e-4 Pa s", "35 deg", "2 %".
// A text is a number and a product of units; what it may be is fixed by a quantity, which also names it in messages.
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace polder {

/// Exponents of mass, length, time and angle.
using Dimension = std::array<int, 4>;

/// A kind of quantity: its name in schemas and messages, its SI unit and an example of how to write it.
struct Quantity {
  std::string_view name;     ///< "length"
  std::string_view article;  ///< "a length", for messages
  std::string_view unit;     ///< SI unit; "" for a ratio
  std::string_view example;  ///< "0.05 m"
  Dimension dimension;
};

/// Acceleration that turns a unit weight (kN/m3) into a density and back, m/s².
inline constexpr double standard_gravity = 9.81;

std::span<const Quantity> quantities();
/// nullptr where there is none of that name.
const Quantity* find_quantity(std::string_view name);

/// A number in SI, or what is wrong with the text ("is a mass; a length is needed").
struct Measured {
  double value = 0;
  std::string error;  ///< empty: no error
  bool ok() const { return error.empty(); }
};

/// Reads a text such as "5.3 cm/s" as `quantity`. Densities may be given as unit weights and unit weights as densities
/// (with `standard_gravity`). A text without a unit is taken for ratios only.
Measured read_measure(std::string_view text, const Quantity& quantity);

/// A number in SI as a reader likes it: "2.2 GPa", "35 deg", "0.05 m".
std::string show_measure(double value, const Quantity& quantity);

}  // namespace polder
