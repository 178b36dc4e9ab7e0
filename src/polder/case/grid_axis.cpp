#include "polder/case/grid_axis.hpp"

#include <limits>

namespace polder {

namespace {

/// What a range would like a cell at x to be: its own width, growing with the distance from it.
double wanted(const FineRange& range, double width, double x) {
  const double distance = std::max({0.0, range.from - x, x - range.to});
  return width + (range.growth - 1) * distance;
}

double width_in(const FineRange& range) {
  return (range.to - range.from) / std::max(1.0, std::ceil((range.to - range.from) / range.cell * (1 - 1e-9)));
}

/// Number of cells of the wanted widths from `from` on, at evenly spaced places up to `to`.
class CellsWanted {
 public:
  CellsWanted(double from, double to, double cell, const std::vector<FineRange>& ranges)
      : from_(from), step_((to - from) / pieces), sum_{0} {
    const auto density = [&](double x) {
      double width = cell;
      for (const FineRange& range : ranges) width = std::min(width, wanted(range, width_in(range), x));
      return 1 / width;
    };
    for (int i = 0; i < pieces; ++i) {
      const double x = from + i * step_;
      sum_.push_back(sum_.back() + step_ / 6 * (density(x) + 4 * density(x + 0.5 * step_) + density(x + step_)));
    }
  }
  double total() const { return sum_.back(); }
  /// Where `count` cells have passed.
  double place_of(double count) const {
    const auto above = std::upper_bound(sum_.begin() + 1, sum_.end() - 1, count);
    const auto i = above - sum_.begin() - 1;
    return from_ + (static_cast<double>(i) + (count - sum_[i]) / (sum_[i + 1] - sum_[i])) * step_;
  }

 private:
  static constexpr int pieces = 4000;
  double from_, step_;
  std::vector<double> sum_;
};

}  // namespace

GridAxis::GridAxis(double length, double cell, std::vector<FineRange> ranges) : length_(length) {
  if (ranges.empty()) {
    *this = GridAxis(static_cast<int>(std::lround(length / cell)), cell);
    return;
  }
  // Knots in the middle of a range's cells and of one that would follow on either side; between those of two ranges, or
  // of a range and an end of the axis, half a step from the next knot, they part what the widths ask for.
  std::vector<double> knots;
  double reached = 0;   // the last knot, or the low end of the axis
  double before = 0.5;  // steps from there to the next knot, where not a whole one
  const auto fill = [&](double to, double after) {
    const CellsWanted wanted(reached, to, cell, ranges);
    const double ends = before + after, whole = std::max(0.0, std::ceil(wanted.total() - ends - 1e-6));
    const double step = wanted.total() / (whole + ends);
    for (int j = 0; j <= static_cast<int>(whole); ++j) knots.push_back(wanted.place_of((j + before) * step));
  };
  struct Edges {
    double from, width;
    int cells;
    std::size_t knot;
  };
  std::vector<Edges> exact;
  for (const FineRange& range : ranges) {
    const double h = width_in(range);
    const int inside = static_cast<int>(std::lround((range.to - range.from) / h));
    if (range.from > 1e-9 * length) {
      fill(range.from - 0.5 * h, 1);
      knots.push_back(range.from - 0.5 * h);
    }
    exact.push_back({range.from, h, inside, knots.size()});
    for (int i = 0; i < inside; ++i) knots.push_back(range.from + (i + 0.5) * h);
    if (range.to < length * (1 - 1e-9)) knots.push_back(range.to + 0.5 * h);
    reached = knots.back(), before = 1;
  }
  if (ranges.back().to < length * (1 - 1e-9)) fill(length, 0.5);

  cells_ = static_cast<int>(knots.size());
  const int n = cells_;
  auto table = std::make_shared<Table>();
  const auto size = static_cast<std::size_t>(n) + 2 * std::size_t{ghosts};
  table->knot.resize(size);
  table->edge.resize(size + 1);
  table->centre.resize(size);
  for (int i = -ghosts; i < n + ghosts; ++i)
    table->knot[at(i)] = i < 0    ? -knots[static_cast<std::size_t>(-1 - i)]
                         : i >= n ? 2 * length - knots[static_cast<std::size_t>(2 * n - 1 - i)]
                                  : knots[static_cast<std::size_t>(i)];
  for (int i = 1 - ghosts; i < n + ghosts; ++i)
    table->edge[at(i)] = 0.5 * (table->knot[at(i - 1)] + table->knot[at(i)]);
  table->edge[at(0)] = 0;
  table->edge[at(n)] = length;
  for (const Edges& e : exact)
    for (int i = 0; i <= e.cells; ++i) table->edge[at(static_cast<int>(e.knot) + i)] = e.from + i * e.width;
  for (int i = 1; i <= 3; ++i) {
    table->edge[at(-i)] = -table->edge[at(i)];
    table->edge[at(n + i)] = 2 * length - table->edge[at(n - i)];
  }
  table->edge[at(-ghosts)] = 2 * table->edge[at(1 - ghosts)] - table->edge[at(2 - ghosts)];
  table->edge[at(n + ghosts)] = 2 * table->edge[at(n + ghosts - 1)] - table->edge[at(n + ghosts - 2)];
  for (int i = -ghosts; i < n + ghosts; ++i) table->centre[at(i)] = 0.5 * (table->edge[at(i)] + table->edge[at(i + 1)]);

  least_ = std::numeric_limits<double>::infinity();
  for (int i = 0; i < n; ++i) least_ = std::min(least_, table->edge[at(i + 1)] - table->edge[at(i)]);
  const auto bins = static_cast<std::size_t>(std::ceil(length / least_)) + 1;
  table->bins_per_metre = 1 / least_;
  table->first.resize(bins);
  int cell_of_bin = 0;
  for (std::size_t b = 0; b < bins; ++b) {
    const double low = static_cast<double>(b) * least_ * (1 - 1e-12);
    while (cell_of_bin + 1 < n && table->edge[at(cell_of_bin + 1)] <= low) ++cell_of_bin;
    table->first[b] = cell_of_bin;
  }
  table_ = std::move(table);
}

}  // namespace polder
