// Excess pore pressure: none in still water, whatever stands over the ground; that of Darcy's gradient under an upward
// flow.
#include "polder/result/excess_pressure.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <memory>

#include "polder/case/reader.hpp"

namespace polder {
namespace {

constexpr double water_weight = 9810;  // N/m³

std::unique_ptr<Simulation<PlaneStrain>> after(const std::string& text, int steps) {
  const std::string path =
      testing::TempDir() + "/" + testing::UnitTest::GetInstance()->current_test_info()->name() + ".toml";
  std::ofstream(path) << text;
  const ReadResult read = read_case(path);
  EXPECT_TRUE(read.ok()) << format(read.diagnostics);
  auto run = std::make_unique<Simulation<PlaneStrain>>(read.model, 1);
  for (int step = 0; step < steps && !run->finished(); ++step) run->advance();
  return run;
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

TEST(ExcessPressure, IsNoneInStillWaterThatStandsOverTheGround) {
  const auto held = after(silt(R"(
[model]
title = "Ground under 0.4 m of water"
size = ["0.5 m", "1.6 m"]
cell = "0.1 m"
[[free_water]]
box = [["0 m", "1 m"], ["0.5 m", "1.4 m"]]
[initial]
water_table = [["0 m", "1.4 m"], ["0.5 m", "1.4 m"]]
[[stage]]
name = "rest"
duration = "1 s"
)"),
                          50);
  const auto& run = *held;
  ASSERT_GT(run.state().soil.size(), 100u);
  for (std::size_t p = 0; p < run.state().soil.size(); ++p) {
    const auto x = position_of(run.state().soil, p);
    EXPECT_GT(run.pressure_at(x), 0.3 * water_weight);
    EXPECT_NEAR(excess_pressure(run, x), 0, 0.01 * 1.4 * water_weight) << x[1];
  }
}

/// A column of which the base is under a head of 1.5 m and the top, at 1 m, lets water out.
std::string unsaturated(const std::string& table, const std::string& conditions) {
  return silt(R"(
[model]
title = "A column of silt"
formulation = "unsaturated"
size = ["0.5 m", "1.2 m"]
cell = "0.1 m"
[[retention]]
material = "silt"
g_a = "0.3 1/m"
g_n = 2
[initial]
water_table = [["0 m", ")" +
              table + R"("], ["0.5 m", ")" + table + R"("]]
)" + conditions +
              R"(
[[stage]]
name = "flow"
duration = "60 s"
local_damping = 0.5
)");
}

TEST(ExcessPressure, IsNoneUnderAWaterTableAtRestNorUnderSuction) {
  const auto held = after(unsaturated("0.55 m", ""), 100);
  const auto& run = *held;
  for (std::size_t p = 0; p < run.state().soil.size(); ++p)
    EXPECT_NEAR(excess_pressure(run, position_of(run.state().soil, p)), 0, 0.01 * water_weight);
}

TEST(ExcessPressure, FallsLinearlyAlongAnUpwardFlow) {
  const auto held = after(unsaturated("1 m", R"(
[[seepage_boundary]]
line = [["0 m", "0 m"], ["0.5 m", "0 m"]]
head = "1.5 m"
[[seepage_boundary]]
line = [["0 m", "1 m"], ["0.5 m", "1 m"]]
condition = "seepage"
)"),
                          2000);
  const auto& run = *held;
  for (std::size_t p = 0; p < run.state().soil.size(); ++p) {
    const auto x = position_of(run.state().soil, p);
    // What the last half cell loses is read as a higher top, 0.025 m; under the lowest middle of a cell heads are its
    // own, up to 0.0125 m.
    EXPECT_NEAR(excess_pressure(run, x), 0.5 * (1 - x[1]) * water_weight, 0.038 * water_weight) << x[1];
  }
}

}  // namespace
}  // namespace polder
