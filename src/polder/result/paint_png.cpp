#include <cairo.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "polder/result/atomic_file.hpp"
#include "polder/result/output_error.hpp"
#include "polder/result/paint.hpp"

namespace polder {
namespace {

using SurfaceHandle = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using PainterHandle = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

void set_colour(cairo_t* painter, const Colour& c) {
  cairo_set_source_rgba(painter, c.red, c.green, c.blue, c.opacity);
}

void set_font(cairo_t* painter, double size, bool bold) {
  cairo_select_font_face(painter, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(painter, size);
}

// Letters are placed by their unhinted widths, so that text has the same size at every scale.
void fix_fonts(cairo_t* painter) {
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(painter, options);
  cairo_font_options_destroy(options);
}

void fill_and_stroke(cairo_t* painter, const std::optional<Colour>& fill, const std::optional<Stroke>& stroke) {
  if (fill) {
    set_colour(painter, *fill);
    cairo_fill_preserve(painter);
  }
  if (stroke) {
    set_colour(painter, stroke->colour);
    cairo_set_line_width(painter, stroke->width);
    cairo_set_dash(painter, stroke->dash.data(), static_cast<int>(stroke->dash.size()), 0);
    cairo_stroke_preserve(painter);
  }
  cairo_new_path(painter);
}

struct Painter {
  cairo_t* painter;
  double scale;

  void operator()(const Path& path) const {
    for (const Point2& p : path.points) cairo_line_to(painter, p[0], p[1]);
    if (path.closed) cairo_close_path(painter);
    fill_and_stroke(painter, path.fill, path.stroke);
  }
  void operator()(const Disc& disc) const {
    cairo_arc(painter, disc.centre[0], disc.centre[1], disc.radius, 0, 2 * std::numbers::pi);
    fill_and_stroke(painter, disc.fill, disc.stroke);
  }
  void operator()(const Text& text) const {
    const double width = text_width(text.text, text.size, text.bold);
    const double shift = text.anchor == Anchor::start ? 0 : text.anchor == Anchor::middle ? width / 2 : width;
    cairo_save(painter);
    cairo_translate(painter, text.at[0], text.at[1]);
    cairo_rotate(painter, -text.angle * std::numbers::pi / 180);
    cairo_move_to(painter, -shift, 0);
    set_font(painter, text.size, text.bold);
    set_colour(painter, text.colour);
    cairo_show_text(painter, text.text.c_str());
    cairo_new_path(painter);  // a text leaves a current point behind
    cairo_restore(painter);
  }
  // Whole pixels without smoothing: smoothed edges of neighbours would let the background shine through as a grid.
  void operator()(const Squares& squares) const {
    cairo_save(painter);
    cairo_set_antialias(painter, CAIRO_ANTIALIAS_NONE);
    for (std::size_t i = 0; i < squares.centres.size(); ++i) {
      const auto [x, y] = squares.centres[i];
      const double stretch = squares.stretch.empty() ? 1 : std::sqrt(squares.stretch[i]);
      const double half = squares.sides[i] / 2, across = half * stretch, upwards = half / stretch;
      const double left = std::round((x - across) * scale) / scale, right = std::round((x + across) * scale) / scale;
      const double top = std::round((y - upwards) * scale) / scale, bottom = std::round((y + upwards) * scale) / scale;
      set_colour(painter, squares.colours[i]);
      cairo_rectangle(painter, left, top, std::max(right - left, 1 / scale), std::max(bottom - top, 1 / scale));
      cairo_fill(painter);
    }
    cairo_restore(painter);
  }
  void operator()(const Clip& clip) const {
    cairo_save(painter);
    cairo_rectangle(painter, clip.x, clip.y, clip.width, clip.height);
    cairo_clip(painter);
  }
  void operator()(const Unclip&) const { cairo_restore(painter); }
};

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(std::string("picture: ") + cairo_status_to_string(status));
}

cairo_status_t append_bytes(void* target, const unsigned char* bytes, unsigned count) {
  static_cast<std::string*>(target)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

/// As libpng writes fastest, without its search for the best filter: with cairo's own writing a picture takes three
/// times as long, and a sixth less room.
std::string encode_opaque(cairo_surface_t* surface) {
  cairo_surface_flush(surface);
  const int width = cairo_image_surface_get_width(surface), height = cairo_image_surface_get_height(surface);
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::vector<unsigned char> rgb(3 * count);
  unsigned char* to = rgb.data();
  const unsigned char* line = cairo_image_surface_get_data(surface);
  for (int row = 0; row < height; ++row, line += cairo_image_surface_get_stride(surface)) {
    const unsigned char* from = line;
    for (int column = 0; column < width; ++column, from += 4) {
      std::uint32_t pixel;
      std::memcpy(&pixel, from, sizeof pixel);
      for (const int shift : {16, 8, 0}) *to++ = static_cast<unsigned char>(pixel >> shift);
    }
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width), image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGB;
  image.flags = PNG_IMAGE_FLAG_FAST;
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
  png_alloc_size_t size = bytes.size();
  if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, rgb.data(), 0, nullptr))
    throw std::runtime_error(std::string("picture: ") + image.message);
  bytes.resize(size);
  return bytes;
}

}  // namespace

std::string to_png(const Drawing& drawing, double scale) {
  const SurfaceHandle surface(
      cairo_image_surface_create(drawing.background.opacity < 1 ? CAIRO_FORMAT_ARGB32 : CAIRO_FORMAT_RGB24,
                                 static_cast<int>(std::ceil(drawing.width * scale)),
                                 static_cast<int>(std::ceil(drawing.height * scale))),
      &cairo_surface_destroy);
  check(cairo_surface_status(surface.get()));
  const PainterHandle painter(cairo_create(surface.get()), &cairo_destroy);
  cairo_scale(painter.get(), scale, scale);
  cairo_set_line_join(painter.get(), CAIRO_LINE_JOIN_ROUND);
  fix_fonts(painter.get());
  set_colour(painter.get(), drawing.background);
  cairo_paint(painter.get());
  for (const Shape& shape : drawing.shapes) std::visit(Painter{painter.get(), scale}, shape);
  check(cairo_status(painter.get()));
  if (drawing.background.opacity >= 1) return encode_opaque(surface.get());
  std::string bytes;
  check(cairo_surface_write_to_png_stream(surface.get(), append_bytes, &bytes));
  return bytes;
}

double text_width(const std::string& text, double size, bool bold) {
  const SurfaceHandle surface(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1), &cairo_surface_destroy);
  const PainterHandle painter(cairo_create(surface.get()), &cairo_destroy);
  fix_fonts(painter.get());
  set_font(painter.get(), size, bold);
  cairo_text_extents_t extents;
  cairo_text_extents(painter.get(), text.c_str(), &extents);
  return extents.x_advance;
}

void write_drawing(const std::filesystem::path& path, const Drawing& drawing) {
  const bool svg = path.extension() == ".svg";
  if (!svg && path.extension() != ".png") throw OutputError(path.string(), "a picture's name ends in .png or .svg");
  write_atomically(path, svg ? to_svg(drawing) : to_png(drawing));
}

}  // namespace polder
