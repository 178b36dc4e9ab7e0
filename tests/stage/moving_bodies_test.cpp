// Bodies that move: what they push makes way by exactly as much, what they carry goes with them, and what it costs is
// booked.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "case_text.hpp"
#include "polder/case/wall_motion.hpp"
#include "polder/stage/checkpoint.hpp"
#include "polder/stage/simulation.hpp"
#include "pushed_footing.hpp"

namespace polder {
namespace {

using Sim = Simulation<PlaneStrain>;

template <class Points>
double out_of_bodies(const Sim& run, const Points& points, double spare) {
  const Bodies<PlaneStrain> now = make_bodies(run.model(), run.state().setup.lattice,
                                              std::vector<bool>(run.model().walls.size(), true), run.time());
  double deepest = 0;
  for (std::size_t p = 0; p < points.size(); ++p)
    deepest = std::min(deepest, now.contact({points.position[0][p], points.position[1][p]}).distance);
  EXPECT_GE(deepest, -spare);
  return deepest;
}

TEST(BodyMotion, IsAFunctionOfTime) {
  WallInput wall;
  wall.velocity[0] = {{0, 2, 4}, {0, 1, 1}};
  wall.displacement[1] = {{0, 2}, {0, -0.5}};
  EXPECT_TRUE(moves(wall));
  for (const auto& [t, x, y] : {std::array{-1.0, 0.0, 0.0}, {1.0, 0.25, -0.25}, {2.0, 1.0, -0.5}, {5.0, 4.0, -0.5}}) {
    EXPECT_NEAR(displacement_at(wall, t)[0], x, 1e-15);
    EXPECT_NEAR(displacement_at(wall, t)[1], y, 1e-15);
  }
}

/// A piston of 0.55 m on the left of a channel that is 4 m long and 0.8 m deep.
std::string channel(const std::string& motion, double duration) {
  return fmt::format(R"(
[model]
size = ["4 m", "1.6 m"]
cell = "0.1 m"
[[free_water]]
box = [[0.55, 0], [4, 0.8]]
[[wall]]
name = "piston"
box = [[0, 0], [0.55, 1.5]]
{}
[[monitor]]
name = "piston"
kind = "wall"
wall = "piston"
quantity = "force"
[[stage]]
name = "push"
duration = "{} s"
)",
                     motion, duration);
}

/// Depth of the water by what the cells of a column hold, m, mean over x > `from`.
double depth(const Sim& run, double from) {
  const auto& water = run.state().water;
  double sum = 0;
  for (std::size_t p = 0; p < water.size(); ++p)
    if (water.position[0][p] > from) sum += water.volume[p];
  return sum / (4 - from);
}

TEST(Piston, RaisesTheWaterByWhatItDisplaces) {
  const double way = 0.8, initial = 0.8, length = 4 - 0.55;
  Sim run(read_text(channel(R"(displacement_x = [["0 s", "0 m"], ["16 s", "0.8 m"]])", 20)), 1);
  while (!run.finished()) run.advance();
  const double expected = initial * length / (length - way);
  out_of_bodies(run, run.state().water, 1e-12);
  double behind = 0, highest = 0;
  const auto& water = run.state().water;
  for (std::size_t p = 0; p < water.size(); ++p) {
    if (water.position[0][p] < 0.55 + way) behind += water.volume[p];
    highest = std::max(highest, water.position[1][p]);
  }
  const auto& lattice = run.state().setup.lattice;
  double worst = 0;
  for (int j = 0; j < lattice.cells[1]; ++j)
    for (int i = 0; i < lattice.cells[0]; ++i) {
      const std::ptrdiff_t cell = lattice.index(i, j);
      if (!run.state().grid.wet[cell] || run.state().setup.bodies.own_share(cell) < 1) continue;
      worst = std::max(
          worst, std::abs(run.state().grid.pressure[cell] - 9810 * (expected - (j + 0.5) * 0.1)) / 9810 / expected);
    }
  EXPECT_EQ(behind, 0);
  const double displaced = initial * length * std::log(length / (length - way));  // ∫ depth dx
  EXPECT_NEAR(run.audit().displaced, displaced, 0.01 * displaced);
  EXPECT_LT(run.audit().water_balance_error(run.state()), 1e-12);
  EXPECT_NEAR(depth(run, 0.55 + way), expected, 1e-9);
  EXPECT_LT(worst, 0.02);
  // lifts the water's centre: V (h₁ − h₀)/2
  const double work = 9810 * initial * length * 0.5 * (expected - initial);
  EXPECT_NEAR(run.audit().body_work, work, 0.05 * work);
  EXPECT_NEAR(run.state().body_force[0].water[0], -0.5 * 9810 * expected * expected,
              0.02 * 0.5 * 9810 * expected * expected);
}

TEST(Piston, GoesOnBitForBitAfterResuming) {
  const Model model = read_text(channel(R"(velocity_x = [["0 s", "0 m/s"], ["1 s", "0.3 m/s"]])", 1.5));
  Sim whole(model, 1), resumed(model, 1);
  while (whole.time() < 0.7) whole.advance();
  restore_checkpoint(checkpoint_bytes(whole, OutputState{}, "case"), resumed, "case");
  while (!whole.finished()) whole.advance();
  while (!resumed.finished()) resumed.advance();
  EXPECT_EQ(whole.state().water.position[0], resumed.state().water.position[0]);
  EXPECT_EQ(whole.state().grid.pressure, resumed.state().grid.pressure);
  EXPECT_EQ(whole.audit().body_work, resumed.audit().body_work);
  EXPECT_EQ(whole.state().body_force[0].water[0], resumed.state().body_force[0].water[0]);
}

/// A block in a tank, with forces on it.
std::string tank(const std::string& motion, double duration) {
  return fmt::format(R"(
[model]
size = ["3 m", "2.4 m"]
cell = "0.1 m"
[[free_water]]
box = [[0, 0], [3, 2]]
[[wall]]
name = "block"
box = [[1.13, 0.72], [1.87, 1.28]]
{}
[[monitor]]
name = "block"
kind = "wall"
wall = "block"
quantity = "force"
[[stage]]
name = "still"
duration = "{} s"
)",
                     motion, duration);
}

