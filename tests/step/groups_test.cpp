// What the soil points of one cell share: their porosity, as their grains slide.
#include "polder/step/groups.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace polder {
namespace {

/// Five points: three of one cell, then two of another.
SoilPoints<PlaneStrain> five_points() {
  SoilPoints<PlaneStrain> soil;
  soil.mass = {1.0, 2.0, 1.5, 1.0, 1.0};
  soil.porosity = {0.40, 0.44, 0.60, 0.38, 0.50};
  soil.home = {7, 7, 7, 8, 8};
  soil.material = {0, 0, 0, 0, 0};
  return soil;
}

double bulk(const SoilPoints<PlaneStrain>& soil, std::size_t first, std::size_t end) {
  double sum = 0;
  for (std::size_t p = first; p < end; ++p) sum += soil.mass[p] / (1 - soil.porosity[p]);
  return sum;
}

TEST(Mixing, KeepsTheVolumeOfAGroupAndBringsItsPorositiesTogether) {
  SoilPoints<PlaneStrain> soil = five_points();
  const SoilPoints<PlaneStrain> before = soil;
  const std::vector<double> sheared(5, 0.01);
  mix_porosities(sheared.data(), 0, 5, soil);
  EXPECT_NEAR(bulk(soil, 0, 3), bulk(before, 0, 3), 1e-14);
  EXPECT_NEAR(bulk(soil, 3, 5), bulk(before, 3, 5), 1e-14);
  const double mean = bulk(before, 0, 3) / 4.5, left = std::exp(-porosity_mixing * 0.01);
  for (std::size_t p = 0; p < 3; ++p)
    EXPECT_NEAR(1 / (1 - soil.porosity[p]) - mean, left * (1 / (1 - before.porosity[p]) - mean), 1e-14);
}

TEST(Mixing, LeavesGroupsAloneThatDoNotShearOrAreOfTwoMaterials) {
  SoilPoints<PlaneStrain> soil = five_points();
  soil.material[2] = 1;
  const SoilPoints<PlaneStrain> before = soil;
  const std::vector<double> sheared = {0.01, 0.01, 0.01, 0, 0};
  mix_porosities(sheared.data(), 0, 5, soil);
  EXPECT_EQ(soil.porosity, before.porosity);
}

TEST(Groups, AreNotCutBetweenChunks) {
  SoilPoints<PlaneStrain> soil;
  constexpr std::size_t n = chunk_size + 3;  // the last group begins two points before a chunk is full
  soil.home.assign(n, 1);
  for (std::size_t p = chunk_size - 2; p < n; ++p) soil.home[p] = 2;
  EXPECT_EQ(whole_groups(soil, 0, n), chunk_size - 2);
  EXPECT_EQ(whole_groups(soil, chunk_size - 2, n), 5);
  soil.home.assign(n, 1);  // one group that no chunk holds
  EXPECT_EQ(whole_groups(soil, 0, n), chunk_size);
}

}  // namespace
}  // namespace polder
