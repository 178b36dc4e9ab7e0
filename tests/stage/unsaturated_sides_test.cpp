// Models without ends, gravity that leans and sides that move, in the unsaturated formulation.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <random>

#include "case_text.hpp"
#include "polder/stage/checkpoint.hpp"
#include "polder/stage/simulation.hpp"
#include "silt.hpp"

namespace polder {
namespace {

using Sim = Simulation<PlaneStrain>;

constexpr double water_weight = 9810, gravity = 9.81;                // N/m³, m/s²
constexpr double pores = 0.4, permeability = 5e-4;                   // –, m/s
constexpr double young = 20e6, modulus = young * 0.7 / (1.3 * 0.4);  // Pa, E and M of the silt

/// Van Genuchten's saturation and Mualem's relative permeability of the silt at a pressure, Pa.
double saturation_of(double pressure, double g_a = 0.3) {
  const double h = std::max(0.0, -pressure / water_weight);
  return 0.05 + 0.95 / std::sqrt(1 + std::pow(g_a * h, 2));
}
double relative_of(double pressure) {
  const double effective = (saturation_of(pressure) - 0.05) / 0.95;
  return std::sqrt(effective) * std::pow(1 - std::sqrt(1 - effective * effective), 2);
}

std::string model(const std::string& size, const std::string& cell, const std::string& keys,
                  const std::string& material = silt()) {
  return fmt::format("[model]\nformulation = \"unsaturated\"\nsize = {}\ncell = {}\n{}{}", size, cell, keys, material);
}

std::string block(double left, double low, double right, double high) {
  return fmt::format("[[soil]]\nmaterial = \"silt\"\npolygon = [[{0}, {1}], [{2}, {1}], [{2}, {3}], [{0}, {3}]]\n",
                     left, low, right, high);
}

std::string closed_top(double length, double height) {
  return fmt::format("[[seepage_boundary]]\nname = \"top\"\nline = [[0, {1}], [{0}, {1}]]\ncondition = \"closed\"\n",
                     length, height);
}

const std::string rough_base = "[[boundary]]\nside = \"base\"\nsoil = \"rough\"\n";
const std::string to_rest =
    "[[stage]]\nname = \"rest\"\nduration = \"20 s\"\ninitial = true\nlocal_damping = 0.7\nuntil_rest = true\n";

void run_to_end(Sim& run) {
  while (!run.finished()) run.advance();
  EXPECT_LT(run.audit().water_balance_error(run.state()), 1e-12);
  EXPECT_LT(run.audit().solid_mass_error(run.state()), 1e-12);
}

std::unique_ptr<Sim> after(const std::string& text) {
  auto run = std::make_unique<Sim>(read_text(text), 1);
  run_to_end(*run);
  return run;
}

double mean_of(const Array& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

constexpr double tilt = 20 * std::numbers::pi / 180;

/// A layer of 2 m on a slope, its water table 1 m over the base.
std::string slope(const std::string& base, const std::string& initial, const std::string& stages) {
  return model("[2, 3]", "0.25", "tilt = \"20 deg\"\nperiodic = true\n") + block(0, 0, 2, 2) + base +
         "[initial]\nwater_table = [[0, 1], [2, 1]]\n" + initial + stages;
}

TEST(UnsaturatedSlope, IsHeldByTheShearOfItsWholeWeightAndSeepsDown) {
  const auto run =
      after(slope(rough_base, "stress = \"gravity\"\n",
                  to_rest + "ramp = \"0.2 s\"\nhold_water = true\n[[stage]]\nname = \"hold\"\nduration = \"1 s\"\n"
                            "local_damping = 0.7\n"));
  const auto& state = run->state();
  const auto& lattice = state.setup.lattice;
  const auto& soil = state.soil;
  // water pressure by the height over the table across the slope, which is the same all along it
  const double across = water_weight * std::cos(tilt);
  const auto pressure = [&](double y) { return across * (1 - y); };
  double weight[9] = {};  // N/m², on the base of each cell
  for (int j = 7; j >= 0; --j) {
    const double y = 0.25 * (j + 0.5), p = pressure(y);
    for (const int i : {0, 3, 7}) {
      EXPECT_NEAR(state.grid.pressure[lattice.index(i, j)], p, 0.002 * across) << j;
      const double flow = permeability * relative_of(p) * std::sin(tilt);
      EXPECT_NEAR(state.unsaturated->pores.flow[0][lattice.index(i, j)] / 0.25, flow, 0.01 * flow) << j;
    }
    weight[j] = weight[j + 1] + 0.25 * gravity * (0.6 * 2650 + pores * 1000 * saturation_of(p));
  }
  double shear = 0, normal = 0, speed = 0;  // the most that they are off
  for (std::size_t p = 0; p < soil.size(); ++p) {
    const double y = soil.position[1][p], part = 4 * y - std::floor(4 * y);
    const auto j = static_cast<std::size_t>(4 * y);
    const double above = part * weight[j + 1] + (1 - part) * weight[j];
    const double water = run->pressure_at({soil.position[0][p], y, 0});
    const double across_slope = soil.stress[1][p] - saturation_of(water) * water;
    shear = std::max(shear, std::abs(soil.stress[3][p] - above * std::sin(tilt)));
    normal = std::max(normal, std::abs(across_slope + above * std::cos(tilt)));
    speed = std::max(speed, std::abs(soil.velocity[0][p]));
  }
  EXPECT_LT(shear, 0.01 * weight[0]);
  EXPECT_LT(normal, 0.025 * weight[0]);  // the two points in the height of a cell bear the same
  EXPECT_LT(speed, 1e-5);
}

TEST(UnsaturatedSlope, SlidesFreelyOnASmoothBase) {
  const auto run = after(slope("", "stress = \"none\"\n", "[[stage]]\nname = \"slide\"\nduration = \"0.5 s\"\n"));
  const double expected = gravity * std::sin(tilt) * 0.5;
  const auto& soil = run->state().soil;
  EXPECT_NEAR(mean_of(soil.velocity[0]), expected, 1e-6 * expected);
  for (std::size_t p = 0; p < soil.size(); ++p) {  // out on the right and in on the left
    EXPECT_GE(soil.position[0][p], 0);
    EXPECT_LT(soil.position[0][p], 2);
    EXPECT_NEAR(soil.position[0][p] - soil.reference[0][p], 0.25 * expected, 0.01 * expected);
  }
}

TEST(UnsaturatedSlope, HoldsStillWaterInAClosedBox) {
  const auto run = after(model("[1, 2]", "0.25", "tilt = \"20 deg\"\n") + block(0, 0, 1, 2) + closed_top(1, 2) +
                         "[initial]\nstress = \"none\"\nwater_table = [[0, 2], [1, 2]]\n[[stage]]\nname = \"rest\"\n"
                         "duration = \"2 s\"\nlocal_damping = 0.7\n");
  const auto& state = run->state();
  const auto& lattice = state.setup.lattice;
  for (int j = 0; j < 7; ++j)
    for (int i = 0; i < 3; ++i) {
      const std::ptrdiff_t cell = lattice.index(i, j);
      const double p = state.grid.pressure[cell], step = 0.25 * water_weight;
      EXPECT_NEAR(state.grid.pressure[cell + 1] - p, step * std::sin(tilt), 3e-3 * step);
      EXPECT_NEAR(state.grid.pressure[cell + lattice.stride[1]] - p, -step * std::cos(tilt), 3e-3 * step);
    }
}

/// A layer of 2 m that moves along its smooth base, the water in it or standing on it.
std::unique_ptr<Sim> carried(double speed, double level) {
  auto run = std::make_unique<Sim>(
      read_text(model("[2, 3]", "0.25", "periodic = true\n") + block(0, 0, 2, 2) +
                fmt::format("[[seepage_boundary]]\nname = \"river\"\nline = [[0, 2], [2, 2]]\nhead = {0}\n"
                            "[initial]\nwater_table = [[0, {0}], [2, {0}]]\n"
                            "{1}[[stage]]\nname = \"run\"\nduration = \"1 s\"\n",
                            level, to_rest)),
      1);
  while (run->time() < 0) run->advance();
  for (double& v : run->state().soil.velocity[0]) v = speed;
  run->begin_anew();
  run_to_end(*run);
  return run;
}

TEST(UnsaturatedPeriodic, IsTheSameToAnObserverWhoMoves) {
  for (const double level : {1.0, 2.6}) {
    const auto still = carried(0, level);
    const auto& lattice = still->state().setup.lattice;
    for (const double speed : {0.2, -1.0}) {
      const auto moving = carried(speed, level);
      const auto& soil = moving->state().soil;
      EXPECT_NEAR(mean_of(soil.velocity[0]), speed, 1e-12);
      double most = 0, off = 0;
      for (std::size_t p = 0; p < soil.size(); ++p) most = std::max(most, std::abs(soil.velocity[0][p] - speed));
      for (int j = 0; j < 8; ++j)
        for (int i = 0; i < 8; ++i) {
          const std::ptrdiff_t cell = lattice.index(i, j);
          off = std::max(off, std::abs(moving->state().grid.pressure[cell] - still->state().grid.pressure[cell]));
        }
      EXPECT_LT(most, 1e-10);
      EXPECT_LT(off, 1e-8 * water_weight);
    }
  }
}

TEST(UnsaturatedPeriodic, KeepsTheMomentumOfRandomMotions) {
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u}) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0, 0.1);
    Sim run(read_text(
                model("[2, 3]", "0.25", "periodic = true\n") + block(0, 0, 2, 2) +
                fmt::format("[initial]\nwater_table = [[0, {0}], [2, {0}]]\n[[stage]]\nname = \"run\"\nduration = 1\n",
                            std::uniform_real_distribution<double>(0.2, 2)(random))),
            1);
    auto& soil = run.state().soil;
    const double drift = 10 * normal(random);
    for (double& v : soil.velocity[0]) v = drift + normal(random);
    for (double& v : soil.velocity[1]) v = normal(random);
    run.begin_anew();
    const auto momentum = [&](bool size) {  // along x, in which nothing acts from outside
      double sum = 0;
      for (std::size_t p = 0; p < soil.size(); ++p) {
        const double v = soil.velocity[0][p];
        sum += (soil.mass[p] + 1000 * soil.water[p]) * (size ? std::abs(v) : v);
      }
      return sum;
    };
    const double before = momentum(false), scale = momentum(true);
    double worst = 0;
    for (int step = 0; step < 60; ++step) {
      run.advance();
      worst = std::max(worst, std::abs(momentum(false) - before) / scale);
    }
    EXPECT_LT(worst, 5e-6);  // the water that goes from point to point has its own, which is left out
    EXPECT_LT(run.audit().water_balance_error(run.state()), 1e-12);
  }
}

