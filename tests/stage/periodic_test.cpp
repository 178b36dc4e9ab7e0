// Models without ends along x, gravity that leans, and sides that move.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "case_text.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {
namespace {

const char* soil = R"(
[[material]]
name = "sand"
law = "mohr-coulomb"
grain_density = 2650
porosity = 0.4
max_porosity = 0.6
drag = "darcy"
permeability = 1e-3
young_modulus = 1e6
poisson_ratio = 0.2
friction_angle = "30 deg"
cohesion = 100
)";

/// A periodic layer of soil, 0.8 m × 0.4 m, in a model of 0.6 m height.
std::string layer(const std::string& keys, const std::string& sections) {
  return "[model]\ntitle = \"layer\"\nsize = [0.8, 0.6]\ncell = 0.05\nperiodic = true\n" + keys + soil +
         "[[soil]]\nmaterial = \"sand\"\nbox = [[0, 0], [0.8, 0.4]]\n" + sections;
}

double mean_of(const Array& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double mean_velocity(const Simulation<PlaneStrain>& run) { return mean_of(run.state().soil.velocity[0]); }

void run_to_end(Simulation<PlaneStrain>& run) {
  while (!run.finished()) run.advance();
}

TEST(TiltedGravity, AcceleratesALayerOnASmoothBase) {
  const Model model = read_text(
      layer("tilt = \"10 deg\"\n", "[initial]\nstress = \"none\"\n[[stage]]\nname = \"slide\"\nduration = 0.5\n"));
  Simulation<PlaneStrain> run(model, 1);
  run_to_end(run);
  const double expected = 9.81 * std::sin(10 * std::numbers::pi / 180) * 0.5;
  EXPECT_NEAR(mean_velocity(run), expected, 1e-9 * expected);
  // it has gone out on the right and come in on the left
  const auto& s = run.state().soil;
  for (std::size_t p = 0; p < s.size(); ++p) {
    EXPECT_GE(s.position[0][p], 0);
    EXPECT_LT(s.position[0][p], 0.8);
    EXPECT_NEAR(s.position[0][p] - s.reference[0][p], 0.25 * expected, 0.01 * expected);
  }
}

TEST(TiltedGravity, AcceleratesGrainsAndWaterAlike) {
  const Model model = read_text(layer("tilt = \"10 deg\"\n",
                                      "[initial]\nstress = \"none\"\nwater_table = [[0, 0.4], [0.8, 0.4]]\n"
                                      "[[stage]]\nname = \"slide\"\nduration = 0.1\n"));
  Simulation<PlaneStrain> run(model, 1);
  run_to_end(run);
  const double expected = 9.81 * std::sin(10 * std::numbers::pi / 180) * 0.1;
  EXPECT_NEAR(mean_velocity(run), expected, 1e-3 * expected);
  EXPECT_NEAR(mean_of(run.state().water.velocity[0]), expected, 1e-3 * expected);
}

/// Mean velocity along the slope of a layer on a rough base, 1 s after gravity was raised.
double creep(double tilt) {
  const Model model = read_text(layer(
      "tilt = \"" + std::to_string(tilt) + " deg\"\n",
      "[initial]\nstress = \"gravity\"\n[[boundary]]\nside = \"base\"\nsoil = \"rough\"\n[[stage]]\nname = \"weight\"\n"
      "initial = true\nduration = 0.5\nramp = 0.4\ndamping = 20\n[[stage]]\nname = \"slope\"\nduration = 1\n"));
  Simulation<PlaneStrain> run(model, 1);
  run_to_end(run);
  return mean_velocity(run);
}

TEST(TiltedGravity, MovesAnInfiniteSlopeThatIsSteeperThanItsStrength) {
  // c + γ H cos²β tan φ against γ H sin β cos β with c 100 Pa, γ 15.6 kN/m³, H 0.4 m, φ 30°: F = 1.30 at 25°, 0.81 at
  // 36°
  EXPECT_LT(std::abs(creep(25)), 1e-3);
  EXPECT_GT(creep(36), 0.1);
}

/// Saturated and full, without gravity, so that nothing acts from outside along x.
Model closed_soil() {
  return read_text("[model]\ntitle = \"closed\"\nsize = [0.8, 0.4]\ncell = 0.05\nperiodic = true\ngravity = 0\n" +
                   std::string(soil) +
                   "[[soil]]\nmaterial = \"sand\"\nbox = [[0, 0], [0.8, 0.4]]\n"
                   "[initial]\nstress = \"none\"\nwater_table = [[0, 0.4], [0.8, 0.4]]\n"
                   "[[stage]]\nname = \"run\"\nduration = 0.02\n[numerics]\nmax_step = 2e-4\npressure_tolerance = "
                   "1e-12\nvolume_correction = 0\n");
}

struct Motion2 {
  double momentum = 0, energy = 0;
};

Motion2 motion_of(const Simulation<PlaneStrain>& run) {
  Motion2 m;
  const auto& s = run.state().soil;
  const auto& w = run.state().water;
  for (std::size_t p = 0; p < s.size(); ++p) {
    m.momentum += s.mass[p] * s.velocity[0][p];
    m.energy += 0.5 * s.mass[p] * speed_squared(s, p);
  }
  for (std::size_t p = 0; p < w.size(); ++p) {
    const double mass = 1000 * w.volume[p];
    m.momentum += mass * w.velocity[0][p];
    m.energy += 0.5 * mass * speed_squared(w, p);
  }
  return m;
}

TEST(PeriodicModel, KeepsMomentumAndDragTakesEnergyFromRandomMotions) {
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u}) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0, 0.1);
    Simulation<PlaneStrain> run(closed_soil(), 1);
    const double drift = normal(random);
    for (double& v : run.state().soil.velocity[0]) v = normal(random) + drift;
    for (double& v : run.state().water.velocity[0]) v = normal(random) - drift;
    for (double& v : run.state().soil.velocity[1]) v = normal(random);
    for (double& v : run.state().water.velocity[1]) v = normal(random);
    run.begin_anew();
    Motion2 before = motion_of(run);
    double scale = 0;
    for (std::size_t p = 0; p < run.state().soil.size(); ++p)
      scale += run.state().soil.mass[p] * std::abs(run.state().soil.velocity[0][p]);
    for (int step = 0; step < 40; ++step) {
      run.advance();
      const Motion2 now = motion_of(run);
      // exact while cells are exactly full; between wet cells faces count as full whatever their points weigh
      ASSERT_NEAR(now.momentum, before.momentum, (step == 0 ? 1e-11 : 1e-4) * scale) << "step " << step;
      if (step == 0) {
        ASSERT_LT(now.energy, before.energy);  // before the skeleton gives any back
      }
    }
  }
}

