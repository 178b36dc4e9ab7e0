// What no single key can tell: each function looks at one kind of contradiction.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "polder/case/geometry.hpp"
#include "polder/case/ground_section.hpp"
#include "polder/case/sections.hpp"
#include "polder/math/units.hpp"

namespace polder::case_file {
namespace {

constexpr double round_off = 1e-9;  // of the model's size, below which lengths count as equal

struct Checking {
  const Sections& sections;
  Model& model;
  Diagnostics& diagnostics;

  bool solid() const { return model.space == SpaceKind::solid; }
  int axes() const { return solid() ? 3 : 2; }
  double width() const { return model.size[0]; }
  double height() const { return model.size[static_cast<std::size_t>(axes() - 1)]; }
  double tolerance() const { return round_off * std::max(width(), height()); }
  /// Size and cell could be read.
  bool has_grid() const {
    for (std::size_t k = 0; k < static_cast<std::size_t>(axes()); ++k)
      if (!(model.size[k] > 0 && model.cell[k] > 0)) return false;
    return true;
  }
};

/// The polygon is sound, in the model, and in 3d its span is too. False where it should not be looked at any further.
bool check_region(const Checking& c, const Region& region, const Fields& f, std::string_view key) {
  const auto& polygon = region.polygon;
  if (polygon.size() < 3) return false;
  if (const auto at = self_intersection(polygon)) {
    report(c.diagnostics, f.place_of(key), f.path_of(key),
           fmt::format("the outline crosses or touches itself at ({:.6g}, {:.6g}) m", (*at)[0], (*at)[1]),
           "list the corners in the order in which one walks around the body, each once");
    return false;
  }
  if (area(polygon) <= c.tolerance() * c.tolerance()) {
    report(c.diagnostics, f.place_of(key), f.path_of(key), "encloses no area", "give corners that are not on one line");
    return false;
  }
  for (const Point2& p : polygon)
    if (p[0] < -c.tolerance() || p[0] > c.width() + c.tolerance() || p[1] < -c.tolerance() ||
        p[1] > c.height() + c.tolerance()) {
      report(c.diagnostics, f.place_of(key), f.path_of(key),
             fmt::format("the corner ({:.6g}, {:.6g}) m is outside the model", p[0], p[1]),
             fmt::format("the model reaches from (0, 0) to ({:.6g}, {:.6g}) m", c.width(), c.height()));
      return false;
    }
  const double depth = c.model.size[1];
  if (c.solid() && std::isfinite(region.across[0]) &&
      (region.across[0] < -c.tolerance() || region.across[1] > depth + c.tolerance() ||
       !(region.across[0] < region.across[1]))) {
    report(c.diagnostics, f.place_of("across"), f.path,
           fmt::format("the span {:.6g} m to {:.6g} m across the section is empty or outside the model",
                       region.across[0], region.across[1]),
           fmt::format("y reaches from 0 to {:.6g} m", depth));
    return false;
  }
  return true;
}

struct Body {
  const Region& region;
  const Fields& fields;
};

/// Reports at `b` that it lies on `a`, if it does.
void refuse_overlap(const Checking& c, const Body& a, const Body& b, std::string_view help) {
  const Region &under = a.region, &over = b.region;
  if (std::min(under.across[1], over.across[1]) <= std::max(under.across[0], over.across[0])) return;
  const Overlap common = overlap(under.polygon, over.polygon);
  if (common.area <= round_off * std::min(area(under.polygon), area(over.polygon))) return;
  const Fields& f = b.fields;
  const std::string_view shape = f.find("box") ? "box" : f.find("region") ? "region" : "polygon";
  report(c.diagnostics, f.place_of(shape), f.path,
         fmt::format("overlaps {} by {:.3g} m2, around ({:.4g}, {:.4g}) m", a.fields.path, common.area,
                     common.inside[0], common.inside[1]),
         std::string(help));
}

void refuse_overlaps(const Checking& c, const std::vector<Body>& bodies, std::string_view help) {
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) refuse_overlap(c, bodies[j], bodies[i], help);
}

void check_bodies(const Checking& c) {
  std::vector<Body> soils, waters, reservoirs;
  const auto gather = [&](const auto& bodies, const std::vector<Fields>& fields, std::vector<Body>& sound) {
    for (std::size_t i = 0; i < bodies.size(); ++i)
      if (check_region(c, bodies[i].region, fields[i], fields[i].find("box") ? "box" : "polygon"))
        sound.push_back({bodies[i].region, fields[i]});
  };
  gather(c.model.soils, c.sections.soils, soils);
  gather(c.model.free_water, c.sections.free_water, waters);
  for (std::size_t i = 0; i < c.model.boundaries.size(); ++i) {
    const Fields& f = c.sections.boundaries[i];
    if (c.model.boundaries[i].water == WaterCondition::reservoir &&
        check_region(c, c.model.boundaries[i].region, f, "region"))
      reservoirs.push_back({c.model.boundaries[i].region, f});
  }
  for (std::size_t i = 0; i < c.model.changes.size(); ++i)
    check_region(c, c.model.changes[i].region, c.sections.changes[i],
                 c.sections.changes[i].find("box") ? "box" : "polygon");
  refuse_overlaps(c, soils, "bodies of soil may touch but not overlap");
  refuse_overlaps(c, waters, "bodies of free water may touch but not overlap");
  refuse_overlaps(c, reservoirs, "reservoirs may touch but not overlap");
  for (const Body& reservoir : reservoirs)
    for (const Body& soil : soils)
      refuse_overlap(c, soil, reservoir, "a reservoir keeps its level in free water; end it where the soil begins");
  if (c.sections.soils.empty() && c.sections.free_water.empty() &&
      std::none_of(c.model.boundaries.begin(), c.model.boundaries.end(),
                   [](const Boundary& b) { return b.water == WaterCondition::reservoir; }))
    report(c.diagnostics, c.sections.model.place, "soil", "there is neither soil nor water in the model",
           "add a [[soil]] or a [[free_water]]");
  for (std::size_t i = 0; i < c.sections.materials.size(); ++i) {
    const std::string& name = c.model.materials[i].name;
    const auto names_it = [&](const Fields& f) { return f.text("material") == name; };
    const bool used = std::any_of(c.sections.soils.begin(), c.sections.soils.end(), names_it) ||
                      std::any_of(c.sections.changes.begin(), c.sections.changes.end(), names_it);
    if (!used && !name.empty())
      warn(c.diagnostics, c.sections.materials[i].place_of("name"), c.sections.materials[i].path, "is used by no soil");
  }
}

void check_laws(const Checking& c) {
  for (std::size_t i = 0; i < c.sections.laws.size(); ++i) {
    const LawDescription* law = c.sections.laws[i];
    const Fields& f = c.sections.materials[i];
    const MaterialInput& material = c.model.materials[i];
    if (!law || !law->check) continue;
    const bool all_read = std::all_of(law->parameters.begin(), law->parameters.end(), [&](const Parameter& p) {
      return f.find(p.key) || (!f.is_given(p.key) && !p.required);
    });
    if (!all_read) continue;
    const LawContext context{smallest_cell(c.model), material.porosity, material.max_porosity};
    for (const Complaint& complaint : law->check(material.law_parameters, context))
      report(c.diagnostics, f.place_of(complaint.key), f.path_of(complaint.key), complaint.message);
  }
}

void check_initial(const Checking& c) {
  const Fields& f = c.sections.initial;
  const auto& line = c.model.water_table;
  for (std::size_t i = 1; i < line.size(); ++i)
    if (!(line[i][0] > line[i - 1][0])) {
      report(c.diagnostics, f.place_of("water_table"), f.path_of("water_table"),
             fmt::format("x does not increase: {:.6g} m is followed by {:.6g} m", line[i - 1][0], line[i][0]),
             "list the points from left to right");
      break;
    }
  if (c.has_grid())
    for (const Point2& p : line)
      if (p[1] > c.height() + c.tolerance() || p[1] < -c.tolerance()) {
        report(c.diagnostics, f.place_of("water_table"), f.path_of("water_table"),
               fmt::format("the water table is {} the model at ({:.6g}, {:.6g}) m", p[1] < 0 ? "below" : "above", p[0],
                           p[1]),
               fmt::format("its height must lie between 0 and {:.6g} m", c.height()));
        break;
      }
  if (c.model.initial_seepage && !line.empty())
    report(c.diagnostics, f.place_of("water_table"), f.path_of("water_table"),
           "the water table is computed: initial.seepage is set", "leave one of them out");
  if (c.model.initial_seepage && (c.model.space == SpaceKind::solid || c.model.soils.empty()))
    report(c.diagnostics, f.place_of("seepage"), f.path_of("seepage"), "takes soil in plane strain",
           "give initial.water_table");
  if (c.model.initial_stress == InitialStress::gravity &&
      std::none_of(c.model.stages.begin(), c.model.stages.end(), [](const Stage& s) { return s.initial; }))
    report(c.diagnostics, f.place_of("stress"), f.path_of("stress"), "\"gravity\" needs a stage in which it is raised",
           "add a [[stage]] with initial = true before the others");
  const bool sloping = c.model.initial_stress == InitialStress::k0_slope;
  if (sloping && c.model.space == SpaceKind::solid)
    report(c.diagnostics, f.place_of("stress"), f.path_of("stress"), "\"k0-slope\" is for plane strain",
           "set stress = \"gravity\" with an initial stage that raises it");
  if (sloping && c.model.k0.value_or(0) >= 1)
    report(c.diagnostics, f.place_of("k0"), f.path_of("k0"), "elastic ground at rest has a K0 below 1",
           "give less, or set stress = \"k0\"");
  if (f.is_given("k0") && !is_by_k0(c.model.initial_stress))
    report(c.diagnostics, f.place_of("k0"), f.path_of("k0"),
           fmt::format("has no meaning with stress = \"{}\"", f.text("stress")),
           "leave it out, or set stress = \"k0\"");
}

void check_line(const Checking& c, Boundary& boundary, const Fields& f) {
  auto& line = boundary.line;
  if (line.size() > 2) {
    report(c.diagnostics, f.place_of("line"), f.path_of("line"), fmt::format("has {} points", line.size()),
           "give the two ends");
    return;
  }
  const bool vertical = line[0][0] == line[1][0], level = line[0][1] == line[1][1];
  if (vertical == level) {
    report(c.diagnostics, f.place_of("line"), f.path_of("line"),
           vertical ? "its ends coincide" : "is neither vertical nor horizontal", "lines follow the grid");
    return;
  }
  const std::size_t axis = vertical ? 0 : 1, grid_axis = axis == 1 && c.solid() ? 2 : axis;
  const GridAxis grid = polder::grid_axis(c.model, grid_axis);
  const double edge = grid.edge(grid.nearest_edge(line[0][axis]));
  if (std::abs(edge - line[0][axis]) > round_off * c.model.size[grid_axis]) {
    report(c.diagnostics, f.place_of("line"), f.path_of("line"),
           fmt::format("{} = {:.10g} m is not on the grid", vertical ? "x" : "height", line[0][axis]),
           fmt::format("the nearest line of the grid is {:.10g} m", edge));
    return;
  }
  for (Point2& p : line) {
    p[axis] = edge;
    if (p[0] < -c.tolerance() || p[0] > c.width() + c.tolerance() || p[1] < -c.tolerance() ||
        p[1] > c.height() + c.tolerance()) {
      report(c.diagnostics, f.place_of("line"), f.path_of("line"),
             fmt::format("the end ({:.6g}, {:.6g}) m is outside the model", p[0], p[1]),
             fmt::format("the model reaches from (0, 0) to ({:.6g}, {:.6g}) m", c.width(), c.height()));
      return;
    }
  }
}

void check_reservoir(const Checking& c, const Boundary& boundary, const Fields& f) {
  if (!f.is_given("region"))
    report(c.diagnostics, f.place_of("water"), f.path, "a reservoir needs a region",
           "add region = [[\"0 m\", \"0 m\"], …]");
  if (!f.is_given("head"))
    report(c.diagnostics, f.place_of("water"), f.path, "a reservoir needs a head",
           "add head = \"0.8 m\", or a hydrograph [[\"0 s\", \"0.8 m\"], [\"1 h\", \"1 m\"]]");
  for (const double head : boundary.head.y)
    if (c.has_grid() && head > c.height() + c.tolerance()) {
      report(c.diagnostics, f.place_of("head"), f.path_of("head"),
             fmt::format("the level {:.6g} m is above the model, which is {:.6g} m high", head, c.height()),
             "lower the level or enlarge the model");
      break;
    }
}

void check_boundaries(const Checking& c) {
  auto& boundaries = c.model.boundaries;
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    Boundary& b = boundaries[i];
    const Fields& f = c.sections.boundaries[i];
    const bool reservoir = b.water == WaterCondition::reservoir;
    const int places = f.is_given("side") + f.is_given("line") + f.is_given("region");
    if (places != 1 && !(reservoir && places == 0))  // check_reservoir asks for the region
      report(c.diagnostics, f.place, f.path, places == 0 ? "has no place" : "has more than one place",
             "give one of side, line, and region (of a reservoir)");
    else if (f.is_given("region") && !reservoir)
      report(c.diagnostics, f.place_of("region"), f.path_of("region"), "only a reservoir has a region",
             "set water = \"reservoir\", or give a side or a line");
    if (reservoir) check_reservoir(c, b, f);
    if (b.line.size() >= 2 && c.has_grid()) check_line(c, b, f);
    if ((b.side == Side::front || b.side == Side::back) && !c.solid())
      report(c.diagnostics, f.place_of("side"), f.path_of("side"),
             fmt::format("plane strain has no {}", f.text("side")), "its sides are left, right, base and top");
    for (std::size_t j = 0; j < i; ++j)
      if (b.side && boundaries[j].side == b.side) {
        report(c.diagnostics, f.place_of("side"), f.path_of("side"),
               fmt::format("the side \"{}\" already has an entry in line {}", f.text("side"),
                           c.sections.boundaries[j].place.line),
               "keep one of them");
        break;
      }
  }
}

