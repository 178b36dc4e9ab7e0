#include "polder/grid/thin_walls.hpp"

#include <algorithm>

namespace polder {

namespace {

using Offset = std::array<int, 3>;

template <class Space>
int block_number(const Offset& o) {
  return (o[0] + 1) + 3 * (o[1] + 1) + (Space::axes == 3 ? 9 * (o[2] + 1) : 0);
}

template <class Space>
std::ptrdiff_t step_of(const Lattice<Space>& lattice, const Offset& o) {
  std::ptrdiff_t at = 0;
  for (int a = 0; a < Space::axes; ++a) at += o[a] * lattice.stride[a];
  return at;
}

/// body(offset) over the block of cells around one.
template <class Space, class Body>
void over_block(Body&& body) {
  const int depth = Space::axes == 3 ? 1 : 0;
  for (int k = -depth; k <= depth; ++k)
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) body(Offset{i, j, k});
}

}  // namespace

template <class Space>
ThinWalls<Space>::ThinWalls(const Lattice<Space>& lattice) : lattice_(lattice) {
  for (auto& f : faces_) f.assign(static_cast<std::size_t>(lattice.size), 0);
}

template <class Space>
void ThinWalls<Space>::close(int axis, std::array<int, 3> cell, WallFaceKind kind) {
  if (cell[axis] <= 0 || cell[axis] >= lattice_.cells[axis]) return;  // the model's own walls are there
  // into the ghosts beside it too: what lies beyond the model is its mirror image
  int low[3], high[3];
  for (int a = 0; a < 3; ++a) {
    low[a] = high[a] = cell[a];
    if (a >= Space::axes || a == axis) continue;
    if (cell[a] == 0) low[a] = -1;
    if (cell[a] == lattice_.cells[a] - 1) high[a] = lattice_.cells[a];
  }
  for (int k = low[2]; k <= high[2]; ++k)
    for (int j = low[1]; j <= high[1]; ++j)
      for (int i = low[0]; i <= high[0]; ++i) {
        auto& face = faces_[axis][lattice_.index(i, j, k)];
        face = std::max(face, static_cast<std::uint8_t>(kind));
      }
  any_ = true;
}

template <class Space>
void ThinWalls<Space>::finish() {
  stencils_.clear();
  stencil_of_.assign(static_cast<std::size_t>(lattice_.size), -1);
  if (!any_) return;
  const int nz = Space::axes == 3 ? lattice_.cells[2] : 1;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < lattice_.cells[1]; ++j)
      for (int i = 0; i < lattice_.cells[0]; ++i) {
        const std::ptrdiff_t cell = lattice_.index(i, j, k);
        bool beside = false;  // a wall between two cells of the block
        over_block<Space>([&](const Offset& o) {
          for (int a = 0; a < Space::axes; ++a)
            beside = beside || (o[a] >= 0 && blocked(a, cell + step_of(lattice_, o)));
        });
        if (!beside) continue;
        stencil_of_[cell] = static_cast<std::int32_t>(stencils_.size());
        stencils_.push_back(stencil_at(cell));
      }
}

