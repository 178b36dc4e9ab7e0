// Free water on unsaturated ground: it seeps in, comes out, rains and evaporates, and no water is lost.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numeric>

#include "case_text.hpp"
#include "largest_displacement.hpp"
#include "polder/stage/checkpoint.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {
namespace {

constexpr double conductivity = 0.01, porosity = 0.4, height = 1, width = 0.2;  // SI

/// A column of soil 1 m high under van Genuchten's curve, wet to `table`, m, and what is on and under it.
class Column {
 public:
  Column(double table, const std::string& rest)
      : run_(read_text(fmt::format(R"(
[model]
size = ["0.2 m", "2 m"]
cell = "0.05 m"
formulation = "unsaturated"
[[material]]
name = "sand"
law = "linear-elastic"
young_modulus = "50 MPa"
poisson_ratio = 0.3
grain_density = "2650 kg/m3"
porosity = 0.4
permeability = "0.01 m/s"
permeability_exponent = 0
drag = "darcy"
[[retention]]
material = "sand"
model = "van-genuchten"
g_a = "4 1/m"
g_n = 2
residual = 0
[[soil]]
material = "sand"
box = [["0 m", "0 m"], ["0.2 m", "1 m"]]
[initial]
water_table = [["0 m", "{0} m"], ["0.2 m", "{0} m"]]
stress = "k0"
k0 = 0.5
[[boundary]]
side = "base"
soil = "rough"
[numerics]
step_stretch = 1000
[[stage]]
name = "event"
duration = "200 s"
local_damping = 0.7
{1}
)",
                                   table, rest)),
             1) {}

  void run_to(double time) {
    while (run_.time() < time && !run_.finished()) run_.advance();
  }
  double pond() const { return std::accumulate(state().water.volume.begin(), state().water.volume.end(), 0.0) / width; }
  double balance() const { return run_.audit().water_balance_error(state()); }
  const Simulation<PlaneStrain>& run() const { return run_; }
  const Stepper<PlaneStrain>& state() const { return run_.state(); }

 private:
  Simulation<PlaneStrain> run_;
};

std::string pond_to(double level) {
  return fmt::format("[[free_water]]\nbox = [[\"0 m\", \"1 m\"], [\"0.2 m\", \"{} m\"]]\n", level);
}

std::string base_head(double head) {
  return fmt::format(
      "[[seepage_boundary]]\nname = \"base\"\nline = [[\"0 m\", \"0 m\"], [\"0.2 m\", \"0 m\"]]\nhead = \"{} m\"\n",
      head);
}

// What is missing in the pores over the water table: n ∫ (1 − S) dψ, with S = (1 + (g_a ψ)²)^(−1/2).
TEST(OpenWater, FillsThePoresUnderAPondAndLeavesTheRest) {
  Column column(0.5, pond_to(1.15));
  column.run_to(200);
  const double missing = porosity * (0.5 - std::asinh(4 * 0.5) / 4);
  EXPECT_NEAR(column.pond(), 0.15 - missing, 0.01 * missing);
  const double base = column.run().pressure_at({0.1, 1e-6, 0});
  EXPECT_NEAR(base, 9810 * (1 + column.pond()), 0.01 * 9810);
  EXPECT_LT(column.balance(), 1e-12);
}

// q = K (H − h)/L into a pond of depth h over the soil, dh/dt = q
TEST(OpenWater, RisesWhereAHeadUnderTheGroundDrivesItOut) {
  Column column(1, pond_to(1.2) + base_head(1.7));
  column.run_to(10);
  const double head = 0.5 * std::exp(-conductivity / height * 10);
  EXPECT_NEAR(column.pond(), 0.7 - head, 0.03 * (0.5 - head));
  EXPECT_LT(column.balance(), 1e-12);
}

// d(L + h)/dt = −K (L + h)/L
TEST(OpenWater, SeepsAwayIntoGroundThatDrains) {
  Column column(1, pond_to(1.3) + base_head(0));
  column.run_to(20);
  EXPECT_NEAR(column.pond(), 1.3 * std::exp(-conductivity / height * 20) - 1, 0.02 * 0.3);
  column.run_to(60);  // it is gone after ln 1.3 / K = 26 s
  EXPECT_EQ(column.pond(), 0);
  EXPECT_LT(column.balance(), 1e-12);
}

std::string rain(double rate) { return fmt::format("[[rain]]\nrate = \"{} m/s\"\n", rate); }

