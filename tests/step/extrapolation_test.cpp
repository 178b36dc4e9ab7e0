// The water's velocity beyond the faces where it is known: from wet cells to all faces around, from a film not to faces
// along it that have water, and momentum, of their own.
#include <gtest/gtest.h>

#include "polder/step/projection.hpp"

namespace polder {
namespace {

struct Extrapolated {
  double toward_water, toward_nothing, above;  ///< velocities on faces beside the known one
};

/// One horizontal face is known, of `kind`, with 2 m/s; the one before it has water at 0.1 m/s.
Extrapolated beyond(std::uint8_t kind) {
  Setup<PlaneStrain> setup;
  setup.lattice = Lattice<PlaneStrain>({12, 6, 1}, {1, 1, 1});
  GridFields<PlaneStrain> grid(setup.lattice);
  grid.activate(setup.lattice, ActiveRows<PlaneStrain>(setup.lattice, 1));
  const std::ptrdiff_t known = setup.lattice.index(6, 0), above = known + setup.lattice.stride[1];
  grid.reached[0][known] = kind;
  grid.water_velocity[0][known] = 2;
  grid.water_mass[0][known] = grid.water_mass[0][known - 1] = grid.water_mass[0][above] = 1;
  grid.water_velocity[0][known - 1] = 0.1;
  Team alone(1);
  extrapolate_water(setup, grid, grid.water_velocity, true, grid.layers, alone);
  const Array& v = grid.water_velocity[0];
  EXPECT_EQ(v[known], 2);
  return {v[known - 1], v[known + 1], v[above]};
}

TEST(Extrapolation, OfWetCellsReplacesWhatIsAround) {
  const Extrapolated v = beyond(1);
  EXPECT_EQ(v.toward_water, 2);
  EXPECT_EQ(v.toward_nothing, 2);
  EXPECT_EQ(v.above, 2);
}

TEST(Extrapolation, OfAFilmLeavesWaterAlongItItsMomentum) {
  const Extrapolated v = beyond(film_face);
  EXPECT_EQ(v.toward_water, 0.1);
  EXPECT_EQ(v.toward_nothing, 2);
  EXPECT_EQ(v.above, 2);
}

}  // namespace
}  // namespace polder
