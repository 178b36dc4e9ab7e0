// What points read from the grid: linear fields are read exactly, up to walls that they belong to.
#include <gtest/gtest.h>

#include <random>

#include "polder/grid/walls.hpp"
#include "polder/step/gather.hpp"

namespace polder {
namespace {

/// Reads component c of a field that is `value(place)` on the faces at random points of the whole box.
template <int c, class Space, class Value>
void check_reading(const std::array<int, 3>& cells, const std::array<double, 3>& spacing, const PhaseBox& box,
                   Value&& value, const std::array<double, 3>& slope) {
  const Lattice<Space> lattice(cells, spacing);
  Array field = lattice.make_array();
  for (std::ptrdiff_t at = 0; at < lattice.size - 8; ++at) {
    std::array<double, 3> x{};
    for (int a = 0; a < Space::axes; ++a) x[a] = (lattice.place(at, a) + (a == c ? 0 : 0.5)) * spacing[a];
    bool inside = true;
    for (int a = 0; a < Space::axes; ++a)
      inside = inside && lattice.place(at, a) >= 0 && lattice.place(at, a) < cells[a] + (a == c);
    field[at] = inside ? value(x) : std::nan("");
  }
  reflect(field, c, true, box, lattice, true);
  std::mt19937 random(19);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 400; ++trial) {
    std::array<std::array<double, 1>, 3> place{};
    std::array<double, 3> x{};
    std::array<const double*, static_cast<std::size_t>(Space::axes)> pointers{};
    for (int a = 0; a < Space::axes; ++a) {
      // every fourth point within a hundredth of a cell of a wall
      const double share = trial % 4 == 0
                               ? (uniform(random) < 0.5 ? 0.0 : 1.0) + (uniform(random) - 0.5) * 0.02 / cells[a]
                               : uniform(random);
      x[a] = std::clamp(share, 1e-9, 1 - 1e-9) * cells[a] * spacing[a];
      place[a][0] = x[a];
      pointers[a] = place[a].data();
    }
    ChunkWeights<Space> chunk;
    chunk.compute(lattice, pointers, 1);
    Gathered<Space> out;
    // lanes of weight zero may be no numbers: they are cleared as the step has them
    Array readable = field;
    for (double& v : readable)
      if (std::isnan(v)) v = 0;
    gather_component<c, true>(lattice, chunk, 1, readable.data(), out);
    ASSERT_NEAR(out.value[0], value(x), 1e-12) << "trial " << trial;
    for (int a = 0; a < Space::axes; ++a) {
      ASSERT_NEAR(out.gradient[a][0] / spacing[a], slope[a], 1e-11) << "trial " << trial << " axis " << a;
      ASSERT_NEAR(4 / spacing[a] * out.moment[a][0], slope[a], 1e-11) << "trial " << trial << " axis " << a;
    }
  }
}

TEST(Points, ReadLinearFieldsUpToTheWallsInPlaneStrain) {
  PhaseBox box;
  box.high = {7, 5, 1};
  box.wall[0] = {WallKind::periodic, WallKind::periodic};
  box.wall[1] = {WallKind::rough, WallKind::rough};
  const std::array<int, 3> cells{7, 5, 1};
  const std::array<double, 3> h{0.5, 0.2, 1};
  const double height = 5 * 0.2;
  // along x between plates that move by −0.3 and 0.7: linear across, even at the smooth ends
  box.velocity[1][0][0] = -0.3;
  box.velocity[1][1][0] = 0.7;
  check_reading<0, PlaneStrain>(cells, h, box, [&](const auto& x) { return -0.3 + x[1] / height; }, {0, 1 / height, 0});
}

TEST(Points, ReadASqueezeBetweenMovingPlates) {
  PhaseBox box;
  box.high = {6, 5, 4};
  const std::array<int, 3> cells{6, 5, 4};
  const std::array<double, 3> h{0.5, 0.2, 0.25};
  box.velocity[2][0][2] = 0.2;
  box.velocity[2][1][2] = -0.4;
  check_reading<2, Solid>(cells, h, box, [](const auto& x) { return 0.2 - 0.6 * x[2]; }, {0, 0, -0.6});
}

}  // namespace
}  // namespace polder