TEST(UnsaturatedPeriodic, SlidesInThreeDimensions) {
  Simulation<Solid> run(
      read_text(fmt::format("[model]\nspace = \"3d\"\nformulation = \"unsaturated\"\nsize = [2, 0.5, 1.5]\ncell = "
                            "0.25\ntilt = \"20 deg\"\nperiodic = true\n{}[[soil]]\nmaterial = \"silt\"\nbox = [[0, "
                            "0, 0], [2, 0.5, 1]]\n[initial]\nstress = \"none\"\nwater_table = [[0, 0.5], [2, "
                            "0.5]]\n[[stage]]\nname = \"slide\"\nduration = \"0.3 s\"\n",
                            silt())),
      1);
  while (!run.finished()) run.advance();
  const double expected = gravity * std::sin(tilt) * 0.3;
  EXPECT_NEAR(mean_of(run.state().soil.velocity[0]), expected, 1e-6 * expected);
  EXPECT_LT(run.audit().water_balance_error(run.state()), 1e-12);
  const double flow = permeability * relative_of(-0.125 * water_weight * std::cos(tilt)) * std::sin(tilt);
  EXPECT_NEAR(run.state().unsaturated->pores.flow[0][run.state().setup.lattice.index(0, 0, 2)], 0.0625 * flow,
              0.1 * 0.0625 * flow);
}

