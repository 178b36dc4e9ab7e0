// The unsaturated formulation: water that stands on the ground loads it and does not squeeze its skeleton; a column
// drained and wetted again returns to its state; a seepage face lets out what Darcy brings to it; no water is lost.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <memory>

#include "case_text.hpp"
#include "largest_displacement.hpp"
#include "polder/stage/simulation.hpp"
#include "silt.hpp"

namespace polder {
namespace {

constexpr double water_weight = 9810;  // N/m³

std::unique_ptr<Simulation<PlaneStrain>> after(const std::string& text) {
  auto run = std::make_unique<Simulation<PlaneStrain>>(read_text(text), 1);
  while (!run->finished()) run->advance();
  EXPECT_LT(run->audit().water_balance_error(run->state()), 1e-12);
  return run;
}

std::string soil(const std::string& outline, const std::string& more) {
  return silt() + fmt::format(R"([[soil]]
material = "silt"
polygon = {}
{}
)",
                              outline, more);
}

/// Rest under gravity, then the change; ends inside [numerics].
std::string stages(const std::string& duration, double damping, int stretch, const std::string& rest = "20 s") {
  return fmt::format(R"(
[[stage]]
name = "rest"
duration = "{}"
initial = true
local_damping = 0.7
[[stage]]
name = "change"
duration = "{}"
local_damping = {}
[numerics]
step_stretch = {}
)",
                     rest, duration, damping, stretch);
}

std::string column(const std::string& initial_level, const std::string& boundaries, const std::string& duration,
                   const std::string& longest_step = "10 s") {
  return R"(
[model]
formulation = "unsaturated"
size = ["0.5 m", "6 m"]
cell = "0.25 m"
[initial]
water_table = )" +
         fmt::format("[[0, {0}], [0.5, {0}]]", initial_level) +
         soil("[[0, 0], [0.5, 0], [0.5, 4], [0, 4]]", boundaries) + stages(duration, 0.5, 1000) +
         fmt::format("max_step = \"{}\"\n", longest_step);
}

template <class Points>
std::array<double, 2> highest_and_lowest_vertical_stress(const Points& points) {
  std::size_t high = 0, low = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (points.position[1][p] > points.position[1][high]) high = p;
    if (points.position[1][p] < points.position[1][low]) low = p;
  }
  return {points.stress[1][high], points.stress[1][low]};
}

std::string base(const std::string& head) {
  return fmt::format(R"(
[[seepage_boundary]]
name = "base"
line = [[0, 0], [0.5, 0]]
head = {}
[[seepage_boundary]]
name = "ground"
line = [[0, 4], [0.5, 4]]
condition = "closed"
)",
                     head);
}

double water_of(const Simulation<PlaneStrain>& run) {
  double sum = 0;
  for (const double w : run.state().soil.water) sum += w;
  return sum;
}

TEST(StandingWater, LoadsTheWaterOfTheGroundNotItsSkeleton) {
  const std::string level = R"([[seepage_boundary]]
name = "river"
line = [[0, 4], [0.5, 4]]
head = {}
)";
  const auto before = after(column("4", fmt::format(fmt::runtime(level), "\"4 m\""), "60 s"));
  const auto under =
      after(column("4", fmt::format(fmt::runtime(level), R"([["20 s", "4 m"], ["25 s", "5.5 m"]])"), "60 s"));
  const auto dry = highest_and_lowest_vertical_stress(before->state().soil);
  const auto wet = highest_and_lowest_vertical_stress(under->state().soil);
  EXPECT_NEAR(wet[1], dry[1], 0.01 * std::abs(dry[1]));
  EXPECT_NEAR(dry[1], -0.6 * 1650 * 9.81 * 3.9375, 0.03 * std::abs(dry[1]));  // buoyant weight
  EXPECT_NEAR(under->pressure_at({0.25, 1.125, 0}), water_weight * (5.5 - 1.125), 0.005 * water_weight * 5.5);
  EXPECT_LT(largest_displacement(under->state().soil), 2e-3);
}

