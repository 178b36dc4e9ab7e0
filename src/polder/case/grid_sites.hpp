#pragma once
// The places at which points are seeded along an axis: each cell is cut into as many equal parts.
#include "polder/case/grid_axis.hpp"

namespace polder {

class SiteAxis {
 public:
  SiteAxis() = default;
  SiteAxis(const GridAxis& axis, int per_cell) : axis_(axis), per_cell_(per_cell), width_(axis.least() / per_cell) {}

  int count() const { return axis_.cells() * per_cell_; }
  int cell(int site) const { return site / per_cell_; }
  /// The site in which x is, counted on beyond the ends of the axis.
  long site_at(double x) const {
    return static_cast<long>(std::floor(axis_.graded() ? axis_.place(x) * per_cell_ : x / width_));
  }
  double width(long site) const {
    return axis_.graded() ? axis_.width(static_cast<int>(site / per_cell_)) / per_cell_ : width_;
  }
  double low(long site) const { return at(static_cast<double>(site)); }
  double middle(long site) const { return at(static_cast<double>(site) + 0.5); }

 private:
  double at(double sites) const { return axis_.graded() ? axis_.at_place(sites / per_cell_) : sites * width_; }

  GridAxis axis_;
  int per_cell_ = 1;
  double width_ = 1;
};

}  // namespace polder