/// A mound of 1 m on a layer of 0.5 m, under rain, that gives way; it begins `cells` further to the right.
std::unique_ptr<Sim> mound(int cells) {
  const double h = 0.25, length = 4, left = 1 + cells * h, right = left + 1;
  std::string text = model("[4, 3]", "0.25", "periodic = true\n") + block(0, 0, length, 0.5);
  const auto part = [&](double from, double to) {
    if (from >= to) return;
    text += block(from, 0.5, to, 1.5) +
            fmt::format("[[seepage_boundary]]\nline = [[{0}, 1.5], [{1}, 1.5]]\ncondition = \"rain\"\nrate = 1e-4\n",
                        from, to);
  };
  part(left, std::min(right, length));
  part(0, right - length);
  text += rough_base +
          "[initial]\nwater_table = [[0, 0.8], [4, 0.8]]\n[[stage]]\nname = \"run\"\nduration = "
          "\"0.2 s\"\n[numerics]\npressure_tolerance = 1e-12\n";
  auto run = std::make_unique<Sim>(read_text(text), 1);
  auto& soil = run->state().soil;
  for (std::size_t p = 0; p < soil.size(); ++p) {
    const double x = (soil.position[0][p] - cells * h) / length * 2 * std::numbers::pi;
    soil.velocity[0][p] = 0.3 + 0.05 * std::sin(x);
    soil.velocity[1][p] = 0.02 * std::cos(2 * x) * soil.position[1][p];
  }
  run->begin_anew();
  run_to_end(*run);
  return run;
}

