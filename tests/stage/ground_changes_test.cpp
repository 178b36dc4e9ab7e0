// Soil that is excavated, placed and converted as stages begin: masses are booked, and what stays is at rest.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "case_text.hpp"
#include "polder/stage/checkpoint.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {
namespace {

/// 2 m × 0.6 m of saturated soil in a box, three stages of 0.1 s, and what the test adds.
std::string ground(const std::string& changes, const std::string& model = "",
                   const std::string& permeability = "1e-4") {
  return fmt::format(R"(
[model]
size = ["2 m", "1.2 m"]
cell = "0.1 m"
{}
[[material]]
name = "sand"
law = "mohr-coulomb"
young_modulus = "10 MPa"
poisson_ratio = 0.3
friction_angle = "35 deg"
cohesion = "5 kPa"
grain_density = "2650 kg/m3"
porosity = 0.4
permeability = "{} m/s"
[[material]]
name = "clay"
law = "modified-cam-clay"
friction_angle = "25 deg"
compression_index = 0.1
swelling_index = 0.02
poisson_ratio = 0.3
preconsolidation_pressure = "50 kPa"
grain_density = "2700 kg/m3"
porosity = 0.5
max_porosity = 0.7
permeability = "1e-6 m/s"
[[soil]]
material = "sand"
box = [["0 m", "0 m"], ["2 m", "0.6 m"]]
[initial]
water_table = [["0 m", "0.6 m"], ["2 m", "0.6 m"]]
[[stage]]
name = "before"
duration = "0.1 s"
damping = "20 1/s"
[[stage]]
name = "change"
duration = "0.1 s"
damping = "20 1/s"
[[stage]]
name = "after"
duration = "0.1 s"
damping = "20 1/s"
{})",
                     model, permeability, changes);
}

double sum(const Array& values) {
  double total = 0;
  for (const double v : values) total += v;
  return total;
}

struct Books {
  double mass, water;
};
Books books_of(const Simulation<PlaneStrain>& run) {
  return {sum(run.state().soil.mass), sum(run.state().water.volume)};
}

/// Runs into stage number `stage` by a step's less than nothing: until it has begun.
void begin(Simulation<PlaneStrain>& run, std::uint64_t stage) {
  while (run.stage_number() < stage) run.advance();
}

void expect_balanced(const Simulation<PlaneStrain>& run) {
  EXPECT_LT(run.audit().solid_mass_error(run.state()), 1e-13);
  EXPECT_LT(run.audit().water_balance_error(run.state()), 1e-13);
}

const std::string cut = "[[change]]\nstage = \"change\"\naction = \"excavate\"\nbox = [[1, 0.4], [2, 0.6]]\n";

TEST(Excavation, TakesSoilAndItsWater) {
  Simulation<PlaneStrain> run(read_text(ground(cut)), 1);
  const Books before = books_of(run);
  begin(run, 1);
  const Books after = books_of(run);
  const double volume = 1 * 0.2;
  EXPECT_NEAR(before.mass - after.mass, 0.6 * 2650 * volume, 1e-3 * before.mass);
  EXPECT_NEAR(before.water - after.water, 0.4 * volume, 1e-3 * before.water);
  EXPECT_NEAR(run.audit().solid_out, before.mass - after.mass, 1e-12 * before.mass);
  for (std::size_t p = 0; p < run.state().soil.size(); ++p)
    EXPECT_FALSE(run.state().soil.position[0][p] > 1 && run.state().soil.position[1][p] > 0.4);
  while (!run.finished()) run.advance();
  expect_balanced(run);
}

TEST(Excavation, LeavesTheWaterOrReplacesTheGrains) {
  Simulation<PlaneStrain> leaves(read_text(ground(cut + "water = \"leave\"\n")), 1);
  const Books before = books_of(leaves);
  begin(leaves, 1);
  EXPECT_EQ(books_of(leaves).water, before.water);
  Simulation<PlaneStrain> dredged(read_text(ground(cut + "water = \"replace\"\n", "", "1e-3")), 1);
  begin(dredged, 1);
  EXPECT_NEAR(books_of(dredged).water - before.water, 0.6 * 0.2, 0.01 * 0.2);
  while (!dredged.finished()) dredged.advance();
  expect_balanced(dredged);
  // the pit is full of water at the level that the ground had
  double fill = 0;
  for (int i = 11; i < 19; ++i) fill += dredged.state().grid.fill[dredged.state().setup.lattice.index(i, 4)] / 8;
  EXPECT_NEAR(fill, 1, 0.02);
  EXPECT_NEAR(dredged.pressure_at({1.5, 0.05, 0}), 9810 * 0.55, 0.02 * 9810 * 0.55);
}

TEST(Excavation, UnloadsWhatIsBelow) {
  Simulation<PlaneStrain> run(read_text(ground("[[change]]\nstage = \"change\"\naction = \"excavate\"\n"
                                               "water = \"replace\"\nbox = [[0, 0.3], [2, 0.6]]\n",
                                               "", "1e-3")),
                              1);
  while (!run.finished()) run.advance();
  double stress = 0, exact = 0;
  const auto& soil = run.state().soil;
  for (std::size_t p = 0; p < soil.size(); ++p) {
    stress += soil.stress[1][p];
    exact -= 0.6 * 1650 * 9.81 * (0.3 - soil.position[1][p]);
  }
  EXPECT_NEAR(stress, exact, 0.05 * std::abs(exact));
  expect_balanced(run);
}

