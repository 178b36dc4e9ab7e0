// Bodies that do not follow the grid: water at rest over sloping beds stays at rest, with the pressure of still water,
// and none passes through a body.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "case_text.hpp"
#include "polder/stage/simulation.hpp"
#include "sliding_block.hpp"

namespace polder {
namespace {

struct Still {
  double speed = 0;     // m/s, fastest water point at the end
  double pressure = 0;  // largest error of a wet cell, of ρ g H
  double volume = 0;    // of water in the model against what the bodies leave open below the level, relative
};

Still over_bed(const std::string& bed, double level, double open, const std::string& more = "") {
  const Model model = read_text(fmt::format(R"(
[model]
size = ["4 m", "1.6 m"]
cell = "0.1 m"
[[free_water]]
box = [[0, 0], [4, {1}]]
[[wall]]
polygon = {0}
[[stage]]
name = "rest"
duration = "10 s"
{2}
)",
                                            bed, level, more));
  Simulation<PlaneStrain> run(model, 1);
  while (!run.finished()) run.advance();
  const auto& state = run.state();
  const auto& lattice = state.setup.lattice;
  Still still;
  for (std::size_t p = 0; p < state.water.size(); ++p) {
    still.speed = std::max(still.speed, std::hypot(state.water.velocity[0][p], state.water.velocity[1][p]));
    still.volume += state.water.volume[p];
  }
  still.volume = still.volume / open - 1;
  for (int j = 0; j < lattice.cells[1]; ++j)
    for (int i = 0; i < lattice.cells[0]; ++i) {
      const std::ptrdiff_t cell = lattice.index(i, j);
      if (!state.grid.wet[cell]) continue;
      const double exact = level - (j + 0.5) * lattice.spacing[1];
      still.pressure = std::max(still.pressure, std::abs(state.grid.pressure[cell] / 9810 - exact) / level);
    }
  return still;
}

TEST(SlopingBed, OfFivePercentKeepsWaterAtRest) {
  const Still still = over_bed("[[0, 0], [4, 0], [4, 0.2]]", 1.0, 4 - 0.4);
  EXPECT_LT(still.speed, 1e-5);
  EXPECT_LT(still.pressure, 1e-3);
  EXPECT_NEAR(still.volume, 0, 1e-3);
}

TEST(SlopingBed, OfThirtyDegreesKeepsWaterAtRest) {
  const double rise = 2 * std::tan(std::acos(-1.0) / 6);
  const Still still = over_bed(fmt::format("[[0, 0], [2, 0], [0, {}]]", rise), 1.3, 4 * 1.3 - rise);
  EXPECT_LT(still.speed, 1e-5);
  EXPECT_LT(still.pressure, 1e-3);
  EXPECT_NEAR(still.volume, 0, 1e-3);
}

TEST(Body, LetsNoWaterThroughInTenSecondsWithAMetreOfHead) {
  const Model model = read_text(R"(
[model]
size = ["4 m", "1.6 m"]
cell = "0.1 m"
[[free_water]]
box = [[0, 0], [2, 1.2]]
[[free_water]]
box = [[2, 0], [4, 0.2]]
[[wall]]
polygon = [[1.3, 0], [1.93, 1.5], [2.07, 1.5], [2.7, 0]]
[[stage]]
name = "rest"
duration = "10 s"
)");
  Simulation<PlaneStrain> run(model, 1);
  const auto left_of = [&] {
    double volume = 0;
    const auto& water = run.state().water;
    for (std::size_t p = 0; p < water.size(); ++p) volume += water.position[0][p] < 2 ? water.volume[p] : 0;
    return volume;
  };
  const double before = left_of();
  while (!run.finished()) run.advance();
  EXPECT_NEAR(left_of(), before, 1e-12);  // summed in another order
  for (std::size_t p = 0; p < run.state().water.size(); ++p)
    ASSERT_GT(
        run.state().setup.bodies.contact({run.state().water.position[0][p], run.state().water.position[1][p]}).distance,
        0);
}

TEST(SlopingBed, KeepsWaterAtRestWhereTheSurfaceMeetsIt) {
  const double rise = 2 * std::tan(std::acos(-1.0) / 6), left = 2 - 0.8 / std::tan(std::acos(-1.0) / 6);
  const Still still = over_bed(fmt::format("[[0, 0], [2, 0], [0, {}]]", rise), 0.8, 2 * 0.8 + 0.5 * 0.8 * (2 - left));
  EXPECT_LT(still.speed, 1e-5);
  EXPECT_LT(still.pressure, 1e-3);
}

/// A dry elastic block on a bed of 30°: how far it has moved along it after half a second, m, and its speed then, m/s.
std::array<double, 2> slide(const std::string& friction) {
  const SlidingBlock block{R"(size = ["4 m", "3 m"]
cell = "0.05 m")",
                           R"(young_modulus = "5 MPa"
grain_density = "2650 kg/m3"
grain_diameter = "1 mm")",
                           R"([[soil]]
material = "block"
polygon = [[1, 1.73205], [2, 1.154701], [2.2, 1.501111], [1.2, 2.07846]]
[[wall]]
polygon = [[0, 0], [4, 0], [0, 2.309401]]
friction_angle = ")" + friction +
                               "\"\n",
                           0.5};
  const Model model = read_text(block.text());
  Simulation<PlaneStrain> run(model, 1);
  while (!run.finished()) run.advance();
  const auto& soil = run.state().soil;
  double moved = 0, speed = 0, mass = 0;
  const double along[2] = {std::sqrt(0.75), -0.5};
  for (std::size_t p = 0; p < soil.size(); ++p) {
    mass += soil.mass[p];
    for (std::size_t a = 0; a < 2; ++a) {
      moved += soil.mass[p] * along[a] * (soil.position[a][p] - soil.reference[a][p]);
      speed += soil.mass[p] * along[a] * soil.velocity[a][p];
    }
  }
  return {moved / mass, speed / mass};
}

