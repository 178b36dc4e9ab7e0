#include "polder/result/colour.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace polder {
namespace {

double to_linear(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }
double to_srgb(double c) {
  c = std::clamp(c, 0.0, 1.0);
  return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
}

// The hues a map passes through, at equal distances; only chroma and hue of the inner ones count, for the lightness
// runs linearly between the ends (and, in `signs`, between each end and the middle).
constexpr std::array field_hues{rgb(0x3b0f6b), rgb(0x3d4f9e), rgb(0x1f87a0),
                                rgb(0x2fb47c), rgb(0x9bd93c), rgb(0xfce94f)};
constexpr std::array strain_hues{rgb(0xf4ead2), rgb(0xf6cf8b), rgb(0xf0954f),
                                 rgb(0xd9503f), rgb(0xa31d50), rgb(0x3d0a3f)};
constexpr std::array water_hues{rgb(0xe3f1f7), rgb(0xaad4e8), rgb(0x68b0d8),
                                rgb(0x2f84bd), rgb(0x165a96), rgb(0x0b2f66)};
constexpr std::array signs_hues{rgb(0x123f85), rgb(0x6a9fd0), rgb(0xf5f3ef), rgb(0xdd8066), rgb(0x81101c)};

Colour along(std::span<const Colour> hues, double t) {
  const double place = t * static_cast<double>(hues.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), hues.size() - 2);
  const double share = place - static_cast<double>(i);
  const Oklab from = to_oklab(hues[i]), to = to_oklab(hues[i + 1]);
  const Oklab first = to_oklab(hues.front()), last = to_oklab(hues.back());
  return from_oklab({first.lightness + t * (last.lightness - first.lightness), from.a + share * (to.a - from.a),
                     from.b + share * (to.b - from.b)});
}

}  // namespace

Oklab to_oklab(const Colour& colour) {
  const double r = to_linear(colour.red), g = to_linear(colour.green), b = to_linear(colour.blue);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

Colour from_oklab(const Oklab& lab) {
  const auto cube = [](double x) { return x * x * x; };
  const double l = cube(lab.lightness + 0.3963377774 * lab.a + 0.2158037573 * lab.b);
  const double m = cube(lab.lightness - 0.1055613458 * lab.a - 0.0638541728 * lab.b);
  const double s = cube(lab.lightness - 0.0894841775 * lab.a - 1.2914855480 * lab.b);
  return {to_srgb(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          to_srgb(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          to_srgb(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

Colour colour_at(ColourMap map, double t) {
  if (std::isnan(t)) return rgb(0xbdbdbd);
  t = std::clamp(t, 0.0, 1.0);
  const std::span<const Colour> signs(signs_hues);
  switch (map) {
    case ColourMap::field:
      return along(field_hues, t);
    case ColourMap::strain:
      return along(strain_hues, t);
    case ColourMap::water:
      return along(water_hues, t);
    case ColourMap::signs:
      return t < 0.5 ? along(signs.first(3), 2 * t) : along(signs.last(3), 2 * t - 1);
  }
  return rgb(0xbdbdbd);
}

Colour series_colour(std::size_t index) {
  // Okabe and Ito (2008), with their yellow, which is lost on white, replaced by a brown.
  constexpr std::array palette{rgb(0x0072b2), rgb(0xd55e00), rgb(0x009e73), rgb(0xcc79a7),
                               rgb(0x56b4e9), rgb(0xe69f00), rgb(0x000000), rgb(0x8c6239)};
  return palette[index % palette.size()];
}

}  // namespace polder
