#pragma once
// Colours, and maps from numbers to colours whose lightness changes evenly, so that equal steps of the quantity look
// like equal steps and a black-and-white print keeps their order.
//
// The maps are Polder's own: a few hues, with the lightness linear between the ends, interpolated in Oklab (Björn
// Ottosson, "A perceptual color space for image processing", 2020, public domain).
#include <array>
#include <cstdint>
#include <string_view>

namespace polder {

/// sRGB and opacity, 0 to 1.
struct Colour {
  double red = 0, green = 0, blue = 0, opacity = 1;
};

/// From 0xRRGGBB.
constexpr Colour rgb(std::uint32_t hex, double opacity = 1) {
  return {((hex >> 16) & 255) / 255.0, ((hex >> 8) & 255) / 255.0, (hex & 255) / 255.0, opacity};
}

struct Oklab {
  double lightness = 0, a = 0, b = 0;
};
Oklab to_oklab(const Colour& colour);
/// Clipped to the gamut of sRGB.
Colour from_oklab(const Oklab& lab);

enum class ColourMap {
  field,   ///< violet, blue, green, yellow: dark to light; general purpose
  strain,  ///< sand, orange, red, dark violet: light is undisturbed
  water,   ///< pale to deep blue
  signs,   ///< blue, white, red: for quantities whose zero matters
};

/// Colour at `t` in [0, 1]; beyond it the colour of the nearer end; NaN grey.
Colour colour_at(ColourMap map, double t);

/// Colour number `index` of a palette of eight that stay apart for colour-blind readers, on white.
Colour series_colour(std::size_t index);

}  // namespace polder
