// Wells and drains against the closed solution of a pipe in a confined layer, and rain against its rate.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "case_text.hpp"
#include "polder/stage/checkpoint.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {
namespace {

constexpr double conductivity = 5e-3, depth = 1, reach = 2.1;

/// Heads of the layer's ends; and its formulation.
const std::string sides = R"([[boundary]]
side = "left"
water = "head"
head = "5 m"
[[boundary]]
side = "right"
water = "head"
head = "5 m"
)";
const std::string sides_of_pores = R"([[seepage_boundary]]
line = [[0, 0], [0, 1]]
head = "5 m"
[[seepage_boundary]]
line = [[4.2, 0], [4.2, 1]]
head = "5 m"
[[seepage_boundary]]
line = [[0, 1], [4.2, 1]]
condition = "closed"
[[retention]]
material = "sand"
model = "van-genuchten"
g_a = "3 1/m"
g_n = 3
)";

/// A confined layer of rigid sand, 1 m thick, with a head of 5 m at its two ends; `cell` must divide 0.2 m oddly.
std::string layer(double cell, const std::string& well, const std::string& ends = sides,
                  const std::string& formulation = "double-point") {
  return fmt::format(R"(
[model]
formulation = "{}"
size = [4.2, 1]
cell = {}
points_per_axis = 2
[[material]]
name = "sand"
law = "linear-elastic"
young_modulus = "1 MPa"
fixed = true
grain_density = "2660 kg/m3"
porosity = 0.34
permeability = "5e-3 m/s"
drag = "darcy"
[[soil]]
material = "sand"
box = [[0, 0], [4.2, 1]]
[initial]
water_table = [[0, 1], [4.2, 1]]
[numerics]
pressure_tolerance = 1e-9
[[stage]]
name = "flow"
duration = "0.3 s"
{}[[well]]
at = [[2.1, 0.5]]
{})",
                     formulation, cell, ends, well);
}

const std::string gravel = R"([[material]]
name = "gravel"
law = "linear-elastic"
young_modulus = "1 MPa"
fixed = true
grain_density = "2660 kg/m3"
porosity = 0.4
permeability = "5e-2 m/s"
drag = "darcy"
)";

template <class Space>
double total(const Simulation<Space>& run) {
  double sum = 0;
  for (const double v : run.state().water.volume) sum += v;
  return sum;
}

/// m²/s out of the well over the second half of the run, by what was booked in its cell.
double discharge_of(const Model& model) {
  Simulation<PlaneStrain> run(model, 1);
  const std::ptrdiff_t cell = run.state().setup.wells.at(0).cells.at(0);
  double volume = 0, from = -1, to = 0;
  while (!run.finished()) {
    const double before = run.time();
    run.advance();
    if (run.time() < 0.15) continue;
    if (from < 0) from = before;
    to = run.time();
    for (const Exchange& e : run.state().exchanged)
      if (e.cell == cell) volume -= e.volume;
  }
  EXPECT_LT(run.audit().water_balance_error(run.state()), 1e-12);
  EXPECT_LT(run.audit().overfilled_now, 0.02);
  return volume / (to - from);
}

/// A row of image wells at the distance of the layer's depth.
double exact(double difference, double radius) {
  return difference / (reach / (2 * conductivity * depth) +
                       std::log(depth / (2 * std::numbers::pi * radius)) / (2 * std::numbers::pi * conductivity));
}

TEST(Well, AtAHeadTakesWhatTheLayerGives) {
  for (const double radius : {0.005, 0.02}) {
    const double taken = discharge_of(read_text(layer(0.2, fmt::format("head = \"3 m\"\nradius = {}\n", radius))));
    EXPECT_NEAR(taken, exact(2, radius), 0.02 * exact(2, radius)) << radius;
  }
}

TEST(Well, GivesWaterWhereItsHeadIsHigher) {
  const double given = -discharge_of(read_text(layer(0.2, "head = \"7 m\"\nradius = \"2 cm\"\nonly_takes = false\n")));
  EXPECT_NEAR(given, exact(2, 0.02), 0.02 * exact(2, 0.02));
}

TEST(Well, ThatOnlyTakesGivesNothing) {
  EXPECT_EQ(discharge_of(read_text(layer(0.2, "head = \"7 m\"\nradius = \"2 cm\"\n"))), 0);
}