template <class Space>
WallStencil<Space> ThinWalls<Space>::stencil_at(std::ptrdiff_t cell) const {
  constexpr int axes = Space::axes;
  WallStencil<Space> stencil;
  std::array<bool, WallStencil<Space>::block> reached{};
  bool rough = false;
  // in the order of the number of steps that an offset takes
  for (int steps = 0; steps <= axes; ++steps)
    over_block<Space>([&](const Offset& o) {
      if (std::abs(o[0]) + std::abs(o[1]) + std::abs(o[2]) != steps) return;
      bool& here = reached[block_number<Space>(o)];
      here = steps == 0;
      for (int a = 0; a < axes; ++a) {
        if (o[a] == 0) continue;
        Offset before = o;
        before[a] = 0;
        const std::ptrdiff_t face = cell + step_of(lattice_, o[a] > 0 ? o : before);
        here = here || (reached[block_number<Space>(before)] && !blocked(a, face));
        rough = rough || faces_[a][face] == static_cast<std::uint8_t>(WallFaceKind::rough);
      }
    });
  for (int a = 0; a < axes; ++a) stencil.shut[a] = {blocked(a, cell), blocked(a, cell + lattice_.stride[a])};
  over_block<Space>([&](const Offset& o) {
    const int number = block_number<Space>(o);
    stencil.cell[number] = reached[number] ? static_cast<std::int32_t>(step_of(lattice_, o)) : 0;
  });

  for (int c = 0; c < axes; ++c) {
    const auto seen = [&](const Offset& o) {  // from one of the two cells that the face bounds
      for (const int side : {-1, 0}) {
        Offset of = o;
        of[c] += side;
        if (of[c] >= -1 && of[c] <= 1 && reached[block_number<Space>(of)]) return true;
      }
      return false;
    };
    const auto place = [&](const Offset& o) {
      auto& node = stencil.of[c][WallStencil<Space>::node(o[0], o[1], o[2])];
      // mirrored on as few axes as make it seen, the component's own before the others
      for (int count = 0; count <= axes; ++count)
        for (int pass = 0; pass < 2; ++pass)
          for (int set = 0; set < 1 << axes; ++set) {
            if (__builtin_popcount(static_cast<unsigned>(set)) != count || ((set >> c & 1) != 0) == (pass != 0))
              continue;
            Offset image = o;
            double sign = 1;
            bool possible = true;
            for (int a = 0; a < axes; ++a) {
              if ((set >> a & 1) == 0) continue;
              if (a == c) {
                possible = possible && (o[a] == -1 || o[a] == 2);
                image[a] = 1 - o[a] > 0 ? 1 : 0;  // −1 → 1 about the low face, 2 → 0 about the high one
                sign = -sign;
              } else {
                possible = possible && o[a] != 0;
                image[a] = 0;
                if (rough) sign = -sign;
              }
            }
            if (!possible || !seen(image)) continue;
            node = {static_cast<std::int32_t>(step_of(lattice_, image)), sign};
            return;
          }
    };
    for (int k = axes == 3 ? -1 : 0; k <= (axes == 3 ? 1 + (c == 2) : 0); ++k)
      for (int j = -1; j <= 1 + (c == 1); ++j)
        for (int i = -1; i <= 1 + (c == 0); ++i) place({i, j, k});
  }
  return stencil;
}

template <class Space>
void stop_at_walls(const Lattice<Space>& lattice, const ThinWalls<Space>& walls, const std::array<double, 3>& from,
                   std::array<double, 3>& to) {
  constexpr int axes = Space::axes;
  Offset cell{0, 0, 0}, goal{0, 0, 0};
  for (int a = 0; a < axes; ++a) {
    cell[a] = static_cast<int>(lattice.axis[a].place(from[a]));
    goal[a] = static_cast<int>(lattice.axis[a].place(to[a]));
  }
  while (true) {
    int axis = -1;
    double first = 2;
    for (int a = 0; a < axes; ++a) {
      if (cell[a] == goal[a]) continue;
      const double plane = lattice.axis[a].edge(goal[a] > cell[a] ? cell[a] + 1 : cell[a]);
      const double share = (plane - from[a]) / (to[a] - from[a]);
      if (axis < 0 || share < first) axis = a, first = share;
    }
    if (axis < 0) return;
    const bool up = goal[axis] > cell[axis];
    const std::ptrdiff_t face = lattice.index(cell[0], cell[1], cell[2]) + (up ? lattice.stride[axis] : 0);
    if (walls.blocked(axis, face)) {
      to[axis] = lattice.axis[axis].at_place(up ? cell[axis] + 1 - wall_gap : cell[axis] + wall_gap);
      goal[axis] = cell[axis];
    } else {
      cell[axis] += up ? 1 : -1;
    }
  }
}

template class ThinWalls<PlaneStrain>;
template class ThinWalls<Solid>;
template void stop_at_walls(const Lattice<PlaneStrain>&, const ThinWalls<PlaneStrain>&, const std::array<double, 3>&,
                            std::array<double, 3>&);
template void stop_at_walls(const Lattice<Solid>&, const ThinWalls<Solid>&, const std::array<double, 3>&,
                            std::array<double, 3>&);

}  // namespace polder
