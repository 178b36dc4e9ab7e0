#include "polder/result/chart.hpp"

#include <algorithm>
#include <cmath>

#include "polder/result/paint.hpp"
#include "polder/result/panel.hpp"

namespace polder {
namespace {

constexpr double legend_row = 18;

struct LegendPlace {
  double x, y;
};

// Where each name of the legend begins: in rows that fit between `left` and `right`.
std::vector<LegendPlace> legend_places(const Chart& chart, double left, double right, double top) {
  std::vector<LegendPlace> places;
  double x = left, y = top;
  for (const Curve& curve : chart.curves) {
    const double width = 26 + text_width(curve.name, tick_size) + 16;
    if (x > left && x + width > right) {
      x = left;
      y += legend_row;
    }
    places.push_back({x, y});
    x += width;
  }
  return places;
}

Range curves_range(const Chart& chart, std::vector<double> Curve::*axis) {
  std::vector<double> all;
  for (const Curve& curve : chart.curves) all.insert(all.end(), (curve.*axis).begin(), (curve.*axis).end());
  return range_of(all);
}

double largest(const Range& range) { return std::max(std::abs(range.low), std::abs(range.high)); }

std::string with_unit(const std::string& label, const std::string& unit) {
  if (label.empty()) return unit;
  return unit.empty() ? label : label + " (" + unit + ")";
}

void draw_mark(Drawing& drawing, Point2 at, const Colour& colour) {
  drawing.add(Disc{at, 3.2, rgb(0xffffff), Stroke{colour, 1.6, {}}});
}

void draw_curve(Drawing& drawing, const Panel& panel, const Curve& all, double per_x, double per_y,
                const Colour& colour) {
  const Curve curve = all.marks ? all : thinned(all, static_cast<std::size_t>(4 * panel.width));
  Path path{{}, false, {}, Stroke{colour, 1.8, {}}};
  const auto flush = [&] {
    if (path.points.size() > 1) drawing.add(path);
    if (path.points.size() == 1) draw_mark(drawing, path.points[0], colour);
    path.points.clear();
  };
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) {
      flush();
      continue;
    }
    path.points.push_back(panel.at(curve.x[i] / per_x, curve.y[i] / per_y));
    if (curve.marks) flush();
  }
  flush();
}

}  // namespace

Curve thinned(const Curve& curve, std::size_t count) {
  const std::size_t n = curve.x.size();
  if (n <= count || count < 8) return curve;
  Curve few{curve.name, {}, {}, curve.marks};
  const std::size_t bins = count / 4;
  for (std::size_t b = 0; b < bins; ++b) {
    const std::size_t begin = b * n / bins, end = (b + 1) * n / bins;
    const auto at = [&](auto it) { return static_cast<std::size_t>(it - curve.y.begin()); };
    const auto first = curve.y.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = curve.y.begin() + static_cast<std::ptrdiff_t>(end);
    std::array keep{begin, at(std::min_element(first, last)), at(std::max_element(first, last)), end - 1};
    std::sort(keep.begin(), keep.end());
    for (std::size_t k = 0; k < keep.size(); ++k) {
      if (k > 0 && keep[k] == keep[k - 1]) continue;
      few.x.push_back(curve.x[keep[k]]);
      few.y.push_back(curve.y[keep[k]]);
    }
  }
  return few;
}

Drawing draw_chart(const Chart& chart) {
  constexpr double right = 18, bottom = 52;
  Drawing drawing{chart.width, chart.height, rgb(0xffffff), {}};
  const Range x_range = curves_range(chart, &Curve::x);
  const Range y_range = chart.vertical_range ? *chart.vertical_range : curves_range(chart, &Curve::y);
  const DisplayUnit x_unit = display_unit(chart.horizontal_unit, largest(x_range));
  const DisplayUnit y_unit = display_unit(chart.vertical_unit, largest(y_range));

  const bool legend = chart.curves.size() > 1;
  const double title_height = chart.title.empty() ? 14 : 34;
  const std::vector<LegendPlace> places = legend_places(chart, 16, chart.width - right, title_height + 10);
  const double top = title_height + (legend ? places.back().y - places.front().y + legend_row + 8 : 0);

  Panel panel{0, top, 1, chart.height - top - bottom, {x_range.low / x_unit.factor, x_range.high / x_unit.factor}, {}};
  panel.vertical = {y_range.low / y_unit.factor, y_range.high / y_unit.factor};
  if (panel.horizontal.high <= panel.horizontal.low) panel.horizontal.high = panel.horizontal.low + 1;
  if (!chart.vertical_range) panel.vertical = nice_range(panel.vertical, 6);
  panel.x = vertical_label_width(panel) + 30;
  panel.width = chart.width - panel.x - right;

  draw_grid(drawing, panel);
  drawing.add(Clip{panel.x - 4, panel.y - 4, panel.width + 8, panel.height + 8});
  for (std::size_t c = 0; c < chart.curves.size(); ++c)
    draw_curve(drawing, panel, chart.curves[c], x_unit.factor, y_unit.factor, series_colour(c));
  drawing.add(Unclip{});
  draw_axes(drawing, panel,
            {with_unit(chart.horizontal, x_unit.name), with_unit(chart.vertical, y_unit.name), true, true, false});

  if (!chart.title.empty())
    drawing.add(Text{{16, 22}, fitted(chart.title, chart.width - 32, 13, true), 13, ink::text, Anchor::start, true});
  for (std::size_t c = 0; legend && c < chart.curves.size(); ++c) {
    const auto [x, y] = places[c];
    if (chart.curves[c].marks)
      draw_mark(drawing, {x + 9, y - 4}, series_colour(c));
    else
      drawing.line({x, y - 4}, {x + 18, y - 4}, Stroke{series_colour(c), 2.4, {}});
    drawing.add(Text{{x + 24, y}, chart.curves[c].name, tick_size, ink::text});
  }
  return drawing;
}

std::vector<Chart> history_charts(const History& history) {
  constexpr double like_size = 50;
  constexpr std::size_t most_curves = 6;
  struct Group {
    Chart chart;
    double size = 0;
  };
  std::vector<Group> groups;
  for (std::size_t c = 1; c < history.columns.size(); ++c) {
    const HistoryColumn& column = history.columns[c];
    const double size = largest(range_of(history.values[c]));
    const auto fits = [&](const Group& group) {
      return group.chart.vertical_unit == column.unit && group.chart.curves.size() < most_curves &&
             (size == 0 || group.size == 0 || std::max(size, group.size) < like_size * std::min(size, group.size));
    };
    auto group = std::find_if(groups.begin(), groups.end(), fits);
    if (group == groups.end()) {
      groups.push_back({{"", "time", "", history.columns[0].unit, column.unit, {}, {}}, 0});
      group = groups.end() - 1;
    }
    group->size = std::max(group->size, size);
    group->chart.curves.push_back({column.name, history.values[0], history.values[c]});
  }
  std::vector<Chart> charts;
  for (Group& group : groups) {
    if (group.chart.curves.size() == 1) group.chart.title = group.chart.curves.front().name;
    charts.push_back(std::move(group.chart));
  }
  return charts;
}

}  // namespace polder