TEST(Well, OfAGivenDischargeTakesItToTheDrop) {
  for (const double q : {6e-3, -6e-3})
    EXPECT_NEAR(discharge_of(read_text(layer(0.2, fmt::format("discharge = {}\n", q)))), q, 1e-12);
}

TEST(Well, TakesAsMuchFromSoilThatCarriesItsWater) {
  const auto taken = [](const std::string& well) {
    return discharge_of(read_text(layer(0.2, well, sides_of_pores, "unsaturated")));
  };
  EXPECT_NEAR(taken("head = \"3 m\"\nradius = \"2 cm\"\n"), exact(2, 0.02), 0.02 * exact(2, 0.02));
  EXPECT_NEAR(-taken("head = \"7 m\"\nradius = \"2 cm\"\nonly_takes = false\n"), exact(2, 0.02), 0.02 * exact(2, 0.02));
  EXPECT_NEAR(taken("discharge = 6e-3\n"), 6e-3, 1e-12);
  EXPECT_EQ(taken("head = \"7 m\"\nradius = \"2 cm\"\n"), 0);
  const double single =
      discharge_of(read_text(layer(0.2, "head = \"3 m\"\nradius = \"2 cm\"\n", sides, "single-point")));
  EXPECT_NEAR(single, exact(2, 0.02), 0.02 * exact(2, 0.02));
}

TEST(Well, InASolidTakesAsMuchPerMetre) {
  const std::string text = R"(
[model]
space = "3d"
size = [4.2, 1, 0.6]
cell = 0.2
[[material]]
name = "sand"
law = "linear-elastic"
young_modulus = "1 MPa"
fixed = true
grain_density = "2660 kg/m3"
porosity = 0.34
permeability = "5e-3 m/s"
drag = "darcy"
[[soil]]
material = "sand"
box = [[0, 0, 0], [4.2, 1, 0.6]]
[initial]
water_table = [[0, 0.6], [4.2, 0.6]]
[[stage]]
name = "flow"
duration = "0.2 s"
[[boundary]]
side = "left"
water = "head"
head = "5 m"
[[boundary]]
side = "right"
water = "head"
head = "5 m"
[[well]]
at = [[2.1, 0.5, 0], [2.1, 0.5, 0.6]]
head = "3 m"
radius = "2 cm"
)";
  Simulation<Solid> run(read_text(text), 1);
  const auto& well = run.state().setup.wells.at(0);
  EXPECT_EQ(well.cells.size(), 3u);
  double volume = 0, time = 0;
  while (!run.finished()) {
    const double before = run.time();
    run.advance();
    if (before < 0.1) continue;
    time += run.time() - before;
    for (const Exchange& e : run.state().exchanged)
      if (std::count(well.cells.begin(), well.cells.end(), e.cell) > 0) volume -= e.volume;
  }
  EXPECT_NEAR(volume / time / 0.6, exact(2, 0.02), 0.02 * exact(2, 0.02));
}

TEST(Well, GoesOnAfterResuming) {
  const Model model = read_text(layer(0.2, "head = \"3 m\"\nradius = \"2 cm\"\n"));
  Simulation<PlaneStrain> through(model, 1), resumed(model, 1);
  while (through.time() < 0.1) through.advance();
  restore_checkpoint(checkpoint_bytes(through, {}, "well"), resumed, "well");
  while (!through.finished()) through.advance(), resumed.advance();
  EXPECT_EQ(through.state().water.volume, resumed.state().water.volume);
  EXPECT_EQ(through.state().water.position[0], resumed.state().water.position[0]);
}

TEST(Drain, LowersTheWaterTableToItsOwn) {
  const Model model = read_text(R"(
[model]
size = [1, 0.8]
cell = 0.05
)" + gravel + R"([[soil]]
material = "gravel"
box = [[0, 0], [1, 0.8]]
[initial]
water_table = [[0, 0.6], [1, 0.6]]
[[well]]
name = "slot"
at = [[0.525, 0], [0.525, 0.4]]
head = "0.3 m"
[[stage]]
name = "drain"
duration = "12 s"
)");
  Simulation<PlaneStrain> run(model, 1);
  while (!run.finished()) run.advance();
  EXPECT_NEAR(total(run), 0.4 * 0.3, 0.05 * 0.4 * 0.3);
  EXPECT_LT(run.audit().water_balance_error(run.state()), 1e-12);
  for (const double x : {0.1, 0.9}) EXPECT_NEAR(run.pressure_at({x, 0.125, 0}), 9810 * 0.175, 0.1 * 9810 * 0.175);
}

