#pragma once
// What the tests of this room share: laws by name with a few keys given, random states with a printed seed.
#include <gtest/gtest.h>

#include <initializer_list>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "polder/material/law.hpp"

namespace polder::support {

inline double degrees(double angle) { return angle * std::numbers::pi / 180; }

using Given = std::vector<std::pair<std::string_view, double>>;

/// The parameters of `law` with defaults filled in, as the case file does it.
inline std::vector<double> values_of(const LawDescription& law, const Given& given) {
  std::vector<double> values;
  for (const Parameter& parameter : law.parameters) {
    double value = parameter.standard;
    for (const auto& [key, v] : given)
      if (key == parameter.key) value = v;
    values.push_back(value);
  }
  for (const auto& [key, v] : given) {
    bool known = false;
    for (const Parameter& parameter : law.parameters) known = known || parameter.key == key;
    if (!known) throw std::invalid_argument("no such parameter: " + std::string(key));
  }
  return values;
}

inline std::unique_ptr<SoilLaw> make_law(std::string_view name, const Given& given,
                                         const LawContext& context = {0, 0.4, 0.5}) {
  const LawDescription* law = find_soil_law(name);
  if (!law) throw std::invalid_argument("no such law: " + std::string(name));
  return law->make(values_of(*law, given), context);
}

/// A generator whose seed is printed with every failure in the scope of the test.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed), trace_(__FILE__, __LINE__, "seed " + std::to_string(seed)) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  double normal() { return std::normal_distribution<double>()(engine_); }
  bool chance(double probability) { return uniform(0, 1) < probability; }

 private:
  std::mt19937 engine_;
  ::testing::ScopedTrace trace_;
};

}  // namespace polder::support