TEST(Block, AtRestInStillWaterIsCarriedByItsBuoyancyAlone) {
  Sim run(read_text(tank("", 2)), 1);
  while (!run.finished()) run.advance();
  const BodyForce& force = run.state().body_force.at(0);
  const double buoyancy = 9810 * 0.74 * 0.56;
  EXPECT_NEAR(force.water[0], 0, 1e-3 * buoyancy);
  EXPECT_NEAR(force.water[1], buoyancy, 0.01 * buoyancy);
}

TEST(Block, LiftedInWaterLeavesNoCavityAndComesToItsBuoyancyAgain) {
  Sim run(read_text(tank(R"(displacement_upward = [["0 s", "0 m"], ["4 s", "0.4 m"]])", 8)), 1);
  double largest = 0;
  while (!run.finished()) {
    run.advance();
    for (std::size_t p = 0; p < run.state().water.size(); p += 7)
      largest = std::max(largest, std::abs(run.state().water.velocity[1][p]));
  }
  const BodyForce& force = run.state().body_force.at(0);
  const double buoyancy = 9810 * 0.74 * 0.56;
  double highest = 0;
  for (const double y : run.state().water.position[1]) highest = std::max(highest, y);
  const auto& lattice = run.state().setup.lattice;
  int dry = 0;
  for (int j = 0; j < 18; ++j)
    for (int i = 0; i < lattice.cells[0]; ++i) {
      const std::ptrdiff_t cell = lattice.index(i, j);
      dry += run.state().setup.bodies.own_share(cell) > 0 && !run.state().grid.wet[cell];
    }
  EXPECT_EQ(dry, 0);
  EXPECT_NEAR(force.water[1], buoyancy, 0.03 * buoyancy);
  EXPECT_LT(std::abs(force.water[0]), 0.03 * buoyancy);
  EXPECT_LT(std::abs(run.audit().displaced), 0.01 * 0.74 * 0.4);
  out_of_bodies(run, run.state().water, 1e-12);
}

