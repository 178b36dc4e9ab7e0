#include "polder/math/units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace polder {
namespace {

struct Written {
  const char *quantity, *text;
  double value;  // SI
};

TEST(Measures, AreReadInTheUnitsOfEngineers) {
  constexpr double degree = std::numbers::pi / 180;
  const Written table[] = {
      {"length", "2 mm", 2e-3},
      {"length", "  5.1m ", 5.1},
      {"length", "+1e-1 m", 0.1},
      {"length", "-3.6 m", -3.6},
      {"length", "500 µm", 5e-4},
      {"time", "30 min", 1800},
      {"time", "2 h", 7200},
      {"time", "553 min", 33180},
      {"time", "1 year", 31557600},
      {"frequency", "10 1/s", 10},
      {"frequency", "10 /s", 10},
      {"frequency", "10 s^-1", 10},
      {"frequency", "10 s⁻¹", 10},
      {"frequency", "3 Hz", 3},
      {"density", "2700 kg/m3", 2700},
      {"density", "2.7 t/m³", 2700},
      {"density", "2.7 g/cm^3", 2700},
      {"density", "26.487 kN/m3", 2700},
      {"unit weight", "18 kN/m3", 18e3},
      {"unit weight", "2000 kg/m3", 19620},
      {"pressure", "1000 kPa", 1e6},
      {"pressure", "2.2 GPa", 2.2e9},
      {"pressure", "1 bar", 1e5},
      {"pressure", "5 kN/m2", 5e3},
      {"compressibility", "6e-3 1/kPa", 6e-6},
      {"permeability", "5.3 cm/s", 0.053},
      {"permeability", "1 m/day", 1 / 86400.0},
      {"permeability", "1e-3 m s-1", 1e-3},
      {"viscosity", "8.905e-4 Pa s", 8.905e-4},
      {"viscosity", "1 mPa·s", 1e-3},
      {"viscosity", "1e-3 N s/m2", 1e-3},
      {"viscosity", "1e-3 kg/m/s", 1e-3},
      {"acceleration", "9.81 m/s2", 9.81},
      {"inverse length", "0.1 1/cm", 10},
      {"area", "4.0e-11 m2", 4e-11},
      {"discharge", "1 l/s/m", 1e-3},
      {"angle", "35 deg", 35 * degree},
      {"angle", "35°", 35 * degree},
      {"angle", "0.5 rad", 0.5},
      {"ratio", "0.4", 0.4},
      {"ratio", "40 %", 0.4},
  };
  for (const Written& w : table) {
    const Measured measured = read_measure(w.text, *find_quantity(w.quantity));
    EXPECT_TRUE(measured.ok()) << w.text << ": " << measured.error;
    EXPECT_NEAR(measured.value, w.value, 1e-13 * std::abs(w.value)) << w.text;
  }
}

TEST(Measures, SayWhatIsWrongWithThem) {
  const struct {
    const char *quantity, *text, *error;
  } table[] = {
      {"length", "5 kg", "is a mass; a length is needed"},
      {"length", "5", "has no unit"},
      {"length", "", "does not start with a number"},
      {"length", "five m", "does not start with a number"},
      {"length", "inf m", "is not a finite number"},
      {"length", "nan m", "is not a finite number"},
      {"length", "1e999 m", "is not a finite number"},
      {"length", "1,5 m", "has a comma; the decimal mark is a point"},
      {"length", "5 furlong", "has the unknown unit \"furlong\""},
      {"length", "5 m/", "ends with a '/'"},
      {"length", "5 m2", "is an area; a length is needed"},
      {"pressure", "5 kN/m", "is a force per metre; a pressure is needed"},
      {"pressure", "5 kN s", "is another quantity; a pressure is needed"},
      {"density", "5 kPa", "is a pressure; a density is needed"},
      {"ratio", "5 deg", "is an angle; a ratio is needed"},
      {"angle", "5 %", "is a ratio; an angle is needed"},
  };
  for (const auto& w : table) EXPECT_EQ(read_measure(w.text, *find_quantity(w.quantity)).error, w.error) << w.text;
}

TEST(Quantities, HaveExamplesAndShownValuesThatReadBack) {
  for (const Quantity& q : quantities()) {
    const Measured example = read_measure(q.example, q);
    ASSERT_TRUE(example.ok()) << q.name << ": " << example.error;
    for (const double factor : {1.0, 1e4, 1e-4}) {
      const double value = factor * example.value;
      const Measured back = read_measure(show_measure(value, q), q);
      EXPECT_TRUE(back.ok()) << show_measure(value, q) << " " << back.error;
      EXPECT_NEAR(back.value, value, 1e-5 * std::abs(value)) << show_measure(value, q);
    }
  }
}

}  // namespace
}  // namespace polder
