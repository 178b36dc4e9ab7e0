#include "polder/result/model_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "polder/case/wall_line.hpp"
#include "polder/result/model_actions.hpp"
#include "polder/result/model_symbols.hpp"
#include "polder/result/paint.hpp"
#include "polder/result/panel.hpp"

namespace polder {
namespace {

constexpr double band = 18;  // around the model, for the symbols of its sides

Path region_path(const Panel& panel, const Region& region, std::optional<Colour> fill, std::optional<Stroke> stroke) {
  Path path{{}, true, fill, std::move(stroke)};
  for (const Point2& p : region.polygon) path.points.push_back(panel.at(p));
  return path;
}

void draw_cells(Drawing& drawing, const Panel& panel, const Model& model, std::size_t up) {
  const double least = std::min(model.cell[0], model.cell[up]) * panel.scale();
  if (least < 3) return;  // a grey veil would tell nothing
  const Stroke stroke{rgb(0x20303c, least < 8 ? 0.07 : 0.12), 0.6, {}};
  const auto lines = [&](std::size_t axis, auto&& from, auto&& to) {
    const GridAxis grid = grid_axis(model, axis);
    for (int i = 0; i <= grid.cells(); ++i) drawing.line(from(grid.edge(i)), to(grid.edge(i)), stroke);
  };
  lines(
      0, [&](double x) { return panel.at(x, 0); }, [&](double x) { return panel.at(x, model.size[up]); });
  lines(
      up, [&](double y) { return panel.at(0, y); }, [&](double y) { return panel.at(model.size[0], y); });
}

void draw_water_level(Drawing& drawing, const Panel& panel, const Region& region) {
  double top = -std::numeric_limits<double>::infinity();
  for (const Point2& p : region.polygon) top = std::max(top, p[1]);
  double left = std::numeric_limits<double>::infinity(), right = -left;
  for (const Point2& p : region.polygon)
    if (p[1] > top - 1e-9) left = std::min(left, p[0]), right = std::max(right, p[0]);
  if (right <= left) return;
  drawing.line(panel.at(left, top), panel.at(right, top), Stroke{ink::water_line, 1.4, {}});
  draw_level_mark(drawing, panel.at(left + 0.3 * (right - left), top));
}

void draw_water_table(Drawing& drawing, const Panel& panel, const std::vector<Point2>& line) {
  if (line.empty()) return;
  Path path{{}, false, {}, Stroke{ink::water_line, 1.4, {7, 4}}};
  for (const Point2& p : line) path.points.push_back(panel.at(p));
  drawing.add(path);
  draw_level_mark(drawing, path.points[path.points.size() / 2]);
}

void draw_monitors(Drawing& drawing, const Panel& panel, const Model& model, std::size_t up) {
  const auto place = [&](const Point3& p) { return panel.at(p[0], p[up]); };
  for (std::size_t m = 0; m < model.monitors.size(); ++m) {
    const Monitor& monitor = model.monitors[m];
    if (monitor.at.empty()) continue;
    if (monitor.at.size() > 1) {
      Path path{{}, false, {}, Stroke{series_colour(1), 1.4, {2, 3}}};
      for (const Point3& p : monitor.at) path.points.push_back(place(p));
      drawing.add(path);
    }
    const Point2 at = place(monitor.at.front());
    drawing.add(Disc{at, 7, rgb(0xffffff, 0.9), Stroke{series_colour(1), 1.4, {}}});
    drawing.add(Text{{at[0], at[1] + 3.4}, std::to_string(m + 1), 9, ink::text, Anchor::middle, true});
  }
}

/// Where later stages dig, fill and convert.
void draw_changes(Drawing& drawing, const Panel& panel, const Model& model) {
  for (const GroundChange& change : model.changes)
    drawing.add(region_path(panel, change.region, std::nullopt, Stroke{ink::soft, 1.4, {5, 3}}));
}

void draw_wells(Drawing& drawing, const Panel& panel, const Model& model, std::size_t up) {
  for (const Well& well : model.wells) {
    const Point2 from = panel.at(well.at.front()[0], well.at.front()[up]);
    const Point2 to = panel.at(well.at.back()[0], well.at.back()[up]);
    if (well.at.size() > 1) drawing.line(from, to, Stroke{ink::water_line, 3, {2, 2}});
    drawing.add(Disc{from, 4.5, rgb(0xffffff), Stroke{ink::water_line, 2, {}}});
  }
}

void draw_walls(Drawing& drawing, const Panel& panel, const Model& model) {
  for (const WallInput& wall : model.walls) {
    if (!wall.polygon.empty()) {
      drawing.add(region_path(panel, {wall.polygon, {}}, rgb(0xb9bec4), Stroke{ink::wall, 1.6, {}}));
      continue;
    }
    Path path{{}, false, {}, Stroke{ink::wall, 3, {}}};
    if (is_gate(wall)) path.stroke->dash = {7, 3};
    for (const Point2& p : stepped_wall(wall.line, model).corners) path.points.push_back(panel.at(p));
    drawing.add(path);
  }
}

std::string length(double metres) { return number_text(metres) + " m"; }

std::string subtitle(const Model& model, std::size_t up) {
  const bool solid = model.space == SpaceKind::solid;
  std::string cell = length(model.cell[0]);
  if (model.cell[0] != model.cell[up] || (solid && model.cell[0] != model.cell[1])) {
    cell = number_text(model.cell[0]) + (solid ? " × " + number_text(model.cell[1]) : "") + " × " +
           number_text(model.cell[up]) + " m";
  }
  const auto count = [&](std::size_t axis) { return grid_axis(model, axis).cells(); };
  if (smallest_cell(model) < *std::min_element(model.cell.begin(), model.cell.begin() + static_cast<int>(up) + 1))
    cell += fmt::format(", down to {}", length(smallest_cell(model)));
  return fmt::format("{}, {} × {}{}; cells of {} ({} × {}{})", solid ? "3d" : "plane strain", length(model.size[0]),
                     solid ? length(model.size[1]) + " × " : "", length(model.size[up]), cell, count(0),
                     solid ? fmt::format("{} × ", count(1)) : "", count(up));
}

struct Entry {
  void (*symbol)(Drawing&, double x, double y, const Colour&);
  Colour colour;
  std::string text;
};

std::vector<Entry> legend_entries(const Model& model, const std::vector<Colour>& colours) {
  std::vector<Entry> entries;
  for (std::size_t m = 0; m < model.materials.size(); ++m) {
    const MaterialInput& material = model.materials[m];
    entries.push_back({swatch, colours[m],
                       fmt::format("{}: {}, n = {}{}", material.name, material.law, number_text(material.porosity),
                                   material.fixed ? ", fixed" : "")});
  }
  const auto any = [&](auto condition) {
    return std::any_of(model.boundaries.begin(), model.boundaries.end(), condition);
  };
  if (!model.free_water.empty()) entries.push_back({swatch, ink::water, "free water"});
  if (!model.water_table.empty()) entries.push_back({dashes, ink::water_line, "water table"});
  if (any([](const Boundary& b) { return b.water == WaterCondition::reservoir; }))
    entries.push_back({striped_swatch, ink::water_line, "reservoir (head held)"});
  if (any([](const Boundary& b) { return b.water == WaterCondition::open; }))
    entries.push_back({heavy_dashes, ink::water_line, "open to water"});
  if (any([](const Boundary& b) { return b.soil == SoilCondition::absorbing; }))
    entries.push_back({absorbing_sample, ink::axis, "ground goes on (absorbing)"});
  const auto along = [&](SeepageCondition::Kind kind) {
    return std::any_of(model.pore_water.begin(), model.pore_water.end(), [&](const auto& c) { return c.kind == kind; });
  };
  if (along(SeepageCondition::Kind::head)) entries.push_back({head_sample, ink::water_line, "ground under a head"});
  if (along(SeepageCondition::Kind::seepage)) entries.push_back({seepage_sample, ink::water_line, "seepage face"});
  if (along(SeepageCondition::Kind::rain)) entries.push_back({rain_sample, ink::water_line, "rain"});
  if (!model.loads.empty()) entries.push_back({load_sample, ink::text, "load on the ground"});
  if (!model.wells.empty()) entries.push_back({well_sample, ink::water_line, "well, drain"});
  if (!model.changes.empty()) entries.push_back({change_sample, ink::soft, "changed by a later stage"});
  const auto gates = std::count_if(model.walls.begin(), model.walls.end(), is_gate);
  if (static_cast<std::size_t>(gates) < model.walls.size()) entries.push_back({wall_sample, ink::wall, "wall"});
  if (gates > 0) entries.push_back({gate_sample, ink::wall, "gate (vanishes)"});
  if (any([](const Boundary& b) { return b.soil == SoilCondition::roller; }))
    entries.push_back({roller_sample, ink::axis, "soil slides along (rollers)"});
  if (any([](const Boundary& b) { return b.soil == SoilCondition::rough; }))
    entries.push_back({hatch_sample, ink::axis, "soil held (rough)"});
  return entries;
}

struct Legend {
  std::vector<Point2> at;  ///< relative to its top left
  double height = 0;
};

Legend legend_layout(const std::vector<std::string>& texts, double width) {
  constexpr double row = 20, symbol = 30, space = 22;
  Legend legend;
  double x = 0, y = 0;
  for (const std::string& text : texts) {
    const double wide = symbol + text_width(text, tick_size) + space;
    if (x > 0 && x + wide > width) x = 0, y += row;
    legend.at.push_back({x, y});
    x += wide;
  }
  legend.height = texts.empty() ? 0 : y + row;
  return legend;
}

void draw_legend(Drawing& drawing, const Model& model, const std::vector<Entry>& entries, const Legend& legend,
                 double x, double y) {
  for (std::size_t i = 0; i < legend.at.size(); ++i) {
    const double left = x + legend.at[i][0], base = y + legend.at[i][1] + 12;
    std::string text;
    if (i < entries.size()) {
      entries[i].symbol(drawing, left, base - 4, entries[i].colour);
      text = entries[i].text;
    } else {
      const std::size_t m = i - entries.size();
      drawing.add(Disc{{left + 11, base - 4}, 7, rgb(0xffffff), Stroke{series_colour(1), 1.4, {}}});
      drawing.add(Text{{left + 11, base - 0.6}, std::to_string(m + 1), 9, ink::text, Anchor::middle, true});
      text = model.monitors[m].name;
    }
    drawing.add(Text{{left + 28, base}, text, tick_size, ink::text});
  }
}

void draw_bodies(Drawing& drawing, const Panel& panel, const Model& model, const std::vector<Colour>& colours,
                 std::size_t up) {
  for (const FreeWaterBody& body : model.free_water)
    drawing.add(region_path(panel, body.region, ink::water, std::nullopt));
  for (const Boundary& boundary : model.boundaries)
    if (boundary.water == WaterCondition::reservoir) draw_reservoir(drawing, panel, boundary);
  for (const SoilBody& body : model.soils)
    drawing.add(region_path(panel, body.region, colours.at(static_cast<std::size_t>(body.material)),
                            Stroke{rgb(0x5c5648), 1, {}}));
  draw_cells(drawing, panel, model, up);
  for (const FreeWaterBody& body : model.free_water) draw_water_level(drawing, panel, body.region);
  draw_water_table(drawing, panel, model.water_table);
}

}  // namespace

std::vector<Colour> material_colours(const std::vector<std::string>& names) {
  struct Known {
    const char* word;
    Colour colour;
  };
  std::vector<Known> known{{"sand", rgb(0xe9d3a0)}, {"clay", rgb(0xa9bcae)},   {"peat", rgb(0xa2836b)},
                           {"silt", rgb(0xcfc7b8)}, {"gravel", rgb(0xdcb88f)}, {"rock", rgb(0xb9b9bd)},
                           {"core", rgb(0x8fa89b)}, {"block", rgb(0xb4a79c)}};
  std::vector<Colour> others{rgb(0xe2c7b5), rgb(0xc9cfa4), rgb(0xd8bfd0), rgb(0xbfd0d8), rgb(0xe8dcc0), rgb(0xc4b59a)};
  std::vector<Colour> colours;
  std::size_t turn = 0;
  for (const std::string& name : names) {
    const auto named = std::find_if(known.begin(), known.end(),
                                    [&](const Known& k) { return name.find(k.word) != std::string::npos; });
    if (named != known.end()) {
      colours.push_back(named->colour);
      known.erase(named);
    } else {
      colours.push_back(others[turn++ % others.size()]);
    }
  }
  return colours;
}

Drawing draw_model(const Model& model, const ModelStyle& style) {
  constexpr double left = 58 + band, right = 34 + band, top = 68 + band, axis = 46, least_width = 480;
  const std::size_t up = model.space == SpaceKind::solid ? 2 : 1;
  const double scale = std::min((style.width - left - right) / model.size[0], style.max_height / model.size[up]);
  const double width = std::max(least_width, left + model.size[0] * scale + right);
  const double centring = (width - left - model.size[0] * scale - right) / 2;
  const Panel panel{left + centring,    top, model.size[0] * scale, model.size[up] * scale, {0, model.size[0]},
                    {0, model.size[up]}};
  std::vector<std::string> names;
  for (const MaterialInput& material : model.materials) names.push_back(material.name);
  const std::vector<Colour> colours = material_colours(names);
  const std::vector<Entry> entries = legend_entries(model, colours);

  Drawing drawing{width, 0, rgb(0xffffff), {}};
  std::vector<std::string> texts;
  texts.reserve(entries.size() + model.monitors.size());
  for (const Entry& entry : entries) texts.push_back(entry.text);
  for (const Monitor& monitor : model.monitors) texts.push_back(monitor.name);
  const Legend legend = legend_layout(texts, drawing.width - 32);
  const double legend_top = panel.y + panel.height + band + axis;
  drawing.height = legend_top + legend.height + 10;

  draw_bodies(drawing, panel, model, colours, up);
  drawing.rectangle(panel.x, panel.y, panel.width, panel.height, {}, Stroke{ink::axis, 1, {}});
  for (const Boundary& boundary : model.boundaries) draw_boundary(drawing, panel, boundary);
  if (model.space == SpaceKind::plane_strain) {
    draw_pore_water(drawing, panel, model);
    draw_loads(drawing, panel, model);
  }
  draw_changes(drawing, panel, model);
  draw_walls(drawing, panel, model);
  draw_wells(drawing, panel, model, up);
  draw_monitors(drawing, panel, model, up);

  // The scales stand outside the symbols of the sides.
  const double margin = band / scale;
  const Panel outer{panel.x - band,
                    panel.y - band,
                    panel.width + 2 * band,
                    panel.height + 2 * band,
                    {-margin, model.size[0] + margin},
                    {-margin, model.size[up] + margin}};
  draw_axes(drawing, outer, {"x (m)", up == 2 ? "z (m)" : "y (m)", true, true, false});
  draw_dimension(drawing, {panel.x, outer.y - 10}, {panel.x + panel.width, outer.y - 10}, length(model.size[0]));
  const double beside = outer.x + outer.width + 10;
  draw_dimension(drawing, {beside, panel.y + panel.height}, {beside, panel.y}, length(model.size[up]));

  const double title_width = drawing.width - 32;
  drawing.add(Text{{16, 24},
                   fitted(model.title.empty() ? model.name : model.title, title_width, 15, true),
                   15,
                   ink::text,
                   Anchor::start,
                   true});
  drawing.add(Text{{16, 42}, fitted(subtitle(model, up), title_width, label_size), label_size, ink::soft});
  draw_legend(drawing, model, entries, legend, 16, legend_top);
  return drawing;
}

}  // namespace polder
