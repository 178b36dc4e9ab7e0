// Loads on the ground: how much presses where, and when.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "case_text.hpp"
#include "polder/case/ground_load.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {
namespace {

TEST(GroundLoad, IsLinearBetweenItsEnds) {
  GroundLoad load;
  load.span = {1, 3};
  load.pressure = Table::constant(10);
  load.pressure_at_end = Table::constant(30);
  EXPECT_DOUBLE_EQ(pressure_on(load, 0, 99, 1.5, 0.1), 15);
  EXPECT_DOUBLE_EQ(pressure_on(load, 0, 0, 3, 0.1), 30);
}

TEST(GroundLoad, TravelsAndIsConservedOnTheWay) {
  GroundLoad load;
  load.span = {1, 2.5};
  load.pressure = Table::constant(10);
  load.speed = 3;
  for (const double t : {0.0, 0.123, 0.4, 1.0}) {
    double total = 0;
    for (int i = 0; i < 200; ++i) total += 0.05 * pressure_on(load, t, (i + 0.5) * 0.05, 0, 0.05);
    EXPECT_NEAR(total, 15, 1e-9) << t;
  }
  EXPECT_EQ(pressure_on(load, 1, 1.5, 1.5, 0.05), 0);
  EXPECT_NEAR(pressure_on(load, 1, 4.5, 4.5, 0.05), 10, 1e-9);
}

std::string layer(const std::string& loads) {
  return R"(
[model]
size = ["4 m", "1 m"]
cell = "0.1 m"
gravity = "0 m/s2"
[[material]]
name = "sand"
law = "linear-elastic"
young_modulus = "10 MPa"
poisson_ratio = 0
grain_density = "2650 kg/m3"
porosity = 0.4
permeability = "1e-3 m/s"
[[soil]]
material = "sand"
box = [["0 m", "0 m"], ["4 m", "0.6 m"]]
[initial]
stress = "none"
[[stage]]
name = "one"
duration = "0.1 s"
damping = "100 1/s"
[[stage]]
name = "two"
duration = "0.3 s"
damping = "100 1/s"
[[stage]]
name = "three"
duration = "0.3 s"
damping = "100 1/s"
)" + loads;
}

/// Pa, mean of −σyy over columns of points.
double stress_between(const Simulation<PlaneStrain>& run, double from, double to) {
  const auto& soil = run.state().soil;
  double sum = 0;
  int number = 0;
  for (std::size_t p = 0; p < soil.size(); ++p)
    if (soil.position[0][p] > from && soil.position[0][p] < to && soil.position[1][p] < 0.3)
      sum -= soil.stress[1][p], ++number;
  return sum / number;
}

TEST(GroundLoad, ComesAndGoesWithItsStages) {
  Simulation<PlaneStrain> run(
      read_text(
          layer("[[load]]\nspan = [0, 4]\npressure = \"10 kPa\"\nfrom_stage = \"two\"\nuntil_stage = \"three\"\n")),
      1);
  while (run.stage_number() < 1) run.advance();
  EXPECT_EQ(stress_between(run, 0, 4), 0);
  while (run.stage_number() < 2) run.advance();
  EXPECT_NEAR(stress_between(run, 0, 4), 10e3, 100);
  while (!run.finished()) run.advance();
  EXPECT_NEAR(stress_between(run, 0, 4), 0, 100);
}

TEST(GroundLoad, OfTheFirstStageIsThereFromTheStart) {
  Simulation<PlaneStrain> run(
      read_text(
          layer("[[load]]\nspan = [0, 4]\npressure = \"10 kPa\"\nfrom_stage = \"one\"\nuntil_stage = \"three\"\n")),
      1);
  while (run.stage_number() < 2) run.advance();
  EXPECT_NEAR(stress_between(run, 0, 4), 10e3, 100);
  while (!run.finished()) run.advance();
  EXPECT_NEAR(stress_between(run, 0, 4), 0, 100);
}

TEST(GroundLoad, GrowsAlongItsSpan) {
  Simulation<PlaneStrain> run(
      read_text(layer("[[load]]\nspan = [0, 4]\npressure = \"0 kPa\"\npressure_at_end = \"20 kPa\"\n")), 1);
  while (!run.finished()) run.advance();
  EXPECT_NEAR(stress_between(run, 1.8, 2.2), 10e3, 300);
  EXPECT_NEAR(stress_between(run, 3.0, 3.4), 16e3, 500);
}

TEST(GroundLoad, OfTrafficPassesOver) {
  Simulation<PlaneStrain> run(
      read_text(layer("[[load]]\nspan = [-1.2, -0.2]\npressure = \"10 kPa\"\nspeed = \"4 m/s\"\n")), 1);
  double here = 0, elsewhere = 0;
  while (!run.finished()) {
    run.advance();
    if (std::abs(run.time() - 0.55) < 1e-3) {  // it stands between 1 m and 2 m
      here = stress_between(run, 1.3, 1.7);
      elsewhere = stress_between(run, 3.2, 3.8);
    }
  }
  EXPECT_GT(here, 4e3);
  EXPECT_LT(std::abs(elsewhere), 500);
}

}  // namespace
}  // namespace polder