void check_stages(const Checking& c) {
  bool event = false;
  for (std::size_t i = 0; i < c.model.stages.size(); ++i) {
    const Stage& stage = c.model.stages[i];
    const Fields& f = c.sections.stages[i];
    if (stage.initial && event)
      report(c.diagnostics, f.place_of("initial"), f.path_of("initial"),
             "an initial stage comes after the event has begun", "put the initial stages first");
    if (f.find("duration") && stage.ramp > stage.duration * (1 + round_off))
      report(c.diagnostics, f.place_of("ramp"), f.path_of("ramp"),
             fmt::format("gravity would rise for {:g} s in a stage of {:g} s", stage.ramp, stage.duration),
             "shorten the ramp or lengthen the stage");
    event = event || !stage.initial;
  }
  if (!event && !c.model.stages.empty())
    report(c.diagnostics, c.sections.stages.back().place, "stage", "there are only initial stages",
           "add a [[stage]] for the event itself");
  double end = 0;
  for (const Stage& stage : c.model.stages)
    if (!stage.initial) end += stage.duration;
  const Fields& output = c.sections.output;
  for (const double t : c.model.output.pictures)
    if (event && t > end * (1 + round_off))
      warn(c.diagnostics, output.place_of("pictures"), output.path_of("pictures"),
           fmt::format("the picture at {:g} s comes after the end of the run at {:g} s", t, end));
}

