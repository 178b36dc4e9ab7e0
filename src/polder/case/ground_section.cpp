#include "polder/case/ground_section.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "polder/case/geometry.hpp"
#include "polder/case/ground_load.hpp"

namespace polder::case_file {

int stage_named(const Fields& fields, std::string_view key, const Model& model, Diagnostics& diagnostics) {
  const Entry* entry = fields.find(key);
  if (!entry) return -1;
  const auto stage =
      std::find_if(model.stages.begin(), model.stages.end(), [&](const Stage& s) { return s.name == entry->text; });
  if (stage != model.stages.end()) return static_cast<int>(stage - model.stages.begin());
  std::vector<std::string> names;
  for (const Stage& s : model.stages)
    if (!s.name.empty()) names.push_back(s.name);
  report(diagnostics, entry->place, fields.path_of(key), fmt::format("there is no stage \"{}\"", entry->text),
         names.empty() ? "give the [[stage]] a name" : suggestion(entry->text, names));
  return -1;
}

GroundLoad read_load(const Fields& f, const Model& model, Diagnostics& diagnostics) {
  GroundLoad load;
  load.name = f.text("name");
  if (const Entry* pressure = f.find("pressure")) load.pressure = pressure->table;
  if (const Entry* end = f.find("pressure_at_end")) load.pressure_at_end = end->table;
  load.speed = f.number("speed");
  load.from_stage = stage_named(f, "from_stage", model, diagnostics);
  load.until_stage = stage_named(f, "until_stage", model, diagnostics);
  const Entry* span = f.find("span");
  if (span && span->numbers.size() == 2 && span->numbers[0] < span->numbers[1])
    load.span = {span->numbers[0], span->numbers[1]};
  else if (span)
    report(diagnostics, span->place, f.path_of("span"), "is not [from, to] with from < to",
           "give the two ends of the load along x");
  return load;
}

GroundChange read_change(const Fields& f, const Model& model, Diagnostics& diagnostics) {
  static constexpr ChangeKind kinds[] = {ChangeKind::excavate, ChangeKind::place, ChangeKind::convert};
  static constexpr ExcavatedWater waters[] = {ExcavatedWater::take, ExcavatedWater::leave, ExcavatedWater::replace};
  GroundChange change;
  change.name = f.text("name");
  change.stage = stage_named(f, "stage", model, diagnostics);
  if (const Entry* action = f.find("action")) change.kind = kinds[static_cast<std::size_t>(action->number)];
  if (const Entry* water = f.find("water")) change.water = waters[static_cast<std::size_t>(water->number)];
  if (!f.is_given("material")) return change;
  const std::string name = material_named(f, model, diagnostics);
  const auto known = std::find_if(model.materials.begin(), model.materials.end(),
                                  [&](const MaterialInput& m) { return m.name == name; });
  if (known != model.materials.end()) change.material = static_cast<int>(known - model.materials.begin());
  return change;
}

Well read_well(const Fields& f, const Model& model, Diagnostics& diagnostics) {
  Well well;
  well.name = f.text("name");
  if (const Entry* at = f.find("at"))
    for (const auto& p : at->points) well.at.push_back({p[0], p[1], p.size() > 2 ? p[2] : 0});
  if (const Entry* discharge = f.find("discharge")) well.discharge = discharge->table;
  if (const Entry* head = f.find("head")) well.head = head->table;
  well.radius = f.number("radius");
  well.only_takes = f.flag("only_takes");
  well.from_stage = stage_named(f, "from_stage", model, diagnostics);
  well.until_stage = stage_named(f, "until_stage", model, diagnostics);
  return well;
}

Rain read_rain(const Fields& f, Diagnostics& diagnostics) {
  Rain rain;
  rain.name = f.text("name");
  if (const Entry* rate = f.find("rate")) rain.rate = rate->table;
  const Entry* span = f.find("span");
  if (span && span->numbers.size() == 2 && span->numbers[0] < span->numbers[1])
    rain.span = {span->numbers[0], span->numbers[1]};
  else if (span)
    report(diagnostics, span->place, f.path_of("span"), "is not [from, to] with from < to",
           "give the two ends of the rain along x");
  return rain;
}

namespace {

void check_well(const Well& well, const Fields& f, const Model& model, Diagnostics& diagnostics) {
  const std::size_t axes = model.space == SpaceKind::solid ? 3 : 2;
  if (f.is_given("discharge") == f.is_given("head"))
    report(diagnostics, f.place, f.path, f.is_given("head") ? "has a discharge and a head" : "does nothing",
           "give discharge = \"2e-4 m2/s\" or head = \"0.4 m\", and not both");
  if (well.at.size() > 2)
    report(diagnostics, f.place_of("at"), f.path_of("at"), fmt::format("has {} points", well.at.size()),
           "give one point, or the two ends of a line");
  const bool slot = axes == 2 && well.at.size() == 2;
  if (f.is_given("head") && !f.is_given("radius") && !slot)
    report(diagnostics, f.place_of("head"), f.path, "the radius is missing, on which its flow at a head depends",
           "add radius = \"5 cm\"");
  if (f.is_given("radius") && (slot || !f.is_given("head")))
    report(diagnostics, f.place_of("radius"), f.path_of("radius"),
           slot ? "has no meaning for a slot, which is the height of its line" : "has no meaning with a discharge",
           "leave it out");
  if (f.is_given("only_takes") && !f.is_given("head"))
    report(diagnostics, f.place_of("only_takes"), f.path_of("only_takes"), "has no meaning with a discharge",
           "leave it out");
  if (axes == 3 && well.at.size() == 1)
    report(diagnostics, f.place_of("at"), f.path_of("at"), "has one point; in 3d a well is a line",
           "give the two ends of its screen");
  const Entry* at = f.find("at");
  for (std::size_t i = 0; at && i < at->points.size(); ++i) {
    const auto& p = at->points[i];
    bool inside = p.size() == axes;
    for (std::size_t a = 0; a < p.size() && a < axes; ++a) inside = inside && p[a] >= 0 && p[a] <= model.size[a];
    if (!inside)
      report(diagnostics, at->place, f.path_of("at"),
             p.size() == axes ? fmt::format("the point ({:.6g}) m is outside the model", fmt::join(p, ", "))
                              : fmt::format("a point with {} coordinates", p.size()),
             axes == 3 ? "in 3d a point is [x, y, height], inside the model"
                       : "in plane strain a point is [x, height], inside the model");
  }
  const double across = std::min(model.cell[0], model.cell[1]);
  if (well.radius > 0 && across > 0 && well.radius > 0.2 * across)
    report(diagnostics, f.place_of("radius"), f.path_of("radius"),
           fmt::format("is more than a fifth of a cell of {:.6g} m: the cell would be inside the well", across),
           "take a coarser grid, a slot, or an open side");
}

void check_change(const GroundChange& change, const Fields& f, const Model& model, Diagnostics& diagnostics) {
  const bool digs = change.kind == ChangeKind::excavate;
  if (change.stage == 0)
    report(diagnostics, f.place_of("stage"), f.path_of("stage"),
           fmt::format("\"{}\" is the first stage, which begins with the ground as it is described", f.text("stage")),
           "give the [[soil]] the shape that it begins with, or name a later stage");
  if (!digs && !f.is_given("material"))
    report(diagnostics, f.place_of("action"), f.path, "has no material",
           fmt::format("add material = \"{}\"", model.materials.empty() ? "sand" : model.materials[0].name));
  if (digs && f.find("action") && f.is_given("material"))
    report(diagnostics, f.place_of("material"), f.path_of("material"),
           "has no meaning where soil is excavated: all that is in the region goes", "leave it out");
  if (!digs && f.is_given("water"))
    report(diagnostics, f.place_of("water"), f.path_of("water"), "is only for soil that is excavated", "leave it out");
  if (digs && model.single_point && change.water != ExcavatedWater::take)
    report(diagnostics, f.place_of("water"), f.path_of("water"),
           "cannot stay behind in the single-point formulation, where the soil carries it",
           "leave it out, or set model.formulation = \"double-point\"");
  const auto fixed = [&](const MaterialInput& m) { return m.fixed; };
  if (change.material >= 0 && std::any_of(model.materials.begin(), model.materials.end(), fixed) &&
      !std::all_of(model.materials.begin(), model.materials.end(), fixed))
    report(diagnostics, f.place_of("material"), f.path_of("material"),
           "soil cannot be placed or converted in a model that has both fixed and movable soil",
           "make no material fixed, or all of them");
}

/// The splines of the uppermost points, a quarter of a cell under the ground, must not reach the model's top, which
/// would bear a part of the load.
void check_room_above(const Sections& sections, const Model& model, Diagnostics& diagnostics) {
  const std::size_t up = model.space == SpaceKind::solid ? 2 : 1;
  const double needed = 1.25 * model.cell[up];
  double highest = 0;
  for (const SoilBody& soil : model.soils)
    if (!soil.region.polygon.empty()) highest = std::max(highest, bounds(soil.region.polygon).high[1]);
  if (needed > model.size[up] || model.size[up] - highest > needed * (1 - 1e-9)) return;
  warn(diagnostics, sections.loads.front().place_of("span"), sections.loads.front().path_of("span"),
       fmt::format(
           "the ground reaches {:.6g} m, so near the model's top at {:.6g} m that the top bears a part of the load",
           highest, model.size[up]),
       fmt::format("make the model at least {:.6g} m high", highest + needed));
}

void check_loads(const Sections& sections, const Model& model, Diagnostics& diagnostics) {
  if (!model.loads.empty()) check_room_above(sections, model, diagnostics);
  const auto last = [&](const GroundLoad& l) { return l.until_stage < 0 ? 1 << 30 : l.until_stage; };
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const GroundLoad& load = model.loads[i];
    const Fields& f = sections.loads[i];
    if (!(load.span[0] < load.span[1])) continue;  // reported
    if (load.until_stage >= 0 && load.until_stage <= std::max(0, load.from_stage))
      report(diagnostics, f.place_of("until_stage"), f.path_of("until_stage"), "the load goes before it has come",
             "name a stage after that of from_stage, and not the first one");
    for (std::size_t j = 0; j < i; ++j) {
      const GroundLoad& other = model.loads[j];
      if (!(other.span[0] < other.span[1])) continue;
      const auto a = reach_of(load, model), b = reach_of(other, model);
      const bool together = load.from_stage < last(other) && other.from_stage < last(load);
      if (!together || std::min(a[1], b[1]) <= std::max(a[0], b[0])) continue;
      report(diagnostics, f.place_of("span"), f.path_of("span"),
             fmt::format("presses where {} does, from x = {:.6g} m to {:.6g} m", sections.loads[j].path,
                         std::max(a[0], b[0]), std::min(a[1], b[1])),
             "the ground carries one load at a place: add their pressures and divide their spans");
    }
  }
}

}  // namespace

void check_ground(const Sections& sections, const Model& model, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < model.changes.size(); ++i)
    check_change(model.changes[i], sections.changes[i], model, diagnostics);
  check_loads(sections, model, diagnostics);
  for (std::size_t i = 0; i < model.wells.size(); ++i)
    check_well(model.wells[i], sections.wells[i], model, diagnostics);
  const bool digs = std::any_of(model.changes.begin(), model.changes.end(),
                                [](const GroundChange& c) { return c.kind == ChangeKind::excavate; });
  for (std::size_t i = 0; i < model.monitors.size(); ++i)
    if (digs && model.monitors[i].quantity == "eroded-area")
      report(diagnostics, sections.monitors[i].place_of("quantity"), sections.monitors[i].path_of("quantity"),
             "an eroded area cannot be told from an excavated one", "record soil-volume or soil-surface instead");
}

}  // namespace polder::case_file
