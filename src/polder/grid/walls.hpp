#pragma once
// Walls aligned with the grid, by mirror folding.
//
// Each phase lives in a box of cells. What spline weights write beyond a wall is added to its mirror image (fold), and
// what they read there is the mirror image (reflect): even for scalars, masses and, at a smooth wall, tangential
// components; odd for the component normal to the wall and, at a fully rough wall, for the tangential ones too. At a
// side that is open, and at one that absorbs waves, all is even: what lies beyond moves as what is inside. A side may
// be open in a part of it only. Walls may move: then what is odd is so about the wall's velocity. Where the model is
// periodic along x, what lies beyond one end is what is inside the other, and the faces on the two ends are the same.
#include <algorithm>
#include <array>
#include <limits>

#include "polder/grid/lattice.hpp"

namespace polder {

enum class WallKind { smooth, rough, open, absorbing, periodic };

/// Whether the component normal to a wall of this kind may be other than zero on it.
constexpr bool moves(WallKind kind) { return kind == WallKind::open || kind == WallKind::absorbing; }

struct PhaseBox {
  std::array<int, 3> low{0, 0, 0};                ///< first cell inside, per axis
  std::array<int, 3> high{1, 1, 1};               ///< one past the last cell inside
  std::array<std::array<WallKind, 2>, 3> wall{};  ///< [axis][0: low side, 1: high side]

  /// The part of an open side that is open: cells [from, to) along x, of sides across x along the height.
  struct Opening {
    int from = std::numeric_limits<int>::min(), to = std::numeric_limits<int>::max();
    bool whole() const { return from == std::numeric_limits<int>::min(); }
    bool covers(int cell) const { return cell >= from && cell < to; }
  };
  std::array<std::array<Opening, 2>, 3> opening{};  ///< [axis][side], where the wall is open

  std::array<std::array<std::array<double, 3>, 2>, 3> velocity{};  ///< [axis][side][component], m/s, of the wall now

  bool periodic(int axis) const { return wall[static_cast<std::size_t>(axis)][0] == WallKind::periodic; }
};

/// Axis along which the opening of a side is counted.
template <class Space>
constexpr int along_side(int axis) {
  return axis == 0 ? Space::up : 0;
}

/// What a call deals with: the ends of rows along x, of rows [first_row, end_row) as they lie in memory, ghosts
/// included; what lies beyond the sides across other axes. To share out a field: the ends of each thread's rows, then
/// other_sides.
struct MirrorShare {
  std::ptrdiff_t first_row = 0, end_row = std::numeric_limits<std::ptrdiff_t>::max();
  bool row_ends = true, other_sides = true;

