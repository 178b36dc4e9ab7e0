#include "polder/result/picture.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "polder/result/paint.hpp"
#include "polder/result/panel.hpp"

namespace polder {
namespace {

// Sides of the squares, in sides of the volume that a point stands for: they overlap by less than half, so that sheared
// soil, whose points draw apart in one direction, does not look perforated.
constexpr double overlap = 1.45;

using View = std::array<Range, 2>;

Point2 in_section(const Frame& frame, const Point3& p) { return {p[0], frame.dimension == 3 ? p[2] : p[1]}; }

double side_of(const Frame& frame, double volume) {
  return frame.dimension == 3 ? std::cbrt(volume) : std::sqrt(volume);
}

/// Width over height of the cells where a point is.
double stretch_at(const Frame& frame, const Point3& p) {
  const std::size_t up = frame.dimension == 3 ? 2 : 1;
  const auto width = [&](std::size_t axis) {
    const GridAxis& grid = frame.grid[axis];
    return grid.width(grid.graded() ? grid.cell_at(p[axis]) : 0);
  };
  return width(0) / width(up);
}

bool shown(const Frame& frame, const PointSet& points, std::size_t p) {
  if (frame.dimension == 2) return true;
  return std::abs(points.position[p][1] - frame.size[1] / 2) <= 0.5 * side_of(frame, points.volume[p]);
}

View whole_view(std::span<const Frame> frames) {
  const Frame& first = frames.front();
  const double ceiling = first.size[first.dimension == 3 ? 2 : 1];
  double top = 0;
  for (const Frame& frame : frames) {
    for (const PointSet* points : {&frame.soil, &frame.water})
      for (const Point3& p : points->position) top = std::max(top, in_section(frame, p)[1]);
    for (const Line2& line : frame.outlines)
      for (const Point2& p : line) top = std::max(top, p[1]);
  }
  return {Range{0, first.size[0]}, Range{0, std::min(ceiling, top + 0.06 * ceiling)}};
}

// The range that holds all but the most extreme half per cent at each end: a few stray points must not decide.
Range usual_range(std::vector<double> values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  if (values.empty()) return {0, 1};
  const std::size_t cut = values.size() / 200, last = values.size() - 1 - cut;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(cut), values.end());
  const double low = values[cut];
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(last), values.end());
  return {low, values[last]};
}

ColourBar bar_for(std::span<const Frame> frames, const PictureField& field) {
  std::vector<double> values;
  ColourBar bar;
  bool found = false;
  const auto collect = [&](const PointSet& points, const std::string& name) {
    const PointField* present = points.find(name);
    if (!present) return;
    found = true;
    bar.unit = present->info.unit;
    const std::vector<double> more = magnitudes(*present);
    values.insert(values.end(), more.begin(), more.end());
  };
  for (const Frame& frame : frames) {
    collect(frame.soil, field.name);
    collect(frame.water, field.water);
  }
  if (!found) throw std::invalid_argument("picture: there is no field '" + field.name + "'");
  bar.map = field.map;
  if (field.range) {
    bar.range = *field.range;
  } else {
    Range range = usual_range(values);
    const double least =
        1e-3 * std::max(std::abs(range.low), std::abs(range.high));  // what differs by less is the same
    if (!field.from_zero && range.high - range.low < least)
      range = {0.5 * (range.low + range.high - least), 0.5 * (range.low + range.high + least)};
    if (field.from_zero) range = {std::min(0.0, range.low), std::max(range.high, 0.0)};
    if (field.from_zero && range.high == range.low) range.high = 1e-3;
    if (field.map == ColourMap::signs) {  // zero is the map's white
      const double most = std::max({std::abs(range.low), std::abs(range.high), 1e-12});
      range = {-most, most};
    }
    const double factor = display_unit(bar.unit, std::max(std::abs(range.low), std::abs(range.high))).factor;
    const Range round = nice_range({range.low / factor, range.high / factor}, 10);
    bar.range = {round.low * factor, round.high * factor};
  }
  const Range all = range_of(values);
  const double slack = 1e-9 * (bar.range.high - bar.range.low);
  bar.below = all.low < bar.range.low - slack;
  bar.above = all.high > bar.range.high + slack;
  return bar;
}

