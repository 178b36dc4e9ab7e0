#pragma once
// Line charts: several curves over one axis, with round scales, units and a legend.
#include <optional>
#include <string>
#include <vector>

#include "polder/result/drawing.hpp"
#include "polder/result/history.hpp"
#include "polder/result/ticks.hpp"

namespace polder {

struct Curve {
  std::string name;          ///< in the legend
  std::vector<double> x, y;  ///< SI; a value that is not finite leaves a gap
  bool marks = false;        ///< points instead of a line: measurements, references
};

struct Chart {
  std::string title;
  std::string horizontal, vertical;            ///< what the axes show, without units
  std::string horizontal_unit, vertical_unit;  ///< SI; the chart chooses kPa, mm, h, ... where they suit
  std::vector<Curve> curves;
  std::optional<Range> vertical_range;  ///< SI; absent: round numbers that hold the curves
  double width = 560, height = 320;     ///< drawing units
};

Drawing draw_chart(const Chart& chart);

/// One chart for the columns of a history that share a unit and are of like size (within a factor of 50), at most six
/// curves each, in the order of the columns.
std::vector<Chart> history_charts(const History& history);

/// At most about `count` points of the polyline, in order, that keep its ends and, between them, its highs and lows.
Curve thinned(const Curve& curve, std::size_t count);

}  // namespace polder
