#pragma once
// How one axis of the grid is divided into cells: all alike, or finer in some ranges and growing away from them.
//
// A graded axis begins with knots k, and everything else are means of neighbours: cell edges e_i = (k_{i−1} + k_i)/2,
// cell centres c_i = (e_i + e_{i+1})/2. So quadratic B-splines with knots at the edges have their nodes (Greville
// abscissae) at the centres, those with knots k at the edges, and both reproduce linear fields exactly. Beyond either
// end the axis is its own mirror image.
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace polder {

/// A range of an axis with cells finer than elsewhere; both ends are edges of cells.
struct FineRange {
  double from = 0, to = 0;  ///< m
  double cell = 0;          ///< m, at most: a whole number of cells fills the range
  double growth = 1.15;     ///< of neighbouring cells away from the range, at most
};

class GridAxis {
 public:
  static constexpr int ghosts = 4;  ///< cells known beyond either end

  GridAxis() = default;
  GridAxis(int cells, double width) : cells_(cells), least_(width), length_(cells * width) {}
  /// `cell`: the largest width. Ranges are in the axis, ascending, and leave room between each other.
  GridAxis(double length, double cell, std::vector<FineRange> ranges);

  bool graded() const { return table_ != nullptr; }
  int cells() const { return cells_; }
  double least() const { return least_; }  ///< m, width of the smallest cell
  double length() const { return length_; }

  double edge(int i) const { return table_ ? table_->edge[at(i)] : i * least_; }  ///< m, the low one of cell i
  double centre(int i) const { return table_ ? table_->centre[at(i)] : (i + 0.5) * least_; }
  double width(int i) const { return table_ ? table_->edge[at(i + 1)] - table_->edge[at(i)] : least_; }
  /// From the centre of the cell below the low edge of cell i to that above it.
  double gap(int i) const { return table_ ? table_->centre[at(i)] - table_->centre[at(i - 1)] : least_; }
  /// Where the splines of the edges have their knot in cell i.
  double knot(int i) const { return table_ ? table_->knot[at(i)] : centre(i); }

  /// Cell of a graded axis in which x is, or the nearest.
  int cell_at(double x) const {
    const Table& t = *table_;
    const double bin = std::min(std::max(0.0, x * t.bins_per_metre), static_cast<double>(t.first.size() - 1));
    int i = t.first[static_cast<std::size_t>(bin)];
    while (i + 1 < cells_ && x >= t.edge[at(i + 1)]) ++i;
    return i;
  }
  /// x counted in cells: the cell's number + the share of it below x. Beyond the ends the first and last cells go on.
  double place(double x) const {
    if (!table_) return x / least_;
    const int i = cell_at(x);
    return i + (x - edge(i)) / width(i);
  }
  /// The same, of x that is in cell i or beside it.
  double place_from(int i, double x) const { return i + (x - edge(i)) / width(i); }
  /// Where a place counted in cells is, m.
  double at_place(double place) const {
    if (!table_) return place * least_;
    const int i = std::clamp(static_cast<int>(std::floor(place)), 0, cells_ - 1);
    return edge(i) + (place - i) * width(i);
  }
  int nearest_edge(double x) const {
    if (!table_) return static_cast<int>(std::lround(x / least_));
    const int i = cell_at(x);
    return x - edge(i) > edge(i + 1) - x ? i + 1 : i;
  }

 private:
  struct Table {
    std::vector<double> edge, centre, knot;
    std::vector<int> first;  // of the cells that begin in a bin or reach into it
    double bins_per_metre = 0;
  };
  static std::size_t at(int i) { return static_cast<std::size_t>(std::ptrdiff_t{i} + ghosts); }

  int cells_ = 1;
  double least_ = 1, length_ = 1;
  std::shared_ptr<const Table> table_;
};

}  // namespace polder
