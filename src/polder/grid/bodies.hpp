#pragma once
// Rigid bodies that the grid does not follow (cut cells): the share of each face and cell that they leave open, the
// nearest point of their surface, and the normal there.
//
// A cell that a body covers almost whole counts as covered, so that no sliver has a pressure of its own. Where slivers
// come and go as bodies move, and where what is in them must be counted, cells that are covered by half count as
// covered and what is left open of them belongs to the most open cell beside them, so that no volume is lost.
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "polder/case/geometry.hpp"
#include "polder/grid/lattice.hpp"

namespace polder {

/// A body in the section (x, height); in 3d it extends all across y.
struct BodySection {
  std::vector<Point2> polygon;
  double friction = 0;   ///< tan of the angle between it and the soil; infinite: soil sticks
  Point2 velocity{};     ///< m/s, along x and upwards
  std::size_t wall = 0;  ///< its number among the walls of the case
};

/// What bodies leave open of the box between two corners: its share and its centre.
std::pair<double, Point2> open_part(std::span<const BodySection> bodies, Point2 low, Point2 high);

/// Where a point stands to the bodies.
struct BodyContact {
  double distance;  ///< m to the nearest surface; negative inside
  Point2 normal;    ///< out of the body
  double friction;
  Point2 velocity;      ///< of the body, m/s
  std::size_t section;  ///< its number
};

template <class Space>
class Bodies {
 public:
  Bodies() = default;
  /// `merges`: slivers belong to the cells beside them.
  Bodies(const Lattice<Space>& lattice, std::vector<BodySection> sections, bool merges = false);

  bool any() const { return !sections_.empty(); }
  bool moves() const { return moves_; }
  bool merges() const { return merges_; }
  /// Open share of the low face on an axis and of a cell, with the slivers that belong to it; 1 without bodies.
  double open_face(int axis, std::ptrdiff_t face) const { return any() ? face_[axis][face] : 1; }
  double open_cell(std::ptrdiff_t cell) const { return any() ? cell_[cell] : 1; }
  /// Open share of a cell itself; 0 where it counts as covered.
  double own_share(std::ptrdiff_t cell) const { return any() ? own_[cell] : 1; }
  /// m/s: velocity of the bodies times the share of this face that they close.
  double flux(int axis, std::ptrdiff_t face) const { return moves_ ? flux_[axis][face] : 0; }
  bool closed(int axis, std::ptrdiff_t face) const { return any() && face_[axis][face] == 0; }
  /// Whether the centre of this face lies in a body or on its surface, at most a cell deep, or, where slivers are
  /// merged, the face is closed; on the x and upward axes.
  bool inside(int axis, std::ptrdiff_t face) const { return any() && inside_[axis][face] != 0; }
  bool covered(std::ptrdiff_t cell) const { return any() && cell_[cell] == 0; }
  /// A body in the block of cells around this one.
  bool near(std::ptrdiff_t cell) const { return any() && near_[cell] != 0; }
  /// The same for `count` cells that follow each other along x: whether there is none.
  bool far_from(std::ptrdiff_t cell, int count) const {
    return !any() || std::memchr(&near_[cell], 1, static_cast<std::size_t>(count)) == nullptr;
  }
  /// Where the content of a covered cell belongs: the most open cell around it.
  std::ptrdiff_t open_neighbour(std::ptrdiff_t cell) const { return any() ? cell + toward_open_[cell] : cell; }

  /// To the bodies as they are `ahead` seconds later.
  BodyContact contact(Point2 x, double ahead = 0) const;
  /// Moves a position (m) out of the bodies, likewise.
  void push_out(std::array<double, 3>& x, double ahead = 0) const;
  const std::vector<BodySection>& sections() const { return sections_; }

 private:
  double open_share(Point2 from, Point2 to) const;

  Lattice<Space> lattice_;
  std::vector<BodySection> sections_;
  FaceField<Space> face_;
  Array cell_, own_;
  FaceField<Space> flux_;  // of bodies that move; else empty
  bool moves_ = false, merges_ = false;
  AlignedVector<std::uint8_t> near_;
  std::array<AlignedVector<std::uint8_t>, static_cast<std::size_t>(Space::axes)> inside_;
  AlignedVector<std::int32_t> toward_open_;
};

}  // namespace polder
