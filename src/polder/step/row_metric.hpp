#pragma once
// Widths, areas and distances along a row of cells or faces, compiled for equal cells, where they are constants, and
// for graded ones.
#include "polder/grid/lattice.hpp"

namespace polder {

template <class Space, bool graded>
class RowMetric;

/// Number i counts along the row from the place that it was made for.
template <class Space>
class RowMetric<Space, false> {
 public:
  RowMetric(const Lattice<Space>& lattice, const std::array<int, 3>&) : spacing_(lattice.spacing) {
    volume_ = lattice.cell_volume();
    inverse_volume_ = 1 / volume_;
    for (int a = 0; a < Space::axes; ++a) {
      area_[a] = lattice.face_area(a);
      inverse_gap_[a] = 1 / spacing_[a];
      conductance_[a] = volume_ / (spacing_[a] * spacing_[a]);
    }
  }
  double volume(int) const { return volume_; }
  /// Of the cell below the low face of cell i on an axis.
  double volume_below(int, int) const { return volume_; }
  double area(int a, int) const { return area_[a]; }  ///< of the low face of cell i; those of one axis are alike
  /// Of what a face of a component stands for, and 1 over it; on a wall half of that.
  double face_volume(int, int) const { return volume_; }
  double inverse_face_volume(int, int) const { return inverse_volume_; }
  double width(int a, int) const { return spacing_[a]; }
  double gap(int a, int) const { return spacing_[a]; }  ///< between the centres on either side of the low face
  double inverse_gap(int a, int) const { return inverse_gap_[a]; }
  double conductance(int a, int, int) const { return conductance_[a]; }  ///< area over gap; `end` 0: low face, 1: high

 private:
  std::array<double, 3> spacing_, area_{}, inverse_gap_{}, conductance_{};
  double volume_, inverse_volume_;
};

template <class Space>
class RowMetric<Space, true> {
 public:
  RowMetric(const Lattice<Space>& lattice, const std::array<int, 3>& first) : lattice_(lattice), first_(first) {
    for (int a = 1; a < Space::axes; ++a) across_ *= lattice.axis[a].width(first[a]);
  }
  double volume(int i) const { return across_ * width(0, i); }
  double volume_below(int a, int i) const { return volume(i) / width(a, i) * lattice_.axis[a].width(at(a, i) - 1); }
  double area(int a, int i) const { return volume(i) / width(a, i); }
  double face_volume(int c, int i) const {
    double v = 1;
    for (int a = 0; a < Space::axes; ++a)
      v *= a == c ? lattice_.spline[a]->face_span(at(a, i)) : lattice_.spline[a]->centre_span(at(a, i));
    return v;
  }
  double inverse_face_volume(int c, int i) const { return 1 / face_volume(c, i); }
  double width(int a, int i) const { return lattice_.axis[a].width(at(a, i)); }
  double gap(int a, int i) const { return lattice_.axis[a].gap(at(a, i)); }
  double inverse_gap(int a, int i) const { return 1 / gap(a, i); }
  double conductance(int a, int i, int end) const { return area(a, i) / lattice_.axis[a].gap(at(a, i) + end); }

 private:
  int at(int a, int i) const { return a == 0 ? first_[0] + i : first_[a]; }

  const Lattice<Space>& lattice_;
  std::array<int, 3> first_;
  double across_ = 1;
};

}  // namespace polder
