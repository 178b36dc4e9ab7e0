#include "polder/stability/stix_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "polder/stability/columns.hpp"
#include "polder/stability/strength.hpp"

namespace polder::stability {
namespace {

constexpr double cell = 0.5;  // m

struct Writer {
  std::string text;
  double dx = 0, dz = 0;  // m, added to every coordinate

  std::string point(const Point& p) const { return fmt::format("[{:.4f}, {:.4f}]", p[0] + dx, p[1] + dz); }
  std::string points(const Line& line) const {
    std::string list = "[";
    for (std::size_t i = 0; i < line.size(); ++i) list += (i > 0 ? ", " : "") + point(line[i]);
    return list + "]";
  }
  // A level as a function of x needs two points in the file.
  std::string level_line(Line line) const {
    if (line.size() == 1) line.push_back({line[0][0] + 1, line[0][1]});
    return points(line);
  }
  template <class... T>
  void line(fmt::format_string<T...> format, T&&... values) {
    text += fmt::format(format, std::forward<T>(values)...) + "\n";
  }
};

// Names in a case file have no dots, commas, equal signs or quotes.
std::string plain(std::string name) {
  std::erase_if(name, [](char c) { return c == '.' || c == ',' || c == '=' || c == '"' || c == '\''; });
  return name;
}

double degrees(double angle) { return angle * 180 / std::numbers::pi; }

void write_strength(Writer& out, const std::string& material, const char* where, const Strength& s,
                    std::vector<std::string>& notes) {
  out.line("\n[[strength]]\nmaterial = \"{}\"\nwhere = \"{}\"", material, where);
  switch (s.model) {
    case StrengthModel::table:
      notes.push_back(material + ": a table of strengths cannot be written into a case file; it has no strength there");
      [[fallthrough]];
    case StrengthModel::drained:
      out.line("model = \"drained\"\ncohesion = \"{:g} kPa\"\nfriction_angle = \"{:g} deg\"", s.cohesion / 1e3,
               degrees(s.friction_angle));
      if (s.dilatancy_angle) out.line("dilatancy_angle = \"{:g} deg\"", degrees(*s.dilatancy_angle));
      break;
    case StrengthModel::undrained:
      out.line("model = \"undrained\"\nundrained_strength = \"{:g} kPa\"", s.undrained_strength / 1e3);
      break;
    case StrengthModel::shansep:
      out.line("model = \"shansep\"\nratio = {:g}\nexponent = {:g}", s.ratio, s.exponent);
      break;
  }
}

// Overburden at the middle of the layer's box, or nearest below the ground there.
double overburden_of(const PreparedSection& prepared, int layer) {
  double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
  for (const Point& p : prepared.section.layers[static_cast<std::size_t>(layer)].polygon)
    for (std::size_t k = 0; k < 2; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  const Point at{(low[0] + high[0]) / 2, (low[1] + high[1]) / 2};
  const PreparedSection& reference = prepared.before.empty() ? prepared : prepared.before.front();
  return yield_stress(prepared, layer, at[0], at[1]) - vertical_effective_stress(reference, at[0], at[1]);
}

// The layer as polygons without holes: runs of columns in which it has equally many pieces that adjoin.
std::vector<std::vector<Point>> outlines(const PreparedSection& prepared, int layer) {
  struct Chain {
    Line top, base;
  };
  std::vector<std::vector<Point>> polygons;
  std::vector<Chain> open;
  const auto close = [&] {
    for (const Chain& chain : open) {
      std::vector<Point> polygon = chain.base;
      for (auto p = chain.top.rbegin(); p != chain.top.rend(); ++p)
        if (std::hypot((*p)[0] - polygon.back()[0], (*p)[1] - polygon.back()[1]) > 1e-4) polygon.push_back(*p);
      if (std::hypot(polygon.front()[0] - polygon.back()[0], polygon.front()[1] - polygon.back()[1]) < 1e-4)
        polygon.pop_back();
      polygons.push_back(std::move(polygon));
    }
    open.clear();
  };
  for (const Column& column : prepared.columns) {
    std::vector<Piece> pieces;
    for (const Piece& piece : column.pieces)
      if (piece.layer == layer) pieces.push_back(piece);
    bool adjoin = pieces.size() == open.size();
    for (std::size_t i = 0; adjoin && i < pieces.size(); ++i)
      adjoin = std::abs(open[i].top.back()[1] - pieces[i].top[0]) < 1e-4 &&
               std::abs(open[i].base.back()[1] - pieces[i].base[0]) < 1e-4;
    if (!adjoin) {
      close();
      for (const Piece& piece : pieces) open.push_back({{{column.left, piece.top[0]}}, {{column.left, piece.base[0]}}});
    }
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      open[i].top.push_back({column.right, pieces[i].top[1]});
      open[i].base.push_back({column.right, pieces[i].base[1]});
    }
  }
  close();
  return polygons;
}

bool is_shansep(const Soil& soil) {
  return soil.above.model == StrengthModel::shansep || soil.below.model == StrengthModel::shansep;
}

void write_soils(Writer& out, const PreparedSection& prepared, std::vector<std::string>& notes) {
  constexpr double grains = 2650, water = 1000, g = 9.81;
  const Section& section = prepared.section;
  for (std::size_t i = 0; i < section.layers.size(); ++i) {
    const Soil& soil = section.soils[static_cast<std::size_t>(section.layers[i].soil)];
    const std::string name = fmt::format("{} {}", plain(soil.name), i + 1);
    const double porosity = std::clamp((grains * g - soil.saturated_unit_weight) / ((grains - water) * g), 0.05, 0.95);
    out.line("\n[[material]]\nname = \"{}\"\nlaw = \"mohr-coulomb\"\ngrain_density = \"2650 kg/m3\"\nporosity = {:.4f}",
             name, porosity);
    out.line("max_porosity = {:.4f}", std::min(0.98, porosity + 0.1));
    out.line("young_modulus = \"5 MPa\"       # assumed: the model has no stiffness\npoisson_ratio = 0.3");
    out.line("permeability = \"1e-6 m/s\"     # assumed: the model has no permeability");
    const double friction = soil.above.model == StrengthModel::drained ? degrees(soil.above.friction_angle) : 0;
    out.line("friction_angle = \"{:g} deg\"{}", friction > 0 ? friction : 30, friction > 0 ? "" : "     # assumed");
    const auto polygons = outlines(prepared, static_cast<int>(i));
    for (std::size_t k = 0; k < polygons.size(); ++k)
      out.line("\n[[soil]]\nname = \"layer {}{}\"\nmaterial = \"{}\"\npolygon = {}", i + 1,
               k > 0 ? fmt::format(" part {}", k + 1) : "", name, out.points(polygons[k]));
    write_strength(out, name, "above", soil.above, notes);
    write_strength(out, name, "below", soil.below, notes);
    out.line("unit_weight = \"{:g} kN/m3\"\nsaturated_unit_weight = \"{:g} kN/m3\"", soil.unit_weight / 1e3,
             soil.saturated_unit_weight / 1e3);
    if (is_shansep(soil))
      out.line("overburden = \"{:.3f} kPa\"", std::max(0.0, overburden_of(prepared, static_cast<int>(i))) / 1e3);
  }
}

// One degree for all layers, the least of them.
void write_consolidation(Writer& out, const std::vector<double>& degrees_by_layer) {
  const auto least = std::min_element(degrees_by_layer.begin(), degrees_by_layer.end());
  if (least != degrees_by_layer.end() && *least < 1) out.line("consolidation = {:g}", *least);
}

void write_stability(Writer& out, const StixCalculation& calculation, const PreparedSection& prepared) {
  const Section& section = prepared.section;
  out.line("\n[stability]");
  if (!section.water.phreatic.empty()) out.line("phreatic_line = {}", out.level_line(section.water.phreatic));
  if (!prepared.before.empty() && !prepared.before.front().section.water.phreatic.empty())
    out.line("daily_phreatic_line = {}", out.level_line(prepared.before.front().section.water.phreatic));
  const SlipLimits& limits = section.limits;
  const auto range = [&](const char* key, const std::optional<Range>& span) {
    if (span) out.line("{} = [{:.4f}, {:.4f}]", key, (*span)[0] + out.dx, (*span)[1] + out.dx);
  };
  range("entry", limits.entry);
  range("exit", limits.exit);
  out.line("minimum_depth = {:g}", limits.minimum_depth);
  if (limits.minimum_length > 0) out.line("minimum_length = {:g}", limits.minimum_length);
  if (!limits.forbidden_lines.empty()) out.line("forbidden_line = {}", out.points(limits.forbidden_lines.front()));
  if (calculation.circle && calculation.analysis.starts_with("Bishop"))
    out.line("circle_centre = [{}]\ncircle_radius = {:.6f}", out.point(calculation.circle->centre),
             calculation.circle->radius);
  if (calculation.plane)
    out.line("plane_centres = [{}, {}]\nplane_level = {:.6f}", out.point(calculation.plane->active),
             out.point(calculation.plane->passive), calculation.plane->tangent + out.dz);
  if (!calculation.surface.empty()) out.line("slip_surface = {}", out.points(calculation.surface));
  for (const ReferenceLine& reference : section.water.references)
    out.line("\n[[head_line]]\nline = {}\nhead_above = {}\nhead_below = {}", out.level_line(reference.line),
             out.level_line(reference.head_above), out.level_line(reference.head_below));
  for (std::size_t i = 0; i < section.strip_loads.size(); ++i) {
    const StripLoad& load = section.strip_loads[i];
    out.line("\n[[load]]\nname = \"load {}\"\nspan = [{:.4f}, {:.4f}]\npressure = \"{:g} kPa\"\nspread = \"{:g} deg\"",
             i + 1, load.from + out.dx, load.to + out.dx, load.pressure / 1e3, degrees(load.spread));
    write_consolidation(out, load.consolidation);
  }
  for (std::size_t i = 0; i < section.line_loads.size(); ++i) {
    const LineLoad& load = section.line_loads[i];
    out.line(
        "\n[[line_load]]\nname = \"line load {}\"\nat = [{}]\nforce = \"{:g} kN/m\"\nangle = \"{:g} deg\"\n"
        "spread = \"{:g} deg\"",
        i + 1, out.point(load.at), load.force / 1e3, degrees(load.angle), degrees(load.spread));
    write_consolidation(out, load.consolidation);
  }
}

}  // namespace

std::string case_text(const StixCalculation& calculation, const std::string& source, std::vector<std::string>& notes) {
  const PreparedSection prepared = prepare(calculation.section);
  double bottom = 1e300, top = -1e300;
  for (const Column& column : prepared.columns)
    for (const int side : {0, 1}) {
      bottom = std::min(bottom, column.pieces.back().base[side]);
      top = std::max(top, column.pieces.front().top[side]);
    }
  Writer out;
  out.dx = -prepared.left(), out.dz = -bottom;
  const auto whole = [](double length) { return std::ceil(length / cell - 1e-9) * cell; };
  out.line(
      "# {}, calculation \"{}\" of stage \"{}\"; moved by ({:.4f}, {:.4f}) m so that the model begins at the origin.",
      source, calculation.label, calculation.stage, out.dx, out.dz);
  if (calculation.stored_factor) out.line("# Factor of safety stored in it: {:.4f}.", *calculation.stored_factor);
  out.line("\n[model]\ntitle = \"{}\"\nsize = [{:g}, {:g}]\ncell = {:g}", calculation.label,
           whole(prepared.right() - prepared.left()), whole(top - bottom), cell);
  write_soils(out, prepared, notes);
  out.line("\n[[stage]]\nname = \"rest\"\nduration = \"1 s\"");
  write_stability(out, calculation, prepared);
  return out.text;
}

}  // namespace polder::stability
