#pragma once
// Over which volumes and areas pore pressure acts in the cells of the unsaturated formulation, where these are not all
// alike: those that the splines give them, so that it balances the stress of the points that are in them
// (docs/theory.md, "Unsaturated soil").
#include <array>

#include "polder/grid/lattice.hpp"

namespace polder {

/// Width of cell i over that of the smallest on the axis.
template <class Space>
double relative_width(const Lattice<Space>& lattice, int axis, int i) {
  return lattice.axis[axis].width(i) / lattice.spacing[axis];
}

/// Weight of a cell that is full of soil (PoreFields::weight): spans of the centre splines across the axis, smallest
/// cell along it, m³.
template <class Space>
double full_weight(const Lattice<Space>& lattice, int axis, const std::array<int, 3>& at) {
  if (!lattice.graded) return lattice.cell_volume();
  double w = lattice.spacing[axis];
  for (int b = 0; b < Space::axes; ++b)
    if (b != axis) w *= lattice.spline[b]->centre_span(at[b]);
  return w;
}

/// Area across the axis of a cell over that by the spans: what its change of volume is counted by.
template <class Space>
double true_area(const Lattice<Space>& lattice, int axis, const std::array<int, 3>& at) {
  if (!lattice.graded) return 1;
  double share = 1;
  for (int b = 0; b < Space::axes; ++b)
    if (b != axis) share *= lattice.axis[b].width(at[b]) / lattice.spline[b]->centre_span(at[b]);
  return share;
}

}  // namespace polder
