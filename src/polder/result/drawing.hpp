#pragma once
// A drawing as plain data: shapes in the order in which they are painted, in drawing units (1 unit = 1 CSS pixel),
// x to the right, y down. `to_png` and `to_svg` (paint.hpp) turn it into bytes.
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "polder/case/model.hpp"
#include "polder/result/colour.hpp"

namespace polder {

struct Stroke {
  Colour colour;
  double width = 1;
  std::vector<double> dash;  ///< lengths on and off; empty: solid
};

struct Path {
  std::vector<Point2> points;
  bool closed = false;
  std::optional<Colour> fill;
  std::optional<Stroke> stroke;
};

struct Disc {
  Point2 centre{0, 0};
  double radius = 1;
  std::optional<Colour> fill;
  std::optional<Stroke> stroke;
};

enum class Anchor { start, middle, end };

struct Text {
  Point2 at{0, 0};  ///< on the baseline
  std::string text;
  double size = 12;
  Colour colour;
  Anchor anchor = Anchor::start;
  bool bold = false;
  double angle = 0;  ///< degrees, counter-clockwise
};

/// Very many small rectangles of one layer, painted without gaps between neighbours; an SVG carries them as an image.
struct Squares {
  std::vector<Point2> centres;
  std::vector<double> sides;
  std::vector<double> stretch;  ///< width over height; empty: 1
  std::vector<Colour> colours;
};

/// What follows is painted only inside this rectangle, until the matching `Unclip`.
struct Clip {
  double x = 0, y = 0, width = 0, height = 0;
};
struct Unclip {};

using Shape = std::variant<Path, Disc, Text, Squares, Clip, Unclip>;

struct Drawing {
  double width = 0, height = 0;
  Colour background = rgb(0xffffff);
  std::vector<Shape> shapes;

  template <class T>
  void add(T shape) {
    shapes.emplace_back(std::move(shape));
  }
  void line(Point2 from, Point2 to, Stroke stroke) { add(Path{{from, to}, false, {}, std::move(stroke)}); }
  void rectangle(double x, double y, double w, double h, std::optional<Colour> fill,
                 std::optional<Stroke> stroke = {}) {
    add(Path{{{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}}, true, fill, std::move(stroke)});
  }
};

/// Shared inks of all of Polder's figures.
namespace ink {
constexpr Colour text = rgb(0x22262b);
constexpr Colour soft = rgb(0x6a7178);
constexpr Colour grid = rgb(0xe3e6e9);
constexpr Colour axis = rgb(0x8d949b);
constexpr Colour water = rgb(0xc3e0f2);
constexpr Colour water_line = rgb(0x1c6aa8);
constexpr Colour wall = rgb(0x5a6068);
}  // namespace ink

}  // namespace polder