TEST(Rain, FillsAPondAtItsRate) {
  const auto pond = [](const std::string& rain) {
    return read_text(R"(
[model]
size = [1, 0.5]
cell = 0.05
[[free_water]]
box = [[0, 0], [1, 0.2]]
[[stage]]
name = "rain"
duration = "2 s"
)" + rain);
  };
  Simulation<PlaneStrain> run(pond("[[rain]]\nrate = \"0.03 m/s\"\n"), 1);
  while (!run.finished()) run.advance();
  const double parcel = 0.125 * 0.025 * 0.025;
  EXPECT_NEAR(total(run) - 0.2, 0.03 * 2, 20 * parcel);
  EXPECT_LT(run.audit().water_balance_error(run.state()), 1e-12);
  EXPECT_NEAR(run.pressure_at({0.5, 0.025, 0}), 9810 * (0.26 - 0.025), 0.1 * 9810 * 0.26);

  Simulation<PlaneStrain> half(pond("[[rain]]\nrate = [[0, 0], [2, 0.06]]\nspan = [0.225, 0.725]\n"), 1);
  while (!half.finished()) half.advance();
  EXPECT_NEAR(total(half) - 0.2, 0.03 * 2 * 0.5, 0.02 * 0.03 * 2 * 0.5 + 11 * parcel);
}

TEST(Rain, ThatIsNegativeDriesAPondAndLeavesWaterUnderTheGround) {
  const auto model = [](const std::string& water) {
    return read_text(R"(
[model]
size = [1, 0.6]
cell = 0.05
)" + gravel + R"([[soil]]
material = "gravel"
box = [[0, 0], [1, 0.3]]
[[rain]]
name = "drought"
rate = "-10 mm/s"
[[stage]]
name = "event"
duration = "2 s"
)" + water);
  };
  const double parcel = 0.125 * 0.025 * 0.025;
  Simulation<PlaneStrain> pond(model("[initial]\nwater_table = [[0, 0.3], [1, 0.3]]\n"
                                     "[[free_water]]\nbox = [[0, 0.3], [1, 0.45]]\n"),
                               1);
  const double before = total(pond);
  while (!pond.finished()) pond.advance();
  EXPECT_NEAR(before - total(pond), 0.01 * 2, 20 * parcel);
  EXPECT_NEAR(pond.audit().water_out, before - total(pond), 1e-12);
  EXPECT_LT(pond.audit().water_balance_error(pond.state()), 1e-12);
  EXPECT_NEAR(pond.pressure_at({0.5, 0.025, 0}), 9810 * (0.45 - 0.02 - 0.025), 0.03 * 9810 * 0.4);

  // soil dries until its uppermost cells are no longer wet, half of their water being gone
  Simulation<PlaneStrain> ground(model("[initial]\nwater_table = [[0, 0.3], [1, 0.3]]\n"), 1);
  const double full = total(ground);
  while (!ground.finished()) ground.advance();
  EXPECT_NEAR(full - total(ground), 0.5 * 0.05 * 0.4, 0.15 * 0.05 * 0.4);

  Simulation<PlaneStrain> deep(model("[initial]\nwater_table = [[0, 0.15], [1, 0.15]]\n"), 1);
  const double stored = total(deep);
  while (!deep.finished()) deep.advance();
  EXPECT_EQ(total(deep), stored);
}

TEST(Rain, SeepsIntoDryGravel) {
  Simulation<PlaneStrain> run(read_text(R"(
[model]
size = [0.5, 0.6]
cell = 0.05
)" + gravel + R"([[soil]]
material = "gravel"
box = [[0, 0], [0.5, 0.4]]
[[rain]]
rate = "5 mm/s"
[[stage]]
name = "rain"
duration = "8 s"
)"),
                              1);
  while (!run.finished()) run.advance();
  EXPECT_NEAR(total(run), 5e-3 * 8 * 0.5, 10 * 0.125 * 0.025 * 0.025);
  double lowest = 1, below = 0;
  const auto& water = run.state().water;
  for (std::size_t p = 0; p < water.size(); ++p) {
    lowest = std::min(lowest, water.position[1][p]);
    if (water.position[1][p] < 0.2) below += water.volume[p];
  }
  EXPECT_LT(lowest, 0.05);
  EXPECT_GT(below, 0.6 * total(run));
}

}  // namespace
}  // namespace polder
