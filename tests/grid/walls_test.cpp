#include "polder/grid/walls.hpp"

#include <gtest/gtest.h>

#include <random>

namespace polder {
namespace {

template <class Space>
void check_adjoint(const std::array<int, 3>& cells) {
  const Lattice<Space> lattice(cells, {1, 1, 1});
  PhaseBox box;
  box.high = {cells[0], cells[1], Space::axes == 3 ? cells[2] : 1};
  box.low[0] = 2;
  box.wall[1][0] = WallKind::rough;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int c = -1; c < Space::axes; ++c)
    for (const bool motion : {false, true}) {
      // random content where the stencils of points inside the box may reach
      Array a = lattice.make_array(), b = lattice.make_array();
      const auto fill = [&](Array& f, int margin) {
        for (std::ptrdiff_t at = 0; at < lattice.size - 8; ++at) {
          bool reach = true;
          for (int axis = 0; axis < Space::axes; ++axis) {
            const int place = lattice.place(at, axis), normal = c == axis;
            reach = reach && place >= box.low[axis] - margin && place < box.high[axis] + normal + margin;
          }
          if (reach) f[at] = uniform(random);
        }
      };
      fill(a, 1);
      fill(b, 0);
      Array folded = a, reflected = b;
      fold(folded, c, motion, box, lattice);
      reflect(reflected, c, motion, box, lattice);
      double left = 0, right = 0;
      for (std::ptrdiff_t at = 0; at < lattice.size; ++at) {
        left += folded[at] * b[at];
        right += a[at] * reflected[at];
      }
      EXPECT_NEAR(left, right, 1e-12) << "component " << c << " motion " << motion;
    }
}

TEST(MirrorWalls, ReadingIsTheTransposeOfWriting) {
  check_adjoint<PlaneStrain>({7, 5, 1});
  check_adjoint<Solid>({6, 5, 4});
}

/// What fold() does to a field, shared out by rows in two parts and then the other sides, is what it does at once.
template <class Space>
void check_shares(const std::array<int, 3>& cells, WallKind along_x) {
  const Lattice<Space> lattice(cells, {1, 1, 1});
  PhaseBox box;
  box.high = {cells[0], cells[1], Space::axes == 3 ? cells[2] : 1};
  box.wall[0] = {along_x, along_x};
  box.wall[1][0] = WallKind::rough;
  std::mt19937 random(5);
  std::uniform_int_distribution<int> whole(-1000, 1000);  // sums of them are exact in any order
  for (int c = -1; c < Space::axes; ++c) {
    Array at_once = lattice.make_array();
    for (double& v : at_once) v = whole(random);
    Array shared = at_once;
    fold(at_once, c, true, box, lattice);
    const std::ptrdiff_t rows = lattice.row_count(), cut = rows / 2 + 1;
    fold(shared, c, true, box, lattice, ends_of_rows(lattice, cut, rows));
    fold(shared, c, true, box, lattice, ends_of_rows(lattice, 0, cut));
    fold(shared, c, true, box, lattice, other_sides);
    EXPECT_EQ(shared, at_once) << "component " << c;
  }
}

TEST(MirrorWalls, AreFoldedBackInSharesOfRowsAsAtOnce) {
  for (const WallKind kind : {WallKind::smooth, WallKind::rough, WallKind::periodic}) {
    check_shares<PlaneStrain>({7, 5, 1}, kind);
    check_shares<Solid>({6, 5, 4}, kind);
  }
}

}  // namespace
}  // namespace polder
