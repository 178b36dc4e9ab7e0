#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "polder/result/paint.hpp"

namespace polder {
namespace {

// Hundredths of a unit are below what any screen shows; trailing zeros are dropped.
std::string coordinate(double value) {
  std::string text = fmt::format("{:.2f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string hex(const Colour& c) {
  const auto byte = [](double x) { return std::lround(std::clamp(x, 0.0, 1.0) * 255); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(c.red), byte(c.green), byte(c.blue));
}

std::string style(const std::optional<Colour>& fill, const std::optional<Stroke>& stroke) {
  std::string text = fmt::format(" fill=\"{}\"", fill ? hex(*fill) : "none");
  if (fill && fill->opacity < 1) text += fmt::format(" fill-opacity=\"{}\"", coordinate(fill->opacity));
  if (!stroke) return text;
  text += fmt::format(" stroke=\"{}\" stroke-width=\"{}\"", hex(stroke->colour), coordinate(stroke->width));
  if (stroke->colour.opacity < 1) text += fmt::format(" stroke-opacity=\"{}\"", coordinate(stroke->colour.opacity));
  if (!stroke->dash.empty()) {
    text += " stroke-dasharray=\"";
    for (const double length : stroke->dash) text += coordinate(length) + " ";
    text.back() = '"';
  }
  return text;
}

struct SvgWriter {
  const Drawing& drawing;
  std::string body, definitions;

  void operator()(const Path& path) {
    body += "<path d=\"";
    for (std::size_t i = 0; i < path.points.size(); ++i)
      body += (i == 0 ? "M" : "L") + coordinate(path.points[i][0]) + " " + coordinate(path.points[i][1]);
    body += path.closed ? "Z\"" : "\"";
    body += style(path.fill, path.stroke) + "/>\n";
  }
  void operator()(const Disc& disc) {
    body += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"{}/>\n", coordinate(disc.centre[0]),
                        coordinate(disc.centre[1]), coordinate(disc.radius), style(disc.fill, disc.stroke));
  }
  void operator()(const Text& text) {
    constexpr const char* anchors[] = {"start", "middle", "end"};
    const std::string x = coordinate(text.at[0]), y = coordinate(text.at[1]);
    body += fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\" fill=\"{}\"", x, y, coordinate(text.size),
                        hex(text.colour));
    if (text.anchor != Anchor::start)
      body += fmt::format(" text-anchor=\"{}\"", anchors[static_cast<int>(text.anchor)]);
    if (text.bold) body += " font-weight=\"bold\"";
    if (text.angle != 0) body += fmt::format(" transform=\"rotate({} {} {})\"", coordinate(-text.angle), x, y);
    body += ">" + escaped(text.text) + "</text>\n";
  }
  // As an image of the layer alone: tens of thousands of rectangles would choke a browser.
  void operator()(const Squares& squares) {
    Drawing layer{drawing.width, drawing.height, Colour{1, 1, 1, 0}, {squares}};
    body += fmt::format("<image width=\"{}\" height=\"{}\" href=\"data:image/png;base64,{}\"/>\n",
                        coordinate(drawing.width), coordinate(drawing.height), base64(to_png(layer)));
  }
  void operator()(const Clip& clip) {
    // The name holds the rectangle: two drawings inlined in one page may then share a name without harm.
    const std::string box = fmt::format("x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"", coordinate(clip.x),
                                        coordinate(clip.y), coordinate(clip.width), coordinate(clip.height));
    std::string name = "clip-" + coordinate(clip.x) + "-" + coordinate(clip.y) + "-" + coordinate(clip.width) + "-" +
                       coordinate(clip.height);
    std::replace(name.begin(), name.end(), '.', '_');
    if (definitions.find('"' + name + '"') == std::string::npos)
      definitions += fmt::format("<clipPath id=\"{}\"><rect {}/></clipPath>\n", name, box);
    body += fmt::format("<g clip-path=\"url(#{})\">\n", name);
  }
  void operator()(const Unclip&) { body += "</g>\n"; }
};

}  // namespace

std::string to_svg(const Drawing& drawing) {
  SvgWriter writer{drawing, {}, {}};
  for (const Shape& shape : drawing.shapes) std::visit(writer, shape);
  const std::string w = coordinate(drawing.width), h = coordinate(drawing.height);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"DejaVu Sans, Verdana, sans-serif\" stroke-linejoin=\"round\">\n",
      w, h);
  if (!writer.definitions.empty()) svg += "<defs>\n" + writer.definitions + "</defs>\n";
  if (drawing.background.opacity > 0)
    svg += fmt::format("<rect width=\"{}\" height=\"{}\" fill=\"{}\"/>\n", w, h, hex(drawing.background));
  return svg + writer.body + "</svg>\n";
}

std::string base64(std::string_view bytes) {
  constexpr char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? alphabet[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  return result;
}

}  // namespace polder