void check_monitors(const Checking& c) {
  static constexpr std::pair<const char*, const char*> takes[] = {
      {"point",
       "|pressure|excess-pressure|porosity|velocity|displacement|effective-stress|water-velocity|wedge-angle|"
       "total-stress|saturation|"},
      {"section", "|discharge|pressure|uplift-length|"},
      {"surface", "|water-surface|soil-surface|"},
      {"integral",
       "|water-volume|soil-volume|kinetic-energy|settlement|largest-porosity|largest-uplift|eroded-area|water-front|"
       "soil-front|"},
      {"wall", "|force|soil-force|displacement|"}};
  for (std::size_t i = 0; i < c.model.monitors.size(); ++i) {
    const Monitor& monitor = c.model.monitors[i];
    const Fields& f = c.sections.monitors[i];
    for (const auto& [kind, quantities] : takes)
      if (f.text("kind") == kind && f.find("quantity") &&
          std::string_view(quantities).find("|" + monitor.quantity + "|") == std::string_view::npos) {
        std::string known = std::string(quantities).substr(1);
        known.pop_back();
        for (std::size_t bar = known.find('|'); bar != std::string::npos; bar = known.find('|'))
          known.replace(bar, 1, ", ");
        report(c.diagnostics, f.place_of("quantity"), f.path_of("quantity"),
               fmt::format("\"{}\" cannot be recorded by a monitor of kind \"{}\"", monitor.quantity, kind),
               fmt::format("that kind takes {}", known));
      }
    const bool integral = monitor.kind == MonitorKind::integral, wall = monitor.kind == MonitorKind::wall;
    for (const auto& [key, means] : {std::pair{"at", !integral && !wall}, {"region", integral}, {"wall", wall}})
      if (!means && f.is_given(key))
        report(c.diagnostics, f.place_of(key), f.path_of(key),
               fmt::format("has no meaning for a monitor of kind \"{}\"", f.text("kind")), "leave it out");
    if (wall && !f.is_given("wall"))
      report(c.diagnostics, f.place, f.path_of("wall"), "missing", "say of which body: wall = \"footing\"");
    if (wall && monitor.wall >= 0 && c.model.walls[static_cast<std::size_t>(monitor.wall)].polygon.empty())
      report(c.diagnostics, f.place_of("wall"), f.path_of("wall"), "is a thin wall, whose load is not computed",
             "give the wall as a body, by a polygon or a box");
    if (!integral && !wall && !f.is_given("at"))
      report(c.diagnostics, f.place, f.path_of("at"), "missing", "say where: at = [[\"1 m\", \"0.5 m\"]]");
    if (monitor.kind == MonitorKind::section && f.find("at") && monitor.at.size() != 2)
      report(c.diagnostics, f.place_of("at"), f.path_of("at"),
             fmt::format("has {} point{}", monitor.at.size(), monitor.at.size() == 1 ? "" : "s"),
             "a section is a line of two points");
    if (integral && f.find("region") && c.has_grid()) check_region(c, monitor.region, f, "region");
    if (const Entry* at = f.find("at"); at && c.has_grid())
      for (const auto& p : at->points) {
        bool inside = true;
        for (std::size_t k = 0; k < p.size(); ++k) {
          const std::size_t axis = p.size() == 2 && k == 1 ? static_cast<std::size_t>(c.axes() - 1) : k;
          inside =
              inside && p[k] >= -c.tolerance() && p[k] <= c.model.size[std::min<std::size_t>(axis, 2)] + c.tolerance();
        }
        if (p.size() != static_cast<std::size_t>(c.axes()))
          report(c.diagnostics, at->place, f.path_of("at"), fmt::format("a point with {} coordinates", p.size()),
                 c.solid() ? "in 3d a point is [x, y, height]" : "in plane strain a point is [x, height]");
        else if (!inside)
          report(c.diagnostics, at->place, f.path_of("at"),
                 fmt::format("the point ({:.6g}) m is outside the model", fmt::join(p, ", ")), "put it inside");
        else
          continue;
        break;
      }
  }
}

}  // namespace

void check_model(const Sections& sections, Model& model, Diagnostics& diagnostics) {
  const Checking c{sections, model, diagnostics};
  if (c.has_grid()) {
    check_grid(sections, model, diagnostics);
    check_bodies(c);
  }
  check_laws(c);
  check_initial(c);
  check_boundaries(c);
  check_openings(sections, model, diagnostics);
  check_walls(sections, model, diagnostics);
  check_sides(sections, model, diagnostics);
  check_stages(c);
  check_ground(sections, model, diagnostics);
  check_monitors(c);
}

}  // namespace polder::case_file
