#pragma once
// A rectangle of a drawing with two scales: frames, axes with ticks, and colour bars.
#include <string>

#include "polder/result/drawing.hpp"
#include "polder/result/ticks.hpp"

namespace polder {

/// Where the rectangle lies (drawing units) and what its sides mean.
struct Panel {
  double x = 0, y = 0, width = 1, height = 1;
  Range horizontal, vertical;

  Point2 at(double h, double v) const {
    return {x + (h - horizontal.low) / (horizontal.high - horizontal.low) * width,
            y + height - (v - vertical.low) / (vertical.high - vertical.low) * height};
  }
  Point2 at(const Point2& p) const { return at(p[0], p[1]); }
  /// Drawing units per unit of the horizontal scale.
  double scale() const { return width / (horizontal.high - horizontal.low); }
};

struct Axes {
  std::string horizontal, vertical;  ///< labels; empty: none
  bool horizontal_ticks = true, vertical_ticks = true;
  bool grid = false;
};

/// Grid lines; to be painted before the contents.
void draw_grid(Drawing& drawing, const Panel& panel);
/// Frame, ticks and labels; to be painted after the contents.
void draw_axes(Drawing& drawing, const Panel& panel, const Axes& axes);
/// Width that the labels of the vertical axis take, in drawing units.
double vertical_label_width(const Panel& panel);

struct ColourBar {
  ColourMap map = ColourMap::field;
  Range range;                        ///< SI
  std::string unit;                   ///< SI unit; shown in the one that suits
  bool below = false, above = false;  ///< there are values beyond the ends: these are drawn pointed
};

/// Upright, labels to its right, the unit above it.
void draw_upright_bar(Drawing& drawing, const ColourBar& bar, double x, double y, double width, double height);
/// Lying, labels below it.
void draw_lying_bar(Drawing& drawing, const ColourBar& bar, double x, double y, double width, double height);

/// `text`, cut to `width` with an ellipsis where it is wider.
std::string fitted(const std::string& text, double width, double size, bool bold = false);

constexpr double tick_size = 11;  ///< letter size of tick labels
constexpr double label_size = 12;

}  // namespace polder