TEST(StandingWater, LeavesTheStressOfTheGrainsAsItRisesThroughCells) {
  // ground that ends a quarter up in a cell; whatever stands on it, grains weigh what they weigh under water
  Simulation<PlaneStrain> run(read_text(R"(
[model]
formulation = "unsaturated"
size = ["0.2 m", "1.2 m"]
cell = "0.1 m"
points_per_axis = 4
[initial]
water_table = [["0 m", "0.625 m"], ["0.2 m", "0.625 m"]]
)" + soil("[[0, 0], [0.2, 0], [0.2, 0.625], [0, 0.625]]", R"(
[[seepage_boundary]]
name = "river"
line = [["0 m", "0.625 m"], ["0.2 m", "0.625 m"]]
head = [["0 s", "0.63 m"], ["10 s", "1 m"]]
[[boundary]]
side = "base"
soil = "rough"
[[stage]]
name = "flood"
duration = "10 s"
local_damping = 0.7
)")),
                              1);
  while (!run.finished()) {
    run.advance();
    if (run.time() < 0.5) continue;
    const auto& points = run.state().soil;
    for (std::size_t p = 0; p < points.size(); ++p)
      ASSERT_NEAR(points.stress[1][p], -0.6 * 1650 * 9.81 * (0.625 - points.position[1][p]), 200)
          << "t = " << run.time() << ", y = " << points.position[1][p];
  }
}

TEST(StandingWater, IsInTheStressByK0AtTheStart) {
  const std::string pond = R"([[free_water]]
box = [[0, 4], [0.5, 5.5]]
)";
  Simulation<PlaneStrain> run(read_text(column("5.5", pond, "2 s", "0.01 s")), 1);
  const auto is_buoyant = [&](double share) {
    const auto& points = run.state().soil;
    for (std::size_t p = 0; p < points.size(); ++p)
      ASSERT_NEAR(points.stress[1][p], -0.6 * 1650 * 9.81 * (4 - points.position[1][p]), share * 0.6 * 1650 * 9.81 * 4)
          << "y = " << points.position[1][p];
  };
  is_buoyant(1e-4);
  const double level = run.state().soil.position[1][0];
  for (int step = 0; step < 200; ++step) run.advance();
  is_buoyant(0.01);
  EXPECT_NEAR(run.state().soil.position[1][0], level, 1e-4);
}

TEST(StandingWater, OverASlopeThatIsUnderItAlreadyMovesNothing) {
  const auto slope = [](const std::string& head) {
    return R"(
[model]
formulation = "unsaturated"
size = ["8 m", "6 m"]
cell = "0.5 m"
[initial]
water_table = [[0, 4], [8, 4]]
)" + soil("[[0, 0], [8, 0], [8, 3], [6, 3], [2, 1], [0, 1]]", fmt::format(R"(
[[seepage_boundary]]
name = "river"
line = [[0, 1], [2, 1], [6, 3], [8, 3]]
head = {}
[[boundary]]
side = "base"
soil = "rough"
)",
                                                                          head) +
                                                                  stages("60 s", 0.3, 100));
  };
  const auto still = after(slope("\"4 m\"")), higher = after(slope(R"([["20 s", "4 m"], ["25 s", "6 m"]])"));
  double moved = 0, stress = 0, largest = 0;
  ASSERT_EQ(still->state().soil.size(), higher->state().soil.size());
  std::map<std::size_t, std::size_t> place;
  for (std::size_t p = 0; p < still->state().soil.size(); ++p) place[still->state().soil.id[p]] = p;
  for (std::size_t p = 0; p < higher->state().soil.size(); ++p) {
    const std::size_t q = place.at(higher->state().soil.id[p]);
    for (int a = 0; a < 2; ++a)
      moved = std::max(moved, std::abs(higher->state().soil.position[a][p] - still->state().soil.position[a][q]));
    stress = std::max(stress, std::abs(higher->state().soil.stress[1][p] - still->state().soil.stress[1][q]));
    largest = std::max(largest, std::abs(still->state().soil.stress[1][q]));
  }
  EXPECT_LT(moved, 2e-4);
  EXPECT_LT(stress, 0.005 * largest);
}

TEST(UnsaturatedColumn, HoldsTheSameWaterWhateverItsStep) {
  const auto drained = [](const std::string& step) {
    const auto run = after(column("3.5", base(R"([["0 s", "3.5 m"], ["1 s", "0.5 m"]])"), "40 s", step));
    return water_of(*run);
  };
  EXPECT_NEAR(drained("1 s"), drained("2 ms"), 1e-4);
}