TEST(PeriodicModel, IsTheSameWhereverItBegins) {
  Model model = closed_soil();
  const auto field = [](double x, double y) {
    const double k = 2 * std::numbers::pi / 0.8;
    return std::array{0.05 * std::sin(k * x) + 0.02 * std::cos(2 * k * x + 1),
                      0.03 * std::sin(k * x) * std::sin(y / 0.4 * std::numbers::pi)};
  };
  const auto run_from = [&](int cells) {
    Simulation<PlaneStrain> run(model, 1);
    auto set = [&](auto& points) {
      for (std::size_t p = 0; p < points.size(); ++p) {
        const auto v = field(points.position[0][p] - cells * 0.05, points.position[1][p]);
        points.velocity[0][p] = v[0], points.velocity[1][p] = v[1];
      }
    };
    set(run.state().soil);
    set(run.state().water);
    run.begin_anew();
    run_to_end(run);
    return run.state().grid.soil_velocity[0];
  };
  const Array here = run_from(0), there = run_from(5);
  const Lattice<PlaneStrain> lattice({16, 8, 1}, {0.05, 0.05, 0.05});
  double largest = 0, worst = 0;
  for (int j = 0; j < 8; ++j)
    for (int i = 0; i < 16; ++i) {
      largest = std::max(largest, std::abs(here[lattice.index(i, j)]));
      worst = std::max(worst, std::abs(here[lattice.index(i, j)] - there[lattice.index((i + 5) % 16, j)]));
    }
  EXPECT_GT(largest, 1e-3);
  EXPECT_LT(worst, 1e-4 * largest);  // points that come in are sorted anew, and the groups of F-bar with them
}

TEST(PeriodicModel, StaysAtRestRelativeToAnObserverWhoMoves) {
  for (const unsigned seed : {11u, 12u, 13u}) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const double speed = std::uniform_real_distribution<double>(-1, 1)(random);
    // a submerged bed, points off the lattice
    const Model model = read_text(
        "[model]\ntitle = \"bed\"\nsize = [0.8, 0.6]\ncell = 0.05\nperiodic = true\n" + std::string(soil) +
        "[[soil]]\nmaterial = \"sand\"\nbox = [[0, 0], [0.8, 0.3]]\n[[free_water]]\nbox = [[0, 0.3], [0.8, 0.5]]\n"
        "[initial]\nwater_table = [[0, 0.5], [0.8, 0.5]]\n[[stage]]\nname = \"run\"\nduration = 0.3\n");
    Simulation<PlaneStrain> run(model, 1);
    for (double& v : run.state().soil.velocity[0]) v = speed;
    for (double& v : run.state().water.velocity[0]) v = speed;
    run.begin_anew();
    run_to_end(run);
    double most = 0;
    for (const auto* points : {&run.state().soil.velocity, &run.state().water.velocity})
      for (std::size_t p = 0; p < (*points)[0].size(); ++p)
        most = std::max({most, std::abs((*points)[0][p] - speed), std::abs((*points)[1][p])});
    EXPECT_LT(most, 0.015 * std::sqrt(9.81 * 0.5));  // what points that cross cells make, of up to 1 m/s
    const auto& lattice = run.state().setup.lattice;
    for (int j = 0; j < 10; ++j)
      EXPECT_NEAR(run.state().grid.pressure[lattice.index(3, j)], 9810 * (0.475 - 0.05 * j), 5e-3 * 9810 * 0.5) << j;
  }
}

TEST(MovingSide, PressesSoilAsAnOedometerDoes) {
  const Model model = read_text(
      "[model]\ntitle = \"oedometer\"\nsize = [0.2, 0.4]\ncell = 0.05\ngravity = 0\n"
      "[[material]]\nname = \"clay\"\nlaw = \"linear-elastic\"\ngrain_density = 2650\nporosity = 0.4\n"
      "permeability = 1e-3\nyoung_modulus = 1e6\npoisson_ratio = 0.25\n[[soil]]\nmaterial = \"clay\"\n"
      "box = [[0, 0], [0.2, 0.4]]\n[initial]\nstress = \"none\"\n[[boundary]]\nside = \"top\"\n"
      "push = [[0, 0], [0.25, 2e-4], [0.5, 0]]\n[[stage]]\nname = \"press\"\nduration = 1\ndamping = 50\n");
  Simulation<PlaneStrain> run(model, 1);
  run_to_end(run);
  // 0.05 mm of 0.4 m, M = E (1 − ν)/((1 + ν)(1 − 2ν)) = 1.2 MPa
  for (const double s : run.state().soil.stress[1]) EXPECT_NEAR(s, -1.2e6 * 5e-5 / 0.4, 0.01 * 1.2e6 * 5e-5 / 0.4);
}

}  // namespace
}  // namespace polder
