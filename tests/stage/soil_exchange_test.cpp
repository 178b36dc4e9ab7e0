// Columns of soil that carries its water (single-point), with free water above or under air: what seeps out of the soil
// stands on it, a pond seeps into it, the water table falls and rises in it, and no water is lost.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "case_text.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {
namespace {

constexpr const char *rigid = "young_modulus = \"50 MPa\"\nfixed = true", *soft = "young_modulus = \"5 MPa\"";
constexpr double conductivity = 0.01, porosity = 0.4, height = 1, width = 0.2;  // SI

class Column {
 public:
  /// Soil 1 m high, wet to `table`, water above to `pond`, a head on the base, m; s; keys of the material.
  Column(double table, double pond, double head, double seconds, const char* skeleton)
      : run_(read_text(fmt::format(
                 R"(
[model]
size = ["0.2 m", "2 m"]
cell = "0.05 m"
formulation = "single-point"
[[material]]
name = "sand"
law = "linear-elastic"
poisson_ratio = 0.3
{}
grain_density = "2650 kg/m3"
porosity = {}
permeability = "{} m/s"
permeability_exponent = 0
drag = "darcy"
[[soil]]
material = "sand"
box = [["0 m", "0 m"], ["0.2 m", "{} m"]]
{}
[initial]
water_table = [["0 m", "{} m"], ["0.2 m", "{} m"]]
stress = "k0"
k0 = 0.5
[[boundary]]
side = "base"
soil = "rough"
water = "head"
head = "{} m"
[[stage]]
name = "seepage"
duration = "{} s"
)",
                 skeleton, porosity, conductivity, height,
                 pond > height
                     ? fmt::format("[[free_water]]\nbox = [[\"0 m\", \"{} m\"], [\"0.2 m\", \"{} m\"]]\n", height, pond)
                     : "",
                 table, table, head, seconds)),
             1) {}

  void run_to(double time) {
    while (run_.time() < time && !run_.finished()) run_.advance();
  }
  double pond() const { return std::accumulate(state().water.volume.begin(), state().water.volume.end(), 0.0) / width; }
  /// Of the soil that carries water, m.
  double table() const {
    return std::accumulate(state().soil.water.begin(), state().soil.water.end(), 0.0) / (width * porosity);
  }
  double balance() const { return run_.audit().water_balance_error(state()); }
  double overfilled() const { return run_.audit().overfilled_most; }
  const Stepper<PlaneStrain>& state() const { return run_.state(); }

 private:
  Simulation<PlaneStrain> run_;
};

// q = K (H − h)/L into a pond of depth h over the soil, dh/dt = q
TEST(SoilExchange, LetsWaterThatRisesThroughSoilStandOnIt) {
  Column column(1, 1.2, 1.7, 10, soft);
  column.run_to(10);
  const double head = 0.5 * std::exp(-conductivity / height * 10);
  EXPECT_NEAR(column.pond(), 0.7 - head, 0.03 * (0.5 - head));
  EXPECT_NEAR(column.table(), 1, 2e-3);
  EXPECT_LT(column.balance(), 1e-12);
  EXPECT_LT(column.overfilled(), 0.01);
}

// d(L + h)/dt = −K (L + h)/L; and when the pond is gone, a water table that falls by K/n
TEST(SoilExchange, LetsAPondSeepAwayAndThenTheWaterTableFall) {
  Column column(1, 1.3, 0, 60, rigid);
  column.run_to(20);
  const double pond = 1.3 * std::exp(-conductivity / height * 20) - 1;
  EXPECT_NEAR(column.pond(), pond, 0.03 * 0.3);
  column.run_to(40);
  const double dry = std::log(1.3) / conductivity;
  const double table = 1 - conductivity / porosity * (40 - dry);
  EXPECT_NEAR(column.table(), table, 0.02);
  EXPECT_LT(column.balance(), 1e-12);
}

// n z dz/dt = K (H − z)
TEST(SoilExchange, WetsDrySoilFromBelow) {
  Column column(0.3, 0, 1.5, 20, rigid);
  double z = 0.3;
  for (int i = 0; i < 20000; ++i) z += 1e-3 * conductivity * (1.5 - z) / (porosity * z);
  column.run_to(20);
  EXPECT_NEAR(column.table(), z, 0.02);
  EXPECT_LT(column.pond(), 0.01);
  EXPECT_LT(column.balance(), 1e-12);
}

}  // namespace
}  // namespace polder