TEST(UnsaturatedPeriodic, IsTheSameWhereverItBegins) {
  const auto here = mound(0);
  const auto& lattice = here->state().setup.lattice;
  for (const int cells : {3, 10, 12}) {
    const auto there = mound(cells);
    double speed = 0, off = 0, pressure = 0;
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 16; ++i) {
        const std::ptrdiff_t a = lattice.index(i, j), b = lattice.index((i + cells) % 16, j);
        for (int c = 0; c < 2; ++c) {
          const Array &v = here->state().grid.soil_velocity[c], &w = there->state().grid.soil_velocity[c];
          speed = std::max(speed, std::abs(v[a]));
          off = std::max(off, std::abs(v[a] - w[b]));
        }
        pressure = std::max(pressure, std::abs(here->state().grid.pressure[a] - there->state().grid.pressure[b]));
      }
    EXPECT_GT(speed, 0.02);
    EXPECT_LT(off, 1e-9 * speed);
    EXPECT_LT(pressure, 1e-6 * water_weight);
  }
}

TEST(UnsaturatedSide, ShearsMoistSoilByItsModulus) {
  const double height = 1, way = 1e-3, shear = young / 2.6 * way / height;
  const auto run =
      after(model("[1, 1]", "0.125", "periodic = true\n") + block(0, 0, 1, 1) + closed_top(1, 1) + rough_base +
            "[[boundary]]\nside = \"top\"\nsoil = \"rough\"\nslide = [[0, 0], [0.5, 2e-3], [1, 0]]\n"
            "[initial]\nwater_table = [[0, 0], [1, 0]]\n" +
            to_rest + "[[stage]]\nname = \"slide\"\nduration = \"2 s\"\nlocal_damping = 0.7\n");
  const auto& state = run->state();
  for (const double s : state.soil.stress[3]) EXPECT_NEAR(s, shear, 0.01 * shear);
  for (int j = 0; j < 8; ++j)
    EXPECT_NEAR(state.grid.pressure[state.setup.lattice.index(3, j)], -water_weight * 0.125 * (j + 0.5),
                1e-3 * water_weight);
}

/// A column of 2 m that fills its model, pressed from above by `way`, m, within 1 s.
std::string pressed(double level, double way, const std::string& permeability_, double duration,
                    const std::string& more = "", const std::string& g_a = "0.3", const std::string& initial = "") {
  std::string material = silt();
  material.replace(material.find("5e-4"), 4, permeability_);
  material.replace(material.find("0.3 1/m"), 3, g_a);
  return model("[0.5, 2]", "0.25", "", material) + block(0, 0, 0.5, 2) + closed_top(0.5, 2) + more +
         fmt::format(
             "[[boundary]]\nside = \"top\"\npush = [[0, 0], [0.5, {0}], [1, 0]]\n[initial]\nwater_table = "
             "[[0, {1}], [0.5, {1}]]\n",
             2 * way, level) +
         initial + to_rest +
         fmt::format("[[stage]]\nname = \"press\"\nduration = \"{} s\"\nlocal_damping = 0.5\n", duration);
}