// dh/dt = R − K (1 + h/L)
TEST(OpenWater, PondsWhereItRainsMoreThanTheGroundTakes) {
  Column column(1, rain(2 * conductivity) + base_head(0));
  column.run_to(20);
  EXPECT_NEAR(column.pond(), 1 - std::exp(-conductivity / height * 20), 0.01);
  EXPECT_LT(column.balance(), 1e-12);
}

TEST(OpenWater, DoesNotPondWhereTheGroundTakesTheRain) {
  Column column(0.5, rain(0.5 * conductivity) + base_head(0.5));
  column.run_to(60);
  EXPECT_EQ(column.state().water.size(), 0u);
  double out = 0;  // as much leaves by the base
  for (const Exchange& exchange : column.state().exchanged) out -= std::min(0.0, exchange.volume);
  double in = 0;
  for (const Exchange& exchange : column.state().exchanged) in += std::max(0.0, exchange.volume);
  EXPECT_NEAR(out, in, 0.01 * in);
  EXPECT_LT(column.balance(), 1e-12);
}

TEST(OpenWater, EvaporatesFromThePondFirst) {
  Column column(1, pond_to(1.2) + rain(-1e-3));
  column.run_to(100);
  EXPECT_NEAR(column.pond(), 0.1, 2e-3);
  column.run_to(200);  // and when it is gone, from the ground
  EXPECT_LT(column.pond(), 2e-3);
  EXPECT_LT(column.balance(), 1e-12);
}

/// A river of 1 m beside a bank of 1 : 2.
std::string bank(const std::string& water, double table = 1.25) {
  return fmt::format(R"(
[model]
size = ["6 m", "2 m"]
cell = "0.125 m"
formulation = "unsaturated"
[[material]]
name = "sand"
law = "mohr-coulomb"
young_modulus = "20 MPa"
poisson_ratio = 0.3
friction_angle = "35 deg"
cohesion = "1 kPa"
grain_density = "2650 kg/m3"
porosity = 0.4
permeability = "1e-3 m/s"
[[retention]]
material = "sand"
model = "van-genuchten"
g_a = "4 1/m"
g_n = 2
residual = 0
[[soil]]
material = "sand"
polygon = [["0 m", "0 m"], ["6 m", "0 m"], ["6 m", "1.75 m"], ["5 m", "1.75 m"], ["2.5 m", "0.5 m"], ["0 m", "0.5 m"]]
[initial]
water_table = [["0 m", "{1} m"], ["6 m", "{1} m"]]
stress = "k0"
[[boundary]]
side = "base"
soil = "rough"
[numerics]
step_stretch = 1000
[[stage]]
name = "rest"
duration = "4 s"
initial = true
local_damping = 0.7
water_damping = "10 1/s"
hold_water = true
[[stage]]
name = "settle"
duration = "3 s"
initial = true
local_damping = 0.7
water_damping = "10 1/s"
[[stage]]
name = "event"
duration = "4 s"
local_damping = 0.7
{0}
)",
                     water, table);
}

const std::string river = "[[free_water]]\nbox = [[\"0 m\", \"0 m\"], [\"4 m\", \"1.25 m\"]]\n";

std::unique_ptr<Simulation<PlaneStrain>> after(const std::string& text, int threads = 1) {
  auto run = std::make_unique<Simulation<PlaneStrain>>(read_text(text), threads);
  while (!run->finished()) run->advance();
  EXPECT_LT(run->audit().water_balance_error(run->state()), 1e-12);
  return run;
}

double fastest(const WaterPoints<PlaneStrain>& water) {
  double most = 0;
  for (std::size_t p = 0; p < water.size(); ++p) most = std::max(most, speed_squared(water, p));
  return std::sqrt(most);
}

TEST(OpenWater, StaysAtRestBesideABank) {
  const auto run = after(bank(river));
  EXPECT_GT(run->state().water.size(), 500u);
  EXPECT_LT(fastest(run->state().water), 2e-4);
  EXPECT_LT(largest_displacement(run->state().soil), 1e-5);
  EXPECT_NEAR(run->pressure_at({1, 0.75, 0}), 9810 * 0.5, 0.01 * 9810);
  EXPECT_NEAR(run->pressure_at({1, 0.25, 0}), 9810 * 1.0, 0.01 * 9810);
}

