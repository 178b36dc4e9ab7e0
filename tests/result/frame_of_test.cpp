// What a snapshot carries beside positions: excess pressures where there is a water table to exceed, saturation where
// soil carries its water.
#include "polder/result/frame_of.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "polder/case/reader.hpp"

namespace polder {
namespace {

constexpr double water_weight = 9810;  // N/m³

Frame frame_after(const std::string& text, int steps) {
  const std::string path =
      testing::TempDir() + "/" + testing::UnitTest::GetInstance()->current_test_info()->name() + ".toml";
  std::ofstream(path) << text;
  const ReadResult read = read_case(path);
  EXPECT_TRUE(read.ok()) << format(read.diagnostics);
  Simulation<PlaneStrain> run(read.model, 1);
  for (int step = 0; step < steps && !run.finished(); ++step) run.advance();
  return frame_of(run);
}

std::string silt(const std::string& more) {
  return R"(
[[material]]
name = "silt"
law = "linear-elastic"
grain_density = "2650 kg/m3"
porosity = 0.4
permeability = "5e-4 m/s"
permeability_exponent = 0
young_modulus = "20 MPa"
poisson_ratio = 0.3
fixed = true
[[soil]]
material = "silt"
box = [["0 m", "0 m"], ["0.5 m", "1 m"]]
)" + more;
}

const std::string flooded = R"(
[model]
title = "Ground under 0.4 m of water"
size = ["0.5 m", "1.6 m"]
cell = "0.1 m"
[[free_water]]
box = [["0 m", "1 m"], ["0.5 m", "1.4 m"]]
[[stage]]
name = "rest"
duration = "1 s"
)";

TEST(FrameOf, HasNoExcessPressureWhereWaterIsAtRestAsItsTableSays) {
  const Frame frame = frame_after(silt(flooded + R"(
[initial]
water_table = [["0 m", "1.4 m"], ["0.5 m", "1.4 m"]]
)"),
                                  50);
  ASSERT_NE(frame.soil.find("excess_pressure"), nullptr);
  EXPECT_EQ(frame.soil.find("saturation"), nullptr);
  const std::vector<double>& excess = frame.soil.find("excess_pressure")->values;
  const std::vector<double>& pressure = frame.soil.find("pore_pressure")->values;
  ASSERT_GT(excess.size(), 100u);
  for (std::size_t p = 0; p < excess.size(); ++p) {
    EXPECT_GT(pressure[p], 0.3 * water_weight);
    // Below the lowest middle of a cell pressures are that cell's: up to a quarter of its height.
    EXPECT_NEAR(excess[p], 0, 0.03 * water_weight) << frame.soil.position[p][1];
  }
}

TEST(FrameOf, HasNoExcessPressureWithoutAWaterTable) {
  EXPECT_EQ(frame_after(silt(flooded), 2).soil.find("excess_pressure"), nullptr);
}

TEST(FrameOf, HasTheSaturationOfUnsaturatedGround) {
  const Frame frame = frame_after(silt(R"(
[model]
title = "A column of silt"
formulation = "unsaturated"
size = ["0.5 m", "1.2 m"]
cell = "0.1 m"
[[retention]]
material = "silt"
g_a = "1 1/m"
g_n = 2
[initial]
water_table = [["0 m", "0.3 m"], ["0.5 m", "0.3 m"]]
[[stage]]
name = "rest"
duration = "1 s"
)"),
                                  5);
  ASSERT_NE(frame.soil.find("saturation"), nullptr);
  const std::vector<double>& saturation = frame.soil.find("saturation")->values;
  for (std::size_t p = 0; p < saturation.size(); ++p) {
    const double suction = std::max(0.0, frame.soil.position[p][1] - 0.3);  // m
    EXPECT_NEAR(saturation[p], 1 / std::sqrt(1 + suction * suction), 0.02) << suction;
  }
}

}  // namespace
}  // namespace polder