TEST(Placement, FillsTheRegionAtRestWithItsOwnStress) {
  Simulation<PlaneStrain> run(
      read_text(ground("[[change]]\nstage = \"change\"\naction = \"place\"\nmaterial = \"clay\"\n"
                       "box = [[0, 0.5], [2, 0.8]]\n")),  // its lowest row is soil already
      1);
  begin(run, 1);
  const auto& soil = run.state().soil;
  std::size_t placed = 0;
  for (std::size_t p = 0; p < soil.size(); ++p) {
    if (soil.material[p] != 1) continue;
    ++placed;
    EXPECT_GT(soil.position[1][p], 0.6);
    EXPECT_NEAR(soil.stress[1][p], -0.5 * 2700 * 9.81 * (0.8 - soil.position[1][p]), 1e-6);
    EXPECT_NEAR(soil.mass[p], 0.5 * 2700 * 0.05 * 0.05, 1e-9);
  }
  EXPECT_EQ(placed, 40u * 4);
  EXPECT_NEAR(run.audit().solid_in, 0.5 * 2700 * 2 * 0.2, 1e-6);
  while (!run.finished()) run.advance();
  expect_balanced(run);
  double least = 0, most = 0;
  for (const double v : soil.velocity[1]) least = std::min(least, v), most = std::max(most, v);
  EXPECT_GT(least, -0.05);
  EXPECT_LT(most, 0.05);
  // the load of 2.6 kPa has come on the sand below, which is undrained in this time: its water carries it
  EXPECT_GT(run.pressure_at({1, 0.05, 0}), 9810 * 0.55 + 1000);
}

TEST(Placement, UnderWaterTakesTheGrainsPlace) {
  const std::string sea = "[[free_water]]\nbox = [[0, 0.6], [2, 1]]\n";
  Simulation<PlaneStrain> run(
      read_text(ground(sea + "[[change]]\nstage = \"change\"\naction = \"place\"\nmaterial = \"sand\"\n"
                             "box = [[0, 0.6], [2, 0.8]]\n")),
      1);
  const Books before = books_of(run);
  begin(run, 1);
  EXPECT_NEAR(before.water - books_of(run).water, 0.6 * 0.4, 0.01 * 0.4);
  while (!run.finished()) run.advance();
  expect_balanced(run);
  EXPECT_LT(run.audit().overfilled_now, 0.02);
}

TEST(Conversion, KeepsVolumeStressAndWaterAndBooksTheMass) {
  Simulation<PlaneStrain> run(
      read_text(ground("[[change]]\nstage = \"change\"\naction = \"convert\"\nmaterial = \"clay\"\n"
                       "box = [[0, 0], [1, 0.6]]\n")),
      1);
  begin(run, 1);
  const auto& soil = run.state().soil;
  for (std::size_t p = 0; p < soil.size(); ++p) EXPECT_EQ(soil.material[p], soil.position[0][p] < 1 ? 1 : 0);
  EXPECT_NEAR(run.audit().solid_in, 0.6 * 50 * 1 * 0.6, 1e-3);
  while (!run.finished()) run.advance();
  expect_balanced(run);
}

TEST(GroundChanges, GoOnAfterResuming) {
  const Model model = read_text(ground(cut + "[[change]]\nstage = \"after\"\naction = \"place\"\nmaterial = \"sand\"\n"
                                             "box = [[1, 0.4], [2, 0.7]]\n"));
  for (const double at : {0.05, 0.1, 0.15, 0.2, 0.25}) {
    Simulation<PlaneStrain> through(model, 1), resumed(model, 1);
    while (through.time() < at - 1e-9) through.advance();
    restore_checkpoint(checkpoint_bytes(through, {}, "dig"), resumed, "dig");
    while (!through.finished()) {
      through.advance();
      resumed.advance();
    }
    EXPECT_TRUE(resumed.finished());
    EXPECT_EQ(through.state().soil.id, resumed.state().soil.id);
    for (int a = 0; a < 2; ++a) {
      EXPECT_EQ(through.state().soil.position[a], resumed.state().soil.position[a]) << "resumed at " << at;
      EXPECT_EQ(through.state().water.position[a], resumed.state().water.position[a]) << "resumed at " << at;
    }
    EXPECT_EQ(through.audit().solid_mass_error(through.state()), resumed.audit().solid_mass_error(resumed.state()));
  }
}

TEST(GroundChanges, OfASinglePointModelCarryTheirWater) {
  Simulation<PlaneStrain> run(
      read_text(ground(cut + "[[change]]\nstage = \"after\"\naction = \"place\"\nmaterial = \"sand\"\n"
                             "box = [[1, 0.4], [2, 0.6]]\n",
                       "formulation = \"single-point\"")),
      1);
  begin(run, 2);
  for (const auto saturated : run.state().soil.saturated) EXPECT_EQ(saturated, 1);
  while (!run.finished()) run.advance();
  expect_balanced(run);
}

TEST(ThinWall, IsPutInWithItsStage) {
  const Model model =
      read_text(ground("[[wall]]\nline = [[1, 0], [1, 1.2]]\nfrom_stage = \"change\"\nuntil_stage = \"after\"\n"));
  Simulation<PlaneStrain> run(model, 1);
  const auto stands = [&] { return run.state().setup.walls.blocked(0, run.state().setup.lattice.index(10, 3)); };
  EXPECT_FALSE(stands());
  begin(run, 1);
  EXPECT_TRUE(stands());
  begin(run, 2);
  EXPECT_FALSE(stands());
}

}  // namespace
}  // namespace polder