Squares squares_of(const Frame& frame, const PointSet& points, const std::string& name, const ColourBar& bar,
                   const Colour& plain, const Panel& panel) {
  const PointField* field = points.find(name);
  const std::vector<double> values = field ? magnitudes(*field) : std::vector<double>{};
  Squares squares;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (!shown(frame, points, p)) continue;
    squares.centres.push_back(panel.at(in_section(frame, points.position[p])));
    squares.sides.push_back(overlap * side_of(frame, points.volume[p]) * panel.scale());
    squares.stretch.push_back(stretch_at(frame, points.position[p]));
    squares.colours.push_back(field ? colour_at(bar.map, (values[p] - bar.range.low) / (bar.range.high - bar.range.low))
                                    : plain);
  }
  return squares;
}

Path line_in(const Panel& panel, const Line2& line, Stroke stroke, std::optional<Colour> fill = {}) {
  Path path{{}, line.size() > 2 && line.front() == line.back(), fill, std::move(stroke)};
  for (const Point2& p : line) path.points.push_back(panel.at(p));
  if (path.closed) path.points.pop_back();
  return path;
}

void draw_contents(Drawing& drawing, const Panel& panel, const Frame& frame, const PictureField& field,
                   const ColourBar& bar, bool outline) {
  drawing.add(Clip{panel.x, panel.y, panel.width, panel.height});
  drawing.add(squares_of(frame, frame.water, field.water, bar, ink::water, panel));
  drawing.add(squares_of(frame, frame.soil, field.name, bar, rgb(0xd9c9a8), panel));
  for (const Line2& line : frame.water_lines) drawing.add(line_in(panel, line, {ink::water_line, 1.4, {}}));
  for (const Line2& wall : frame.walls) {
    const bool solid = wall.size() > 2 && wall.front() == wall.back();
    drawing.add(line_in(panel, wall, {ink::wall, 1.6, {}}, solid ? std::optional(rgb(0xb9bec4)) : std::nullopt));
  }
  if (outline)
    for (const Line2& line : frame.outlines) {
      Path path = line_in(panel, line, {ink::text, 1, {5, 4}});
      path.closed = true;
      drawing.add(path);
    }
  drawing.add(Unclip{});
}

/// A bar of 1, 2 or 5 times a power of ten metres, about a sixth of the width, on a pale ground.
void draw_scale_bar(Drawing& drawing, const Panel& panel) {
  constexpr double gap = 12, thick = 4;
  const double wanted = (panel.horizontal.high - panel.horizontal.low) / 6;
  const double decade = std::pow(10, std::floor(std::log10(wanted)));
  const double metres = decade * (wanted >= 5 * decade ? 5 : wanted >= 2 * decade ? 2 : 1);
  const double length = metres * panel.scale(), right = panel.x + panel.width - gap, top = panel.y + gap;
  const DisplayUnit unit = display_unit("m", metres);
  const std::string text = number_text(metres / unit.factor) + " " + unit.name;
  const double box = std::max(length, text_width(text, tick_size)) + 12;
  drawing.rectangle(right - length / 2 - box / 2, top - 6, box, 34, Colour{1, 1, 1, 0.75});
  drawing.rectangle(right - length, top, length, thick, ink::text);
  drawing.add(Text{{right - length / 2, top + thick + 4 + tick_size}, text, tick_size, ink::text, Anchor::middle});
}

const FieldInfo& info_of(const Frame& frame, const PictureField& field) {
  const PointField* present = frame.soil.find(field.name);
  if (!present) present = frame.water.find(field.water);
  if (!present) throw std::invalid_argument("picture: there is no field '" + field.name + "'");
  return present->info;
}

std::string with_symbol(const FieldInfo& info) {
  return info.symbol.empty() ? info.label : info.label + " " + info.symbol;
}

}  // namespace

PictureField picture_field(std::string_view name) {
  PictureField field{std::string(name), "", ColourMap::field, {}, false};
  if (name == "pore_pressure" || name == "pressure") return {"pore_pressure", "pressure", ColourMap::water, {}, true};
  if (name == "velocity") return {field.name, field.name, ColourMap::strain, {}, true};
  if (name == "deviatoric_strain" || name == "plastic_strain" || name == "displacement") {
    field.map = ColourMap::strain;
    field.from_zero = true;
  }
  if (name == "excess_pressure" || name == "volumetric_strain") field.map = ColourMap::signs;
  if (name == "saturation") field.map = ColourMap::water;
  return field;
}

std::vector<PictureField> standard_pictures(const Frame& frame) {
  std::vector<PictureField> fields;
  for (const std::string_view name : standard_fields) {
    const PictureField field = picture_field(name);
    if (frame.soil.find(field.name) || frame.water.find(field.water)) fields.push_back(field);
  }
  return fields;
}