TEST(UnsaturatedSide, PressesSaturatedSoilWhoseWaterCannotLeave) {
  const double way = 1e-5, strain = way / 2;
  const auto before = after(pressed(2, 0, "5e-4", 2)), run = after(pressed(2, way, "5e-4", 2));
  const double stiff = run->state().setup.water.bulk_modulus / pores;
  for (int j = 0; j < 8; ++j) {
    const std::ptrdiff_t cell = run->state().setup.lattice.index(0, j);
    EXPECT_NEAR(run->state().grid.pressure[cell] - before->state().grid.pressure[cell], stiff * strain,
                0.01 * stiff * strain);
  }
  EXPECT_EQ(run->audit().water_out, 0);
}

TEST(UnsaturatedSide, PressesMoistSoilToTheSuctionOfItsContentOfWater) {
  // all under the same suction at first, and the water stays: S n' (1 − ε) = S₀ n with n' (1 − ε) = n − ε
  const double way = 0.06, strain = way / 2, before = saturation_of(-1000, 10);
  const auto run = after(pressed(0, way, "1e-9", 2, "", "10", "suction_limit = \"1 kPa\"\n"));
  const auto& state = run->state();
  const double expected = before * pores / (pores - strain);
  for (int j = 0; j < 8; ++j) {
    const double now = saturation_of(state.grid.pressure[state.setup.lattice.index(0, j)], 10);
    EXPECT_NEAR(now - before, expected - before, 0.03 * (expected - before)) << j;
  }
  EXPECT_EQ(run->audit().water_out, 0);
}

TEST(UnsaturatedSide, PressesADrainedColumnByItsModulus) {
  const double way = 0.01, width = 0.5;
  const std::string base = "[[seepage_boundary]]\nname = \"base\"\nline = [[0, 0], [0.5, 0]]\nhead = \"2 m\"\n";
  const auto before = after(pressed(2, 0, "5e-2", 4, base)), run = after(pressed(2, way, "5e-2", 4, base));
  EXPECT_NEAR(run->audit().water_out, way * width, 0.01 * way * width);
  const double change = mean_of(run->state().soil.stress[1]) - mean_of(before->state().soil.stress[1]);
  EXPECT_NEAR(change, -modulus * way / 2, 0.02 * modulus * way / 2);
  for (int j = 0; j < 8; ++j)
    EXPECT_NEAR(run->state().grid.pressure[run->state().setup.lattice.index(0, j)],
                water_weight * (2 - 0.25 * (j + 0.5)), 0.01 * water_weight);
}

/// All three at once: a slope without ends, dragged by what lies on it.
std::string dragged(int columns, const std::string& duration) {
  return model(fmt::format("[{}, 1.5]", columns * 0.025), "0.025", "tilt = \"15 deg\"\nperiodic = true\n") +
         block(0, 0, columns * 0.025, 1.5) + closed_top(columns * 0.025, 1.5) + rough_base +
         "[[boundary]]\nside = \"top\"\nsoil = \"rough\"\nslide = [[0, 0], [0.001, 2]]\npush = 1e-2\n"
         "[initial]\nstress = \"none\"\nwater_table = [[0, 0.7], [2, 0.9]]\n[[stage]]\nname = \"drag\"\nduration = "
         "\"" +
         duration + "\"\n";
}

TEST(UnsaturatedSide, GivesTheSameBitsWithTwoThreadsAndAfterResuming) {
  const Model all = read_text(dragged(80, "1.5 ms"));
  Sim one(all, 1), two(all, 2), resumed(all, 1);
  while (one.time() < 0.0007) one.advance();
  restore_checkpoint(checkpoint_bytes(one, OutputState{}, "case"), resumed, "case");
  for (Sim* run : {&one, &two, &resumed}) run_to_end(*run);
  double moved = 0;
  for (const double v : one.state().soil.velocity[0]) moved = std::max(moved, v);
  EXPECT_GT(moved, 0.1);
  for (const Sim* other : {&two, &resumed}) {
    EXPECT_EQ(one.state().soil.position[0], other->state().soil.position[0]);
    EXPECT_EQ(one.state().soil.stress[3], other->state().soil.stress[3]);
    EXPECT_EQ(one.state().soil.water, other->state().soil.water);
    EXPECT_EQ(one.state().grid.pressure, other->state().grid.pressure);
  }
}

}  // namespace
}  // namespace polder