TEST(SlopingBed, HoldsABlockThatIsRoughEnough) {
  const auto [moved, speed] = slide("35 deg");
  EXPECT_LT(std::abs(moved), 2e-3);
  EXPECT_LT(std::abs(speed), 0.005);
}

TEST(SlopingBed, LetsABlockSlideAgainstFriction) {
  const double gravity = 9.81, rise = std::acos(-1.0) / 6;
  const double exact =
      0.125 * gravity * (std::sin(rise) - std::tan(0.5 * rise) * std::cos(rise));  // a t²/2 at t = 0.5 s
  std::printf("%.4f m, exact %.4f\n", slide("15 deg")[0], exact);
  EXPECT_NEAR(slide("15 deg")[0], exact, 0.08 * exact);  // contact across the grid is first order
}

/// A dry block on a level bed under gravity that leans by 16°: how far it slides in 0.3 s, m.
template <class Space = PlaneStrain>
double slide_on_level_bed(const std::string& bed, double friction) {
  const bool solid = Space::axes == 3;
  const SlidingBlock block{
      fmt::format("space = \"{}\"\nsize = {}\ncell = \"0.125 m\"\ntilt = \"16 deg\"", solid ? "3d" : "plane-strain",
                  solid ? "[5, 0.5, 1.25]" : "[5, 1.25]"),
      "young_modulus = \"20 MPa\"\ngrain_density = \"2600 kg/m3\"\npermeability = \"1e-3 m/s\"",
      fmt::format("[[soil]]\nmaterial = \"block\"\nbox = {}\n[[wall]]\n{}\nfriction_angle = \"{} deg\"\n",
                  solid ? "[[1, 0, 0.25], [4, 0.5, 0.75]]" : "[[1, 0.25], [4, 0.75]]", bed, friction),
      0.3};
  Simulation<Space> run(read_text(block.text()), 1);
  while (!run.finished()) run.advance();
  const auto& soil = run.state().soil;
  double moved = 0;
  for (std::size_t p = 0; p < soil.size(); ++p) moved += soil.position[0][p] - soil.reference[0][p];
  return moved / static_cast<double>(soil.size());
}

// a = g (sin β − tan δ cos β)
double slides_by(double friction) {
  const double degree = std::acos(-1.0) / 180;
  return 0.045 * 9.81 * (std::sin(16 * degree) - std::tan(friction * degree) * std::cos(16 * degree));
}

// wherever the bed lies between the lines of the grid
TEST(LevelBed, RubsAsCoulombSays) {
  for (const double top : {0.25, 0.2, 0.3}) {
    const std::string bed = fmt::format("box = [[0, 0], [5, {}]]", top);
    for (const double friction : {0, 10})
      EXPECT_NEAR(slide_on_level_bed(bed, friction), slides_by(friction), 0.01 * slides_by(friction)) << bed;
    EXPECT_LT(std::abs(slide_on_level_bed(bed, 20)), 1e-4) << bed;
  }
  EXPECT_NEAR(slide_on_level_bed<Solid>("box = [[0, 0], [5, 0.2]]", 10), slides_by(10), 0.01 * slides_by(10));
}

TEST(LevelBed, RubsAsAThinWall) {
  const std::string bed = "line = [[0, 0.25], [5, 0.25]]";
  EXPECT_NEAR(slide_on_level_bed(bed, 10), slides_by(10), 0.05 * slides_by(10));
  EXPECT_LT(std::abs(slide_on_level_bed(bed, 20)), 1e-4);
}

}  // namespace
}  // namespace polder