TEST(OpenWater, LeavesAGentleSlopeOfWeakSandInPlace) {
  // its points lie in steps, and the water's level in the middle of a cell; nothing damps the water in the event
  const auto run = after(R"(
[model]
size = ["2.4 m", "1.2 m"]
cell = "0.1 m"
formulation = "unsaturated"
[[material]]
name = "sand"
law = "mohr-coulomb"
young_modulus = "10 MPa"
poisson_ratio = 0.3
friction_angle = "33 deg"
cohesion = "0.3 kPa"
dilatancy_angle = "0 deg"
grain_density = "2650 kg/m3"
porosity = 0.4
permeability = "5e-3 m/s"
[[retention]]
material = "sand"
model = "van-genuchten"
g_a = "4 1/m"
g_n = 3
residual = 0.1
[[soil]]
material = "sand"
polygon = [["0 m", "0 m"], ["2.4 m", "0 m"], ["2.4 m", "1 m"], ["1.8 m", "0.8 m"], ["0.8 m", "0.4 m"], ["0 m", "0.4 m"]]
[[free_water]]
box = [["0 m", "0.4 m"], ["2.4 m", "0.75 m"]]
[initial]
water_table = [["0 m", "0.75 m"], ["2.4 m", "0.75 m"]]
[[boundary]]
side = "base"
soil = "rough"
[numerics]
step_stretch = 1000
[[stage]]
name = "rest"
duration = "4 s"
initial = true
local_damping = 0.8
hold_water = true
[[stage]]
name = "event"
duration = "3 s"
)");
  EXPECT_LT(fastest(run->state().water), 2e-2);
  EXPECT_LT(largest_displacement(run->state().soil), 3e-5);
}

TEST(OpenWater, PressesOnTheGroundAsAGivenHeadDoes) {
  const auto free = after(bank(river));
  const auto head = after(bank(
      "[[seepage_boundary]]\nname = \"river\"\nline = [[\"0 m\", \"0.5 m\"], [\"2.5 m\", \"0.5 m\"], [\"5 m\", \"1.75 "
      "m\"]]\nhead = \"1.25 m\"\n"));
  const auto &a = free->state().soil, &b = head->state().soil;
  ASSERT_EQ(a.size(), b.size());
  double largest = 0, difference = 0;
  for (std::size_t p = 0; p < a.size(); ++p) {
    if (a.position[1][p] > 0.3) continue;  // two cells and more under the river's bed
    ASSERT_EQ(a.id[p], b.id[p]);
    largest = std::max(largest, std::abs(b.stress[1][p]));
    difference = std::max(difference, std::abs(a.stress[1][p] - b.stress[1][p]));
  }
  EXPECT_LT(difference, 0.03 * largest);
}

TEST(OpenWater, ContinuesBitForBitAndForAnyNumberOfThreads) {
  const std::string text = bank(
      "[[boundary]]\nname = \"river\"\nregion = [[\"0 m\", \"0.5 m\"], [\"1 m\", \"0.5 m\"], [\"1 m\", \"2 m\"], [\"0 "
      "m\", \"2 m\"]]\nwater = "
      "\"reservoir\"\nhead = [[\"0 s\", \"0.75 m\"], [\"2 s\", \"1.5 m\"]]\n[[rain]]\nrate = \"100 mm/h\"\n",
      0.6);
  const Model model = read_text(text);
  Simulation<PlaneStrain> whole(model, 1), two(model, 2), first(model, 1), second(model, 1);
  const auto to = [](Simulation<PlaneStrain>& run, double time) {
    while (run.time() < time) run.advance();
  };
  to(first, 0.2);
  const OutputState output;
  const std::string bytes = checkpoint_bytes(first, output, "case");
  restore_checkpoint(bytes, second, "case");
  for (auto* run : {&whole, &two, &second}) to(*run, 0.4);
  for (const auto* other : {&two, &second}) {
    ASSERT_EQ(whole.state().water.size(), other->state().water.size());
    for (int c = 0; c < 2; ++c) {
      EXPECT_EQ(whole.state().water.position[c], other->state().water.position[c]);
      EXPECT_EQ(whole.state().soil.velocity[c], other->state().soil.velocity[c]);
    }
    EXPECT_EQ(whole.state().soil.water, other->state().soil.water);
  }
  EXPECT_GT(whole.state().water.size(), 100u);
}

}  // namespace
}  // namespace polder
