// What points read from the grid: linear fields are read exactly, up to walls that they belong to.
#include <gtest/gtest.h>

#include <random>

#include "polder/grid/walls.hpp"
#include "polder/step/gather.hpp"

namespace polder {
namespace {

/// Reads component c of a field that is `value(place)` on the faces at random points of the whole box.
template <int c, class Space, class Value>
void check_reading(const Lattice<Space>& lattice, const PhaseBox& box, Value&& value,
                   const std::array<double, 3>& slope) {
  const auto& cells = lattice.cells;
  Array field = lattice.make_array();
  for (std::ptrdiff_t at = 0; at < lattice.size - 8; ++at) {
    std::array<double, 3> x{};
    bool inside = true;
    for (int a = 0; a < Space::axes; ++a) {
      const int place = lattice.place(at, a);
      inside = inside && place >= 0 && place < cells[a] + (a == c);
      if (inside) x[a] = a == c ? lattice.axis[a].edge(place) : lattice.axis[a].centre(place);
    }
    field[at] = inside ? value(x) : std::nan("");
  }
  reflect(field, c, true, box, lattice, true);
  std::mt19937 random(19);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 1000; ++trial) {
    std::array<std::array<double, 1>, 3> place{};
    std::array<double, 3> x{};
    std::array<const double*, static_cast<std::size_t>(Space::axes)> pointers{};
    for (int a = 0; a < Space::axes; ++a) {
      // every fourth point within a hundredth of a cell of a wall
      const double share = trial % 4 == 0
                               ? (uniform(random) < 0.5 ? 0.0 : 1.0) + (uniform(random) - 0.5) * 0.02 / cells[a]
                               : uniform(random);
      x[a] = std::clamp(share, 1e-9, 1 - 1e-9) * lattice.length(a);
      place[a][0] = x[a];
      pointers[a] = place[a].data();
    }
    ChunkWeights<Space> chunk;
    chunk.compute_places(lattice, pointers, 1);
    Gathered<Space> out;
    double gradient[Space::axes][chunk_room];
    // lanes of weight zero may be no numbers: they are cleared as the step has them
    Array readable = field;
    for (double& v : readable)
      if (std::isnan(v)) v = 0;
    by_spacing(lattice, [&]<bool graded>() {
      gather_component<c, true, graded>(lattice, chunk, 1, readable.data(), out, gradient);
    });
    ASSERT_NEAR(out.value[0], value(x), 1e-12) << "trial " << trial;
    for (int a = 0; a < Space::axes; ++a) {
      const double h = lattice.spacing[a], inertia = lattice.graded ? chunk.inertia[a][a == c][0] : 0.25;
      ASSERT_NEAR(gradient[a][0], slope[a], 2e-11) << "trial " << trial << " axis " << a;
      const double moment = out.moment[a][0] - chunk.from_reference(c, a, 0, lattice.graded) * out.value[0];
      ASSERT_NEAR(moment / (h * inertia), slope[a], 2e-11) << "trial " << trial << " axis " << a;
    }
  }
}

template <int c, class Space, class Value>
void check_reading(const std::array<int, 3>& cells, const std::array<double, 3>& spacing, const PhaseBox& box,
                   Value&& value, const std::array<double, 3>& slope) {
  check_reading<c>(Lattice<Space>(cells, spacing), box, value, slope);
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

/// Cells finer in the middle of x, at the low end of the height, and in 3d at the high end of y.
template <class Space>
Lattice<Space> graded_lattice() {
  const GridAxis x(3, 0.4, {{1.4, 1.5, 0.02, 1.2}}), y(1, 0.2, {{0.8, 1, 0.05, 1.3}}),
      up(1, 0.2, {{0, 0.1, 0.025, 1.4}});
  if constexpr (Space::axes == 3)
    return Lattice<Space>({x, y, up});
  else
    return Lattice<Space>({x, up, GridAxis()});
}

TEST(Points, ReadLinearFieldsUpToTheWallsOnGradedSpacing) {
  const auto plane = graded_lattice<PlaneStrain>();
  PhaseBox box;
  box.high = {plane.cells[0], plane.cells[1], 1};
  box.wall[0] = {WallKind::open, WallKind::open};
  box.wall[1] = {WallKind::rough, WallKind::rough};
  box.velocity[1][0][0] = -0.3;
  box.velocity[1][1][0] = 0.7;
  check_reading<0>(plane, box, [](const auto& x) { return -0.3 + x[1]; }, {0, 1, 0});
  const auto solid = graded_lattice<Solid>();
  box = {};
  box.high = solid.cells;
  box.velocity[2][0][2] = 0.2;
  box.velocity[2][1][2] = -0.4;
  check_reading<2>(solid, box, [](const auto& x) { return 0.2 - 0.6 * x[2]; }, {0, 0, -0.6});
  box.velocity = {};
  box.velocity[0][1][0] = 0.9;
  check_reading<0>(solid, box, [](const auto& x) { return 0.3 * x[0]; }, {0.3, 0, 0});
}

}  // namespace
}  // namespace polder
