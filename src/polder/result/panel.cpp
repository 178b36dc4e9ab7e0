#include "polder/result/panel.hpp"

#include <algorithm>
#include <cmath>

#include "polder/result/paint.hpp"

namespace polder {
namespace {

constexpr double tick_length = 4;

// About one tick per so many units: wide enough for its label.
Ticks horizontal_ticks(const Panel& panel) {
  return nice_ticks(panel.horizontal, std::clamp(static_cast<int>(panel.width / 80), 2, 12));
}
Ticks vertical_ticks(const Panel& panel) {
  return nice_ticks(panel.vertical, std::clamp(static_cast<int>(panel.height / 42), 2, 10));
}

Text label(Point2 at, std::string text, double size, Anchor anchor, Colour colour = ink::text) {
  return {at, std::move(text), size, colour, anchor};
}

struct BarScale {
  DisplayUnit unit;
  Ticks ticks;
  Range range;
};

BarScale bar_scale(const ColourBar& bar, int count) {
  BarScale scale;
  scale.unit = display_unit(bar.unit, std::max(std::abs(bar.range.low), std::abs(bar.range.high)));
  scale.range = {bar.range.low / scale.unit.factor, bar.range.high / scale.unit.factor};
  scale.ticks = nice_ticks(scale.range, count);
  return scale;
}

}  // namespace

void draw_grid(Drawing& drawing, const Panel& panel) {
  const Stroke stroke{ink::grid, 1, {}};
  for (const double h : horizontal_ticks(panel).at)
    drawing.line(panel.at(h, panel.vertical.low), panel.at(h, panel.vertical.high), stroke);
  for (const double v : vertical_ticks(panel).at)
    drawing.line(panel.at(panel.horizontal.low, v), panel.at(panel.horizontal.high, v), stroke);
}

void draw_axes(Drawing& drawing, const Panel& panel, const Axes& axes) {
  const Stroke stroke{ink::axis, 1, {}};
  const double bottom = panel.y + panel.height;
  drawing.rectangle(panel.x, panel.y, panel.width, panel.height, {}, stroke);
  if (axes.horizontal_ticks) {
    const Ticks ticks = horizontal_ticks(panel);
    for (std::size_t i = 0; i < ticks.at.size(); ++i) {
      const double x = panel.at(ticks.at[i], panel.vertical.low)[0];
      drawing.line({x, bottom}, {x, bottom + tick_length}, stroke);
      drawing.add(label({x, bottom + tick_length + tick_size}, ticks.labels[i], tick_size, Anchor::middle));
    }
  }
  if (axes.vertical_ticks) {
    const Ticks ticks = vertical_ticks(panel);
    for (std::size_t i = 0; i < ticks.at.size(); ++i) {
      const double y = panel.at(panel.horizontal.low, ticks.at[i])[1];
      drawing.line({panel.x - tick_length, y}, {panel.x, y}, stroke);
      drawing.add(label({panel.x - tick_length - 3, y + 0.36 * tick_size}, ticks.labels[i], tick_size, Anchor::end));
    }
  }
  if (!axes.horizontal.empty())
    drawing.add(label({panel.x + panel.width / 2, bottom + tick_length + tick_size + 18}, axes.horizontal, label_size,
                      Anchor::middle, ink::soft));
  if (!axes.vertical.empty()) {
    Text text = label({panel.x - vertical_label_width(panel) - 10, panel.y + panel.height / 2}, axes.vertical,
                      label_size, Anchor::middle, ink::soft);
    text.angle = 90;
    drawing.add(text);
  }
}

double vertical_label_width(const Panel& panel) {
  double width = 0;
  for (const std::string& text : vertical_ticks(panel).labels) width = std::max(width, text_width(text, tick_size));
  return width + tick_length + 3;
}

void draw_upright_bar(Drawing& drawing, const ColourBar& bar, double x, double y, double width, double height) {
  const BarScale scale = bar_scale(bar, std::clamp(static_cast<int>(height / 40), 2, 8));
  constexpr int steps = 128;
  for (int i = 0; i < steps; ++i) {
    // Each step reaches one further down, so that no seam shows between smoothed edges.
    const double top = y + height * i / steps, bottom = y + height * std::min(i + 2, steps) / steps;
    drawing.rectangle(x, top, width, bottom - top, colour_at(bar.map, 1 - (i + 0.5) / steps));
  }
  const double tip = 0.6 * width;
  Path frame{{{x, y}}, true, {}, Stroke{ink::axis, 0.8, {}}};
  if (bar.above) {
    drawing.add(Path{{{x, y + 0.3}, {x + width / 2, y - tip}, {x + width, y + 0.3}}, true, colour_at(bar.map, 1), {}});
    frame.points.push_back({x + width / 2, y - tip});
  }
  frame.points.insert(frame.points.end(), {{x + width, y}, {x + width, y + height}});
  if (bar.below) {
    const double end = y + height;
    drawing.add(
        Path{{{x, end - 0.3}, {x + width / 2, end + tip}, {x + width, end - 0.3}}, true, colour_at(bar.map, 0), {}});
    frame.points.push_back({x + width / 2, end + tip});
  }
  frame.points.push_back({x, y + height});
  drawing.add(frame);
  for (std::size_t i = 0; i < scale.ticks.at.size(); ++i) {
    const double place =
        y + height - (scale.ticks.at[i] - scale.range.low) / (scale.range.high - scale.range.low) * height;
    drawing.line({x + width, place}, {x + width + 3, place}, Stroke{ink::axis, 1, {}});
    drawing.add(label({x + width + 6, place + 0.36 * tick_size}, scale.ticks.labels[i], tick_size, Anchor::start));
  }
  drawing.add(label({x, y - (bar.above ? tip : 0) - 8}, scale.unit.name, tick_size, Anchor::start, ink::soft));
}

void draw_lying_bar(Drawing& drawing, const ColourBar& bar, double x, double y, double width, double height) {
  const BarScale scale = bar_scale(bar, std::clamp(static_cast<int>(width / 55), 2, 6));
  constexpr int steps = 128;
  for (int i = 0; i < steps; ++i) {
    const double left = x + width * i / steps, right = x + width * std::min(i + 2, steps) / steps;
    drawing.rectangle(left, y, right - left, height, colour_at(bar.map, (i + 0.5) / steps));
  }
  const double tip = 0.6 * height;
  Path frame{{{x, y}, {x + width, y}}, true, {}, Stroke{ink::axis, 0.8, {}}};
  if (bar.above) {
    const double end = x + width;
    drawing.add(
        Path{{{end - 0.3, y}, {end + tip, y + height / 2}, {end - 0.3, y + height}}, true, colour_at(bar.map, 1), {}});
    frame.points.push_back({end + tip, y + height / 2});
  }
  frame.points.insert(frame.points.end(), {{x + width, y + height}, {x, y + height}});
  if (bar.below) {
    drawing.add(
        Path{{{x + 0.3, y}, {x - tip, y + height / 2}, {x + 0.3, y + height}}, true, colour_at(bar.map, 0), {}});
    frame.points.push_back({x - tip, y + height / 2});
  }
  drawing.add(frame);
  for (std::size_t i = 0; i < scale.ticks.at.size(); ++i) {
    const double place = x + (scale.ticks.at[i] - scale.range.low) / (scale.range.high - scale.range.low) * width;
    drawing.line({place, y + height}, {place, y + height + 3}, Stroke{ink::axis, 1, {}});
    drawing.add(label({place, y + height + 5 + tick_size}, scale.ticks.labels[i], tick_size, Anchor::middle));
  }
}

std::string fitted(const std::string& text, double width, double size, bool bold) {
  if (text_width(text, size, bold) <= width) return text;
  std::string cut = text;
  while (!cut.empty() && text_width(cut + "…", size, bold) > width) {
    do cut.pop_back();
    while (!cut.empty() && (static_cast<unsigned char>(cut.back()) & 0xc0) == 0x80);  // whole UTF-8 characters
    if (!cut.empty() && (static_cast<unsigned char>(cut.back()) & 0x80)) cut.pop_back();
  }
  return cut + "…";
}

}  // namespace polder
