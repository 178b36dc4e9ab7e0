#include "polder/points/resample.hpp"

#include <gtest/gtest.h>

#include <random>

#include "polder/points/tiles.hpp"

namespace polder {
namespace {

struct Totals {
  double volume = 0, momentum[2] = {0, 0}, moment[2] = {0, 0};
};

Totals totals(const WaterPoints<PlaneStrain>& water) {
  Totals t;
  for (std::size_t p = 0; p < water.size(); ++p) {
    t.volume += water.volume[p];
    for (int a = 0; a < 2; ++a) {
      t.momentum[a] += water.volume[p] * water.velocity[a][p];
      t.moment[a] += water.volume[p] * water.position[a][p];
    }
  }
  return t;
}

void expect_same(const Totals& a, const Totals& b) {
  EXPECT_NEAR(a.volume, b.volume, 1e-14);
  for (int c = 0; c < 2; ++c) {
    EXPECT_NEAR(a.momentum[c], b.momentum[c], 1e-13);
    EXPECT_NEAR(a.moment[c], b.moment[c], 1e-13);
  }
}

WaterPoints<PlaneStrain> crowd(std::size_t count, double low, double high, double volume) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(low, high), speed(-1, 1);
  WaterPoints<PlaneStrain> water;
  append_points(water, count);
  for (std::size_t p = 0; p < count; ++p) {
    water.id[p] = p;
    water.volume[p] = volume;
    for (int a = 0; a < 2; ++a) {
      water.position[a][p] = place(random);
      water.velocity[a][p] = speed(random);
    }
  }
  return water;
}

TEST(WaterPoints, SplitKeepsVolumeMomentumAndCentre) {
  const Lattice<PlaneStrain> lattice({10, 10, 1}, {0.1, 0.1, 1});
  Array porosity(static_cast<std::size_t>(lattice.size), 0.4);
  auto water = crowd(50, 0.2, 0.8, 0.1 * 0.1 / 4);  // in soil each fills 2.5 times its own volume
  const Totals before = totals(water);
  ResampleRules rules;
  rules.nominal = 0.1 * 0.1 / 4;
  std::uint64_t next = 50;
  Team team(2);
  EXPECT_EQ(split_water(lattice, porosity, rules, 10, next, water, team), 50u);
  EXPECT_EQ(water.size(), 100u);
  EXPECT_EQ(next, 100u);
  expect_same(before, totals(water));
}

TEST(WaterPoints, LongBoxesInFreeWaterAreCutInTwoAlongTheirLongEdge) {
  const Lattice<PlaneStrain> lattice({10, 10, 1}, {0.2, 0.1, 1});
  const Array porosity(static_cast<std::size_t>(lattice.size), 1.0);
  WaterPoints<PlaneStrain> water;
  append_points(water, 1);
  water.volume[0] = 0.25 * lattice.cell_volume();  // half a cell wide and high, before
  water.position[0][0] = 1, water.position[1][0] = 0.5;
  water.elongation[0][0] = 1, water.elongation[1][0] = -0.5;
  ResampleRules rules;
  rules.nominal = water.volume[0];
  std::uint64_t next = 1;
  Team team(1);
  EXPECT_EQ(split_water(lattice, porosity, rules, 10, next, water, team), 0u);
  rules.split_edge = 0.95;
  ASSERT_EQ(split_water(lattice, porosity, rules, 10, next, water, team), 1u);
  for (const std::size_t p : {0u, 1u}) {  // two boxes, half a cell wide, that cover the one of before
    EXPECT_DOUBLE_EQ(water.volume[p], 0.125 * lattice.cell_volume());
    const double edge = std::sqrt(0.125);  // cells
    EXPECT_NEAR(edge * (1 + water.elongation[0][p]), 0.5, 1e-15);
    EXPECT_NEAR(edge * (1 + water.elongation[1][p]), 0.25, 1e-15);
    EXPECT_NEAR(water.position[0][p], p == 0 ? 1.05 : 0.95, 1e-15);
    EXPECT_DOUBLE_EQ(water.position[1][p], 0.5);
  }
  rules.least = 1;
  rules.split_edge = 0.1;
  EXPECT_EQ(split_water(lattice, porosity, rules, 20, next, water, team), 0u);
}

TEST(WaterPoints, MergedBoxesTakeTheShapeOfBoth) {
  const Lattice<PlaneStrain> lattice({10, 10, 1}, {0.1, 0.1, 1});
  const Array porosity(static_cast<std::size_t>(lattice.size), 1.0);
  WaterPoints<PlaneStrain> water;
  append_points(water, 2);
  for (const std::size_t p : {0u, 1u}) {  // one on top of the other, 0.4 cells wide and 0.1 high
    water.volume[p] = 0.04 * lattice.cell_volume();
    water.position[0][p] = 0.55;
    water.position[1][p] = 0.54 + 0.01 * static_cast<double>(p);
    water.elongation[0][p] = 1, water.elongation[1][p] = -0.5;
  }
  ResampleRules rules;
  rules.nominal = 0.25 * lattice.cell_volume();
  rules.points_per_cell = 0;
  rules.split_edge = 0.95;
  ASSERT_EQ(merge_water(lattice, porosity, rules, water), 1u);
  EXPECT_DOUBLE_EQ(water.volume[0], 0.08 * lattice.cell_volume());
  EXPECT_NEAR(std::sqrt(0.08) * (1 + water.elongation[0][0]), 0.4, 1e-12);
  EXPECT_NEAR(std::sqrt(0.08) * (1 + water.elongation[1][0]), 0.2, 1e-12);
}

TEST(WaterPoints, MergeThinsACrowdAndKeepsVolumeMomentumAndCentre) {
  const Lattice<PlaneStrain> lattice({10, 10, 1}, {0.1, 0.1, 1});
  Array porosity(static_cast<std::size_t>(lattice.size), 1.0);
  auto water = crowd(24, 0.301, 0.399, 0.1 * 0.1 / 24);
  const Totals before = totals(water);
  Team team(1);
  Tiling<PlaneStrain> tiling;
  sort_points(lattice, water, tiling, team);
  ResampleRules rules;
  rules.nominal = 0.1 * 0.1 / 4;
  EXPECT_GT(merge_water(lattice, porosity, rules, water), 0u);
  EXPECT_LT(water.size(), 24u);
  expect_same(before, totals(water));
}

}  // namespace
}  // namespace polder
