// A long box of water that is cut beside a thin body at the end of the model keeps both halves in the open.
#include <gtest/gtest.h>

#include "polder/grid/bodies.hpp"
#include "polder/points/resample.hpp"

namespace polder {
namespace {

TEST(WaterPoints, HalvesOfALongBoxStayOnTheirSideOfAThinBodyAtTheEndOfTheModel) {
  const Lattice<PlaneStrain> lattice({10, 4, 1}, {0.1, 0.1, 1});
  const Array porosity(static_cast<std::size_t>(lattice.size), 1.0);
  const Bodies<PlaneStrain> bodies(lattice, {{{{0.99, 0}, {1, 0}, {1, 0.4}, {0.99, 0.4}}, 0}});
  WaterPoints<PlaneStrain> water;
  append_points(water, 1);
  water.volume[0] = 0.25 * lattice.cell_volume();
  water.position[0][0] = 0.985, water.position[1][0] = 0.05;
  water.elongation[0][0] = 5, water.elongation[1][0] = -5.0 / 6;
  ResampleRules rules;
  rules.nominal = water.volume[0];
  rules.split_edge = 0.95;
  std::uint64_t next = 1;
  Team team(1);
  ASSERT_EQ(split_water(lattice, porosity, rules, 10, next, water, team, {}, bodies), 1u);
  for (const std::size_t p : {0u, 1u}) {
    EXPECT_LT(water.position[0][p], 0.99);
    EXPECT_GT(bodies.contact({water.position[0][p], water.position[1][p]}).distance, 0);
    EXPECT_DOUBLE_EQ(water.volume[p], 0.125 * lattice.cell_volume());
  }
  EXPECT_LT(std::min(water.position[0][0], water.position[0][1]), 0.92);  // the free half takes its whole shift
}

}  // namespace
}  // namespace polder
