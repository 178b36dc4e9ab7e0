#pragma once
// Drawings as files. The same drawing gives the same bytes on one installation (cairo and its fonts decide on the
// pixels of letters); SVG does not depend on fonts at all, except through the widths that layout measured.
#include <filesystem>
#include <string>
#include <string_view>

#include "polder/result/drawing.hpp"

namespace polder {

/// PNG bytes at `scale` pixels per unit. Throws std::runtime_error where cairo cannot make the image.
std::string to_png(const Drawing& drawing, double scale = 2);
/// A self-contained SVG; text stays text.
std::string to_svg(const Drawing& drawing);

/// By the ending of `path`, .png or .svg, atomically. Throws OutputError.
void write_drawing(const std::filesystem::path& path, const Drawing& drawing);

/// Width of a text in drawing units.
double text_width(const std::string& text, double size, bool bold = false);

std::string base64(std::string_view bytes);
/// With &, <, > and " made harmless for XML and HTML.
std::string escaped(std::string_view text);

}  // namespace polder