Range common_range(std::span<const Frame> frames, const PictureField& field) { return bar_for(frames, field).range; }

Drawing draw_frame(const Frame& frame, const PictureField& field, const PictureStyle& style) {
  constexpr double left = 62, right = 78, top = 58, bottom = 50, least_width = 420;
  const View view = style.view ? *style.view : whole_view({&frame, 1});
  const double across = view[0].high - view[0].low, up = view[1].high - view[1].low;
  const double scale = std::min((style.width - left - right) / across, style.max_height / up);
  Panel panel{left, top, across * scale, up * scale, view[0], view[1]};
  Drawing drawing{std::max(least_width, left + panel.width + right), top + panel.height + bottom, rgb(0xffffff), {}};
  const ColourBar bar = bar_for({&frame, 1}, field);

  draw_contents(drawing, panel, frame, field, bar, style.outline);
  draw_axes(drawing, panel, {"x (m)", frame.dimension == 3 ? "z (m)" : "y (m)", true, true, false});
  if (style.scale_bar) draw_scale_bar(drawing, panel);
  draw_upright_bar(drawing, bar, panel.x + panel.width + 20, panel.y, 14, panel.height);

  const std::string time = "t = " + time_text(frame.time);
  const double end = drawing.width - 16, time_width = text_width(time, 14, true);
  drawing.add(Text{{left, 24},
                   fitted(with_symbol(info_of(frame, field)), end - left - time_width - 16, 15, true),
                   15,
                   ink::text,
                   Anchor::start,
                   true});
  drawing.add(Text{{end, 24}, time, 14, ink::text, Anchor::end, true});
  drawing.add(Text{{left, 42}, fitted(frame.title, end - left, label_size), label_size, ink::soft});
  return drawing;
}

Drawing draw_sheet(std::span<const Frame> frames, std::span<const PictureField> fields, const PictureStyle& style) {
  if (frames.empty() || fields.empty()) throw std::invalid_argument("picture: a sheet needs a frame and a field");
  constexpr double left = 84, right = 18, gap = 14, below_row = 10, bar_height = 12;
  const double top = frames.front().title.empty() ? 34 : 58, bottom = 96;
  const View view = style.view ? *style.view : whole_view(frames);
  const double columns = static_cast<double>(fields.size()), rows = static_cast<double>(frames.size());
  const double width = (style.width - left - right - (columns - 1) * gap) / columns;
  const double height = width * (view[1].high - view[1].low) / (view[0].high - view[0].low);
  Drawing drawing{style.width, top + rows * height + (rows - 1) * below_row + bottom, rgb(0xffffff), {}};
  if (!frames.front().title.empty())
    drawing.add(Text{{left, 22},
                     fitted(frames.front().title, style.width - left - right, 14, true),
                     14,
                     ink::text,
                     Anchor::start,
                     true});

  for (std::size_t c = 0; c < fields.size(); ++c) {
    const ColourBar bar = bar_for(frames, fields[c]);
    const double x = left + static_cast<double>(c) * (width + gap);
    const FieldInfo& info = info_of(frames.front(), fields[c]);
    const std::string unit = display_unit(info.unit, std::max(std::abs(bar.range.low), std::abs(bar.range.high))).name;
    drawing.add(Text{{x, top - 10},
                     fitted(with_symbol(info) + (unit.empty() ? "" : " (" + unit + ")"), width, label_size, true),
                     label_size,
                     ink::text,
                     Anchor::start,
                     true});
    for (std::size_t r = 0; r < frames.size(); ++r) {
      const Panel panel{x, top + static_cast<double>(r) * (height + below_row), width, height, view[0], view[1]};
      draw_contents(drawing, panel, frames[r], fields[c], bar, style.outline);
      const bool last = r + 1 == frames.size();
      draw_axes(drawing, panel, {last ? "x (m)" : "", "", last, c == 0, false});
      if (style.scale_bar && r == 0) draw_scale_bar(drawing, panel);
      if (c == 0)
        drawing.add(Text{
            {12, panel.y + height / 2 + 4}, time_text(frames[r].time), label_size, ink::text, Anchor::start, true});
    }
    draw_lying_bar(drawing, bar, x + 0.1 * width, drawing.height - bottom + 52, 0.8 * width, bar_height);
  }
  return drawing;
}

}  // namespace polder