TEST(StepMaterial, SetsTheStepAndSoilTooStiffForItSettlesTheSame) {
  const auto on_marl = [](const std::string& sets_step) {
    return after(R"(
[model]
formulation = "unsaturated"
size = ["0.5 m", "6 m"]
cell = "0.25 m"
[initial]
water_table = [[0, 3.5], [0.5, 3.5]]
[[material]]
name = "marl"
law = "linear-elastic"
grain_density = "2650 kg/m3"
porosity = 0.4
permeability = "5e-4 m/s"
young_modulus = "500 MPa"
poisson_ratio = 0.3
[[retention]]
material = "marl"
model = "linear"
slope = "1e-3 1/kPa"
[[soil]]
material = "marl"
box = [[0, 0], [0.5, 1]]
)" + soil("[[0, 1], [0.5, 1], [0.5, 4], [0, 4]]", base(R"([["2 s", "3.5 m"], ["2.1 s", "0.5 m"]])")) +
                 stages("4 s", 0.5, 1, "2 s") + sets_step);
  };
  const auto natural = on_marl(""), softer = on_marl("step_material = \"silt\"");
  const auto half = on_marl("step_material = \"silt\"\ncfl = 0.25");
  const auto steps = [](const Simulation<PlaneStrain>& run) { return static_cast<double>(run.state().step); };
  EXPECT_NEAR(steps(*natural) / steps(*softer), 5, 0.1);  // √(500/20)
  EXPECT_NEAR(steps(*half) / steps(*softer), 2, 0.05);
  EXPECT_GT(largest_displacement(natural->state().soil), 1e-4);
  EXPECT_NEAR(largest_displacement(softer->state().soil), largest_displacement(natural->state().soil),
              0.01 * largest_displacement(natural->state().soil));
  EXPECT_NEAR(water_of(*softer), water_of(*natural), 1e-4 * water_of(*natural));
}

TEST(UnsaturatedColumn, DrainedAndWettedAgainReturnsToItsState) {
  const auto start = after(column("3.5", base("\"3.5 m\""), "10 s"));
  const auto drained = after(column("3.5", base(R"([["20 s", "3.5 m"], ["21 s", "0.5 m"]])"), "5000 s"));
  const auto back = after(column(
      "3.5", base(R"([["20 s", "3.5 m"], ["21 s", "0.5 m"], ["5020 s", "0.5 m"], ["5021 s", "3.5 m"]])"), "15000 s"));
  const double full = water_of(*start);
  EXPECT_LT(water_of(*drained), 0.9 * full);
  EXPECT_NEAR(water_of(*back), full, 0.01 * full);
  const auto first = highest_and_lowest_vertical_stress(start->state().soil);
  const auto last = highest_and_lowest_vertical_stress(back->state().soil);
  EXPECT_NEAR(last[1], first[1], 0.01 * std::abs(first[1]));
  for (const double y : {0.625, 1.625, 2.625, 3.625}) {
    EXPECT_NEAR(back->pressure_at({0.25, y, 0}), water_weight * (3.5 - y), 0.01 * water_weight * 3.5) << y;
    EXPECT_NEAR(drained->pressure_at({0.25, y, 0}), water_weight * (0.5 - y), 0.05 * water_weight * 3.5) << y;
  }
}

TEST(UnsaturatedColumn, LetsOutAtItsSeepageFaceWhatDarcyBrings) {
  const auto run = after(column("4", R"([[seepage_boundary]]
name = "base"
line = [[0, 0], [0.5, 0]]
head = [["20 s", "4 m"], ["21 s", "5 m"]]
)",
                                "2000 s"));
  // 1 m of head is lost over 4 m of soil
  const double flux = run->state().grid.discharge[1][run->state().setup.lattice.index(1, 8)];
  EXPECT_NEAR(flux, 5e-4 * 1.0 / 4, 0.02 * 5e-4 / 4);
  EXPECT_NEAR(run->pressure_at({0.25, 2.125, 0}), water_weight * (5 - 2.125 - 2.125 / 4), 0.01 * water_weight * 2);
}

}  // namespace
}  // namespace polder