  bool has(int axis) const { return axis == 0 ? row_ends : other_sides; }
};
inline constexpr MirrorShare other_sides{0, 0, false, true};

/// The ends of rows [begin, end) of cells; with the first and the last go those of the ghost rows beyond.
template <class Space>
MirrorShare ends_of_rows(const Lattice<Space>& lattice, std::ptrdiff_t begin, std::ptrdiff_t end) {
  const auto in_memory = [&](std::ptrdiff_t row) {
    if (row <= 0) return std::ptrdiff_t{0};
    if (row >= lattice.row_count()) return std::numeric_limits<std::ptrdiff_t>::max();
    return lattice.index(0, static_cast<int>(row % lattice.cells[1]), static_cast<int>(row / lattice.cells[1])) /
           lattice.stride[1];
  };
  return {in_memory(begin), in_memory(end), true, false};
}

namespace detail {

/// Calls body(offset, place along each axis) for every position of the plane across `axis`, ghosts of the other axes
/// included.
template <class Space, class Body>
void over_plane(const Lattice<Space>& lattice, int axis, const MirrorShare& share, Body&& body) {
  if (!share.has(axis)) return;
  std::ptrdiff_t count[3] = {1, 1, 1};
  for (int a = 0; a < Space::axes; ++a)
    count[a] = a == axis ? 1 : lattice.cells[a] + Lattice<Space>::ghost_low + Lattice<Space>::ghost_high;
  if (axis == 0) {
    const std::ptrdiff_t last = std::min(share.end_row, count[1] * count[2]);
    for (std::ptrdiff_t row = share.first_row; row < last; ++row)
      body(row * lattice.stride[1], std::array<std::ptrdiff_t, 3>{0, row % count[1], row / count[1]});
    return;
  }
  for (std::ptrdiff_t k = 0; k < count[2]; ++k)
    for (std::ptrdiff_t j = 0; j < count[1]; ++j)
      for (std::ptrdiff_t i = 0; i < count[0]; ++i)
        body(i + j * lattice.stride[1] + k * lattice.stride[2], std::array<std::ptrdiff_t, 3>{i, j, k});
}

/// Calls body(ghost, image, sign, twice the velocity of the wall) for every pair of positions that a wall makes mirror
/// images of each other: the value at the ghost is sign × that at the image + twice the wall's velocity.
template <class Space, class Body>
void over_mirrors(int component, bool motion, const PhaseBox& box, const Lattice<Space>& lattice,
                  const MirrorShare& share, Body&& body) {
  for (int axis = 0; axis < Space::axes; ++axis) {
    const bool normal = component == axis;
    const std::ptrdiff_t s = lattice.stride[axis], origin = Lattice<Space>::ghost_low * s;
    for (int side = 0; side < 2; ++side) {
      const WallKind kind = box.wall[axis][side];
      if (kind == WallKind::periodic) {
        const std::ptrdiff_t cells = lattice.cells[axis];
        const std::ptrdiff_t ghost = origin + (side == 0 ? -1 : normal ? cells + 1 : cells) * s;
        const std::ptrdiff_t image = ghost + (side == 0 ? cells : -cells) * s;
        over_plane(lattice, axis, share,
                   [&](std::ptrdiff_t at, const auto&) { body(at + ghost, at + image, 1.0, 0.0); });
        continue;
      }
      const bool odd = normal ? !moves(kind) : kind == WallKind::rough;
      const double sign = motion && odd ? -1.0 : 1.0;
      const double twice = motion && odd && component >= 0 ? 2 * box.velocity[axis][side][component] : 0.0;
      // faces normal to the wall sit on it and mirror about it; everything else is half a cell off
      const int low = box.low[axis], high = box.high[axis];
      const std::ptrdiff_t ghost = origin + (side == 0 ? low - 1 : normal ? high + 1 : high) * s;
      const std::ptrdiff_t image = origin + (side == 1 ? high - 1 : normal ? low + 1 : low) * s;
      const PhaseBox::Opening& opening = box.opening[axis][side];
      if (motion && normal && kind == WallKind::open && !opening.whole()) {
        const std::size_t along = static_cast<std::size_t>(along_side<Space>(axis));
        over_plane(lattice, axis, share, [&](std::ptrdiff_t at, const std::array<std::ptrdiff_t, 3>& place) {
          const bool opened = opening.covers(static_cast<int>(place[along] - Lattice<Space>::ghost_low));
          body(at + ghost, at + image, opened ? 1.0 : -1.0, 0.0);
        });
        continue;
      }
      over_plane(lattice, axis, share,
                 [&](std::ptrdiff_t at, const auto&) { body(at + ghost, at + image, sign, twice); });
    }
  }
}

/// Calls body(face on the low end, face on the high end) for the pairs that are one where the model is periodic.
template <class Space, class Body>
void over_joined(int component, const PhaseBox& box, const Lattice<Space>& lattice, const MirrorShare& share,
                 Body&& body) {
  if (component < 0 || !box.periodic(component)) return;
  const std::ptrdiff_t s = lattice.stride[component], low = Lattice<Space>::ghost_low * s;
  over_plane(lattice, component, share,
             [&](std::ptrdiff_t at, const auto&) { body(at + low, at + low + lattice.cells[component] * s); });
}

}  // namespace detail

/// Adds what lies beyond the walls to its mirror image and clears it. `component`: axis of a face field, −1 for cells.
/// `motion`: true for momentum, force, velocity (signs by kind of wall); false for masses and other scalars.
template <class Space>
void fold(Array& field, int component, bool motion, const PhaseBox& box, const Lattice<Space>& lattice,
          const MirrorShare& share = {}) {
  detail::over_mirrors(component, motion, box, lattice, share,
                       [&](std::ptrdiff_t ghost, std::ptrdiff_t image, double sign, double) {
                         field[image] += sign * field[ghost];
                         field[ghost] = 0;
                       });
  detail::over_joined(component, box, lattice, share,
                      [&](std::ptrdiff_t low, std::ptrdiff_t high) { field[low] = field[high] += field[low]; });
}

/// fold() of a mass and of its momentum, of walls that may move.
template <class Space>
void fold_motion(Array& mass, Array& momentum, int component, const PhaseBox& box, const Lattice<Space>& lattice,
                 const MirrorShare& share = {}) {
  detail::over_mirrors(component, true, box, lattice, share,
                       [&](std::ptrdiff_t ghost, std::ptrdiff_t image, double sign, double twice) {
                         momentum[image] += sign * momentum[ghost] - sign * twice * mass[ghost];
                         mass[image] += mass[ghost];
                         momentum[ghost] = mass[ghost] = 0;
                       });
  detail::over_joined(component, box, lattice, share, [&](std::ptrdiff_t low, std::ptrdiff_t high) {
    mass[low] = mass[high] += mass[low];
    momentum[low] = momentum[high] += momentum[low];
  });
}

/// Clears what lies beyond the walls.
template <class Space>
void clear_beyond(Array& field, int component, const PhaseBox& box, const Lattice<Space>& lattice,
                  const MirrorShare& share = {}) {
  detail::over_mirrors(component, false, box, lattice, share,
                       [&](std::ptrdiff_t ghost, std::ptrdiff_t, double, double) { field[ghost] = 0; });
}

namespace detail {

/// Calls body(ghost, face on the wall, image) for the component normal to walls that absorb waves.
template <class Space, class Body>
void over_absorbing(int component, const PhaseBox& box, const Lattice<Space>& lattice, const MirrorShare& share,
                    Body&& body) {
  if (component < 0) return;
  const std::ptrdiff_t s = lattice.stride[component], origin = Lattice<Space>::ghost_low * s;
  for (int side = 0; side < 2; ++side) {
    if (box.wall[component][side] != WallKind::absorbing) continue;
    const std::ptrdiff_t on = origin + (side == 0 ? box.low[component] : box.high[component]) * s;
    const std::ptrdiff_t out = side == 0 ? -s : s;
    over_plane(lattice, component, share,
               [&](std::ptrdiff_t at, const auto&) { body(at + on + out, at + on, at + on - out); });
  }
}

}  // namespace detail

/// Before fold(), for forces: what they do beyond a wall that absorbs waves to motion that goes on linearly there, so
/// that what holds the wall acts on its own faces alone.
template <class Space>
void release_forces(Array& field, int component, const PhaseBox& box, const Lattice<Space>& lattice,
                    const MirrorShare& share = {}) {
  detail::over_absorbing(component, box, lattice, share,
                         [&](std::ptrdiff_t ghost, std::ptrdiff_t on, std::ptrdiff_t image) {
                           field[on] += 2 * field[ghost];
                           field[image] -= field[ghost];
                           field[ghost] = 0;
                         });
}

/// Fills what lies beyond the walls with its mirror image; across a wall that absorbs waves, motion goes on linearly.
/// Arguments as for fold(); `moving`: a velocity, which the walls' own counts for, and not a difference of velocities.
template <class Space>
void reflect(Array& field, int component, bool motion, const PhaseBox& box, const Lattice<Space>& lattice,
             bool moving = false) {
  detail::over_joined(component, box, lattice, {},
                      [&](std::ptrdiff_t low, std::ptrdiff_t high) { field[high] = field[low]; });
  detail::over_mirrors(component, motion, box, lattice, {},
                       [&](std::ptrdiff_t ghost, std::ptrdiff_t image, double sign, double twice) {
                         field[ghost] = sign * field[image];
                         if (moving) field[ghost] += twice;
                       });
  if (motion)
    detail::over_absorbing(component, box, lattice, {},
                           [&](std::ptrdiff_t ghost, std::ptrdiff_t on, std::ptrdiff_t image) {
                             field[ghost] = 2 * field[on] - field[image];
                           });
}

/// Where the model is periodic, copies what the cells on either end hold to the ghosts beyond the other.
template <class Space, class Field>
void join_ends(Field& cells, const PhaseBox& box, const Lattice<Space>& lattice) {
  for (int axis = 0; axis < Space::axes; ++axis) {
    if (!box.periodic(axis)) continue;
    const std::ptrdiff_t s = lattice.stride[axis], low = Lattice<Space>::ghost_low * s, n = lattice.cells[axis] * s;
    detail::over_plane(lattice, axis, {}, [&](std::ptrdiff_t at, const auto&) {
      cells[at + low - s] = cells[at + low + n - s];
      cells[at + low + n] = cells[at + low];
    });
  }
}

}  // namespace polder
