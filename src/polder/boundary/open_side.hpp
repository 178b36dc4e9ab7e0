#pragma once
// Sides of the model through which water passes: with a given head, or with a given discharge into the model.
//
// A side with a head H has the pressure ρ_w g (H − height) on its faces below H; above H it is a seepage face, where
// water may leave at pressure zero and none comes in. What enters is owed to the row of cells along the side, and paid
// in layers of points as soon as a layer has come in; points that pass the side are gone. Beyond a side that only lets
// out is air, at pressure zero: a head that no water reaches, and nothing is owed. A side may be open in a part
// of it only (an orifice); the rest is a smooth wall to the water.
#include <vector>

#include "polder/case/model.hpp"
#include "polder/grid/lattice.hpp"
#include "polder/grid/walls.hpp"

namespace polder {

struct OpenSide {
  int axis = 0, end = 0;  ///< end 0: low, 1: high
  bool prescribes_head = true;
  Table value;               ///< head, m above datum; or discharge into the model, m/s; of the time in s
  PhaseBox::Opening part{};  ///< of the side
  bool only_out = false;     ///< nothing comes in: beyond it is air

  /// Outward normal along the axis.
  double outward() const { return end == 0 ? -1 : 1; }
};

/// body(index of the face, index of the cell inside, index of the cell outside, the cell's place) along the open part
/// of a side.
template <class Space, class Body>
void over_side(const Lattice<Space>& lattice, const OpenSide& side, Body&& body) {
  const int axis = side.axis, end = side.end;
  std::array<int, 3> count{1, 1, 1};
  for (int a = 0; a < Space::axes; ++a) count[a] = a == axis ? 1 : lattice.cells[a];
  for (int k = 0; k < count[2]; ++k)
    for (int j = 0; j < count[1]; ++j)
      for (int i = 0; i < count[0]; ++i) {
        std::array<int, 3> at{i, j, k};
        at[axis] = end == 0 ? 0 : lattice.cells[axis] - 1;
        if (!side.part.covers(at[along_side<Space>(axis)])) continue;
        const std::ptrdiff_t inside = lattice.index(at[0], at[1], at[2]), s = lattice.stride[axis];
        body(end == 0 ? inside : inside + s, inside, end == 0 ? inside - s : inside + s, at);
      }
}

}  // namespace polder