std::string dry_block(const std::string& law, const std::string& body, const std::string& more) {
  return fmt::format(R"(
[model]
size = ["4 m", "2 m"]
cell = "0.1 m"
gravity = "{}"
[[material]]
name = "block"
{}
grain_density = "2650 kg/m3"
porosity = 0.4
grain_diameter = "1 mm"
[[soil]]
material = "block"
{}
[initial]
stress = "none"
{}
)",
                     body.find("gravity") != std::string::npos ? "9.81 m/s2" : "0 m/s2", law, body, more);
}

const std::string stiff = "law = \"linear-elastic\"\nyoung_modulus = \"5 MPa\"\npoisson_ratio = 0.2";

TEST(Plough, GivesSoftSoilItsVelocityAndBooksTheWork) {
  const std::string soft =
      "law = \"tresca\"\nyoung_modulus = \"5 MPa\"\npoisson_ratio = 0.3\nundrained_shear_strength = \"0.5 kPa\"";
  Sim run(read_text(dry_block(soft, "box = [[1, 0.5], [1.5, 1.5]]", R"(
[[wall]]
name = "plough"
box = [[0.43, 0.3], [0.93, 1.7]]
velocity_x = "0.5 m/s"
[[stage]]
name = "push"
duration = "1 s"
)")),
          1);
  while (!run.finished()) run.advance();
  const auto& soil = run.state().soil;
  double momentum = 0, mass = 0, energy = 0;
  for (std::size_t p = 0; p < soil.size(); ++p) {
    momentum += soil.mass[p] * soil.velocity[0][p];
    energy += 0.5 * soil.mass[p] * speed_squared(soil, p);
    mass += soil.mass[p];
  }
  EXPECT_NEAR(momentum / mass, 0.5, 0.03 * 0.5);
  EXPECT_GE(run.audit().body_work, energy);  // no more than it was given
  EXPECT_NEAR(run.audit().body_work, momentum * 0.5, 0.01 * momentum * 0.5);
  out_of_bodies(run, run.state().soil, 1e-12);
}

TEST(Plate, TakesALoadOnItAlongOnlyByFriction) {
  for (const auto& [surface, expected] :
       {std::pair{"soil = \"rough\"", 0.5}, {"friction_angle = \"40 deg\"", 0.5}, {"soil = \"smooth\"", 0.0}}) {
    Sim run(read_text(dry_block(stiff, "box = [[1.5, 0.57], [2.1, 0.87]] # gravity",
                                fmt::format(R"(
[[wall]]
name = "plate"
box = [[0.5, 0.1], [3, 0.57]]
{}
velocity_x = [["0 s", "0 m/s"], ["0.2 s", "0.5 m/s"]]
[[stage]]
name = "settle"
initial = true
damping = "50 1/s"
duration = "0.3 s"
[[stage]]
name = "carry"
duration = "0.4 s"
)",
                                            surface))),
            1);
    while (!run.finished()) run.advance();
    const auto& soil = run.state().soil;
    double momentum = 0, mass = 0;
    for (std::size_t p = 0; p < soil.size(); ++p) momentum += soil.mass[p] * soil.velocity[0][p], mass += soil.mass[p];
    EXPECT_NEAR(momentum / mass, expected, 0.02);
  }
}

TEST(Footing, IsCarriedByItsBearingCapacity) {
  Sim run(pushed_footing("", "poisson_ratio = 0.49\ngrain_diameter = \"1 mm\""), 1);
  const double force = mean_at_the_end(run, [](const Sim& now) { return now.state().body_force[0].soil[1]; });
  // measured: 0.80 of it, with ten cells across the footing
  EXPECT_NEAR(force, bearing_of_clay, 0.25 * bearing_of_clay);
}

}  // namespace
}  // namespace polder
