#pragma once
// Rigid bodies that the grid does not follow (cut cells): the share of each face and cell that they leave open, the
// nearest point of their surface, and the normal there.
//
// A cell that a body covers almost whole counts as covered, so that no sliver has a pressure of its own.
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "polder/case/geometry.hpp"
#include "polder/grid/lattice.hpp"

namespace polder {

/// A body in the section (x, height); in 3d it extends all across y.
struct BodySection {
  std::vector<Point2> polygon;
  double friction = 0;  ///< tan of the angle between it and the soil; infinite: soil sticks
};

/// What bodies leave open of the box between two corners: its share and its centre.
std::pair<double, Point2> open_part(std::span<const BodySection> bodies, Point2 low, Point2 high);

/// Where a point stands to the bodies.
struct BodyContact {
  double distance;  ///< m to the nearest surface; negative inside
  Point2 normal;    ///< out of the body
  double friction;
};

template <class Space>
class Bodies {
 public:
  Bodies() = default;
  Bodies(const Lattice<Space>& lattice, std::vector<BodySection> sections);

  bool any() const { return !sections_.empty(); }
  /// Open share of the low face on an axis and of a cell; 1 without bodies.
  double open_face(int axis, std::ptrdiff_t face) const { return any() ? face_[axis][face] : 1; }
  double open_cell(std::ptrdiff_t cell) const { return any() ? cell_[cell] : 1; }
  bool closed(int axis, std::ptrdiff_t face) const { return any() && face_[axis][face] == 0; }
  bool covered(std::ptrdiff_t cell) const { return any() && cell_[cell] == 0; }
  /// A body in the block of cells around this one.
  bool near(std::ptrdiff_t cell) const { return any() && near_[cell] != 0; }
  /// Where the content of a covered cell belongs: the most open cell around it.
  std::ptrdiff_t open_neighbour(std::ptrdiff_t cell) const { return any() ? cell + toward_open_[cell] : cell; }

  BodyContact contact(Point2 x) const;
  /// Moves a position (m) out of the bodies.
  void push_out(std::array<double, 3>& x) const;
  const std::vector<BodySection>& sections() const { return sections_; }

 private:
  double open_share(Point2 from, Point2 to) const;

  Lattice<Space> lattice_;
  std::vector<BodySection> sections_;
  FaceField<Space> face_;
  Array cell_;
  AlignedVector<std::uint8_t> near_;
  AlignedVector<std::int32_t> toward_open_;
};

}  // namespace polder
