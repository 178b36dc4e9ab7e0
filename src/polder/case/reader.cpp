#include "polder/case/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "polder/case/document.hpp"
#include "polder/case/ground_section.hpp"
#include "polder/case/sections.hpp"
#include "polder/case/seepage_section.hpp"
#include "polder/case/stability_section.hpp"

namespace polder {
namespace {

using namespace case_file;

Point2 point2(const std::vector<double>& p) { return {p.front(), p.back()}; }

std::vector<Point2> points2(const Entry* field) {
  std::vector<Point2> points;
  if (field)
    for (const auto& p : field->points) points.push_back(point2(p));
  return points;
}

/// In plane strain the third coordinate is unused.
std::vector<Point3> points3(const Entry* field) {
  std::vector<Point3> points;
  if (field)
    for (const auto& p : field->points) points.push_back({p[0], p[1], p.size() > 2 ? p[2] : 0.0});
  return points;
}

void read_model(const Fields& f, Model& model, Diagnostics& diagnostics) {
  model.title = f.text("title");
  model.space = f.text("space") == "3d" ? SpaceKind::solid : SpaceKind::plane_strain;
  model.gravity = f.number("gravity", model.gravity);
  model.tilt = f.number("tilt", model.tilt);
  model.periodic = f.flag("periodic");
  model.unsaturated = f.text("formulation") == "unsaturated";
  model.single_point = model.unsaturated || f.text("formulation") == "single-point";
  model.points_per_axis = static_cast<int>(f.number("points_per_axis", model.points_per_axis));
  const std::size_t axes = model.space == SpaceKind::solid ? 3 : 2;
  const std::string form = axes == 3 ? "[width, depth, height]" : "[width, height]";
  if (const Entry* size = f.find("size")) {
    if (size->numbers.size() == axes)
      std::copy(size->numbers.begin(), size->numbers.end(), model.size.begin());
    else
      report(diagnostics, size->place, f.path_of("size"), fmt::format("has {} lengths", size->numbers.size()),
             fmt::format("in this space it is {}", form));
  }
  if (const Entry* cell = f.find("cell")) {
    if (cell->numbers.size() == 1)
      std::fill_n(model.cell.begin(), axes, cell->numbers.front());
    else if (cell->numbers.size() == axes)
      std::copy(cell->numbers.begin(), cell->numbers.end(), model.cell.begin());
    else
      report(diagnostics, cell->place, f.path_of("cell"), fmt::format("has {} lengths", cell->numbers.size()),
             fmt::format("give one spacing for all axes, or {}", form));
  }
}

void read_water(const Fields& f, WaterProperties& water) {
  water.density = f.number("density", water.density);
  water.bulk_modulus = f.number("bulk_modulus", water.bulk_modulus);
  water.viscosity = f.number("viscosity", water.viscosity);
  water.cavitation_pressure = f.number("cavitation_pressure", water.cavitation_pressure);
  water.viscous = f.flag("viscous");
}

MaterialInput read_material(const Fields& f, const LawDescription* law, const Model& model, Diagnostics& diagnostics) {
  MaterialInput material;
  material.name = f.text("name");
  material.law = f.text("law");
  if (law)
    for (const Parameter& p : law->parameters) material.law_parameters.push_back(f.number(p.key, p.standard));
  material.max_porosity = f.number("max_porosity", material.max_porosity);
  material.ergun_a = f.number("ergun_a", material.ergun_a);
  material.ergun_b = f.number("ergun_b", material.ergun_b);
  if (const Entry* exponent = f.find("permeability_exponent")) material.permeability_exponent = exponent->number;
  if (const Entry* change = f.find("permeability_change")) {
    material.permeability_change = change->number;
    if (material.permeability_exponent)
      report(diagnostics, f.place_of("permeability_change"), f.path_of("permeability_change"),
             "goes against permeability_exponent", "keep one of them");
  }
  material.fixed = f.flag("fixed");
  static constexpr DragLaw drags[] = {DragLaw::ergun, DragLaw::darcy, DragLaw::beetstra, DragLaw::gidaspow};
  if (const Entry* drag = f.find("drag")) material.drag = drags[static_cast<std::size_t>(drag->number)];
  settle_phases(f, model.water, material, diagnostics);
  settle_permeability(f, model.water, model.gravity, material, diagnostics);
  return material;
}

/// A polygon or a box, and across what.
Region read_region(const Fields& f, const Model& model, Diagnostics& diagnostics) {
  Region region;
  if (f.is_given("polygon") == f.is_given("box")) {
    const bool both = f.is_given("polygon");
    report(diagnostics, both ? f.place_of("box") : f.place, f.path, both ? "has a polygon and a box" : "has no shape",
           both ? "keep one of them" : "give a polygon, or a box = [[\"0 m\", \"0 m\"], [\"1 m\", \"1 m\"]]");
  }
  region.polygon = points2(f.find("polygon"));
  if (const Entry* box = f.find("box")) {
    const Point2 a = point2(box->points[0]), b = point2(box->points[1]);
    const double x0 = std::min(a[0], b[0]), x1 = std::max(a[0], b[0]), y0 = std::min(a[1], b[1]),
                 y1 = std::max(a[1], b[1]);
    region.polygon = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
    if (box->points[0].size() == 3) {
      const auto [from, to] = std::minmax(box->points[0][1], box->points[1][1]);
      region.across = {from, to};
    }
  }
  if (const Entry* across = f.find("across")) {
    if (across->numbers.size() != 2)
      report(diagnostics, across->place, f.path_of("across"), fmt::format("has {} lengths", across->numbers.size()),
             "it is [from, to] along y");
    else
      region.across = {std::min(across->numbers[0], across->numbers[1]),
                       std::max(across->numbers[0], across->numbers[1])};
  }
  if (model.space == SpaceKind::plane_strain &&
      (f.is_given("across") || (f.find("box") && f.find("box")->points[0].size() == 3)))
    report(diagnostics, f.is_given("across") ? f.place_of("across") : f.place_of("box"), f.path,
           "has an extent across the section, which plane strain does not know",
           "set model.space = \"3d\", or leave it out");
  return region;
}

SoilBody read_soil(const Fields& f, const Model& model, Diagnostics& diagnostics) {
  SoilBody soil;
  soil.name = f.text("name");
  soil.region = read_region(f, model, diagnostics);
  const Entry* material = f.find("material");
  if (!material) return soil;
  const auto known = std::find_if(model.materials.begin(), model.materials.end(),
                                  [&](const MaterialInput& m) { return m.name == material->text; });
  if (known != model.materials.end()) {
    soil.material = static_cast<int>(known - model.materials.begin());
    return soil;
  }
  std::vector<std::string> names;
  for (const MaterialInput& m : model.materials) names.push_back(m.name);
  report(diagnostics, material->place, f.path_of("material"),
         fmt::format("there is no material \"{}\"", material->text),
         names.empty() ? "add a [[material]] of that name" : suggestion(material->text, names));
  return soil;
}

Boundary read_boundary(const Fields& f, Diagnostics& diagnostics) {
  static constexpr Side sides[] = {Side::left, Side::right, Side::base, Side::top, Side::front, Side::back};
  static constexpr SoilCondition soils[] = {SoilCondition::none, SoilCondition::roller, SoilCondition::rough,
                                            SoilCondition::absorbing};
  static constexpr WaterCondition waters[] = {WaterCondition::closed, WaterCondition::open,   WaterCondition::reservoir,
                                              WaterCondition::head,   WaterCondition::inflow, WaterCondition::no_slip};
  Boundary boundary;
  boundary.name = f.text("name").empty() ? f.text("side") : f.text("name");
  if (const Entry* side = f.find("side")) boundary.side = sides[static_cast<std::size_t>(side->number)];
  if (const Entry* soil = f.find("soil")) boundary.soil = soils[static_cast<std::size_t>(soil->number)];
  if (const Entry* water = f.find("water")) boundary.water = waters[static_cast<std::size_t>(water->number)];
  boundary.line = points2(f.find("line"));
  boundary.region.polygon = points2(f.find("region"));
  if (const Entry* head = f.find("head")) boundary.head = head->table;
  if (const Entry* inflow = f.find("inflow")) boundary.inflow = inflow->table;
  if (const Entry* slide = f.find("slide")) boundary.slide = slide->table;
  if (const Entry* push = f.find("push")) boundary.push = push->table;
  const Entry* span = f.find("span");
  if (span && span->numbers.size() == 2 && span->numbers[0] < span->numbers[1])
    boundary.span = {span->numbers[0], span->numbers[1]};
  else if (span)
    report(diagnostics, span->place, f.path_of("span"), "is not [from, to] with from < to",
           "give the two ends of the opening along the side");
  // A reservoir is only about water.
  if (boundary.water == WaterCondition::reservoir && !f.is_given("soil")) boundary.soil = SoilCondition::none;
  return boundary;
}

/// After the stages.
WallInput read_wall(const Fields& f, const Model& model, Diagnostics& diagnostics) {
  WallInput wall;
  wall.name = f.text("name");
  wall.line = points2(f.find("line"));
  wall.friction_angle = f.number("friction_angle");
  wall.polygon = points2(f.find("polygon"));
  if (f.is_given("line") + f.is_given("polygon") + f.is_given("box") != 1)
    report(
        diagnostics, f.place, f.path,
        f.is_given("line") || f.is_given("polygon") || f.is_given("box") ? "has more than one shape" : "has no shape",
        "give a line (a thin wall), or a polygon or a box (a body)");
  if (const Entry* box = f.find("box")) {
    const Point2 a = point2(box->points[0]), b = point2(box->points[1]);
    wall.polygon = {a, {b[0], a[1]}, b, {a[0], b[1]}};
  }
  wall.rough = f.text("soil") == "rough";
  static constexpr const char* along[] = {"x", "upward"};
  for (std::size_t k = 0; k < 2; ++k) {
    if (const Entry* v = f.find(std::string("velocity_") + along[k])) wall.velocity[k] = v->table;
    if (const Entry* d = f.find(std::string("displacement_") + along[k])) wall.displacement[k] = d->table;
  }
  wall.until = f.number("until", wall.until);
  wall.from_stage = stage_named(f, "from_stage", model, diagnostics);
  wall.until_stage = stage_named(f, "until_stage", model, diagnostics);
  return wall;
}

Stage read_stage(const Fields& f) {
  Stage stage;
  stage.name = f.text("name");
  stage.duration = f.number("duration");
  stage.initial = f.flag("initial");
  stage.ramp = f.number("ramp");
  stage.damping = f.number("damping");
  stage.local_damping = f.number("local_damping");
  stage.water_damping = f.number("water_damping");
  stage.hold_water = f.flag("hold_water");
  stage.until_rest = f.flag("until_rest");
  stage.rest_energy = f.number("rest_energy", stage.rest_energy);
  stage.rest_force = f.number("rest_force", stage.rest_force);
  const auto own = [&](std::string_view key) {
    const Entry* entry = f.find(key);
    return entry ? std::optional(entry->number) : std::nullopt;
  };
  stage.history_interval = own("history");
  stage.snapshot_interval = own("snapshots");
  stage.mass_scaling = own("mass_scaling");
  stage.step_stretch = own("step_stretch");
  return stage;
}

/// After the walls.
Monitor read_monitor(const Fields& f, const Model& model, Diagnostics& diagnostics) {
  static constexpr MonitorKind kinds[] = {MonitorKind::point, MonitorKind::section, MonitorKind::surface,
                                          MonitorKind::integral, MonitorKind::wall};
  Monitor monitor;
  monitor.name = f.text("name");
  if (const Entry* kind = f.find("kind")) monitor.kind = kinds[static_cast<std::size_t>(kind->number)];
  monitor.quantity = f.text("quantity");
  monitor.at = points3(f.find("at"));
  monitor.region.polygon = points2(f.find("region"));
  monitor.follows_soil = f.flag("follows_soil");
  if (const Entry* wall = f.find("wall")) {
    std::vector<std::string> names;
    for (std::size_t w = 0; w < model.walls.size(); ++w) {
      if (model.walls[w].name == wall->text && !wall->text.empty()) monitor.wall = static_cast<int>(w);
      if (!model.walls[w].name.empty()) names.push_back(model.walls[w].name);
    }
    if (monitor.wall < 0)
      report(diagnostics, wall->place, f.path_of("wall"), fmt::format("there is no wall \"{}\"", wall->text),
             names.empty() ? "give the [[wall]] a name" : suggestion(wall->text, names));
  }
  return monitor;
}

void read_initial(const Fields& f, Model& model) {
  static constexpr InitialStress states[] = {InitialStress::k0, InitialStress::k0_slope, InitialStress::gravity,
                                             InitialStress::none};
  model.water_table = points2(f.find("water_table"));
  if (const Entry* stress = f.find("stress")) model.initial_stress = states[static_cast<std::size_t>(stress->number)];
  model.initial_seepage = f.flag("seepage");
  model.suction_limit = f.number("suction_limit", model.suction_limit);
  if (const Entry* k0 = f.find("k0")) model.k0 = k0->number;
}

void read_output(const Fields& f, Output& output) {
  output.history_interval = f.number("history", output.history_interval);
  output.snapshot_interval = f.number("snapshots", output.snapshot_interval);
  output.checkpoint_interval = f.number("checkpoint", output.checkpoint_interval);
  if (const Entry* pictures = f.find("pictures")) output.pictures = pictures->numbers;
  std::sort(output.pictures.begin(), output.pictures.end());
}

void read_numerics(const Fields& f, Numerics& numerics) {
  numerics.cfl = f.number("cfl", numerics.cfl);
  numerics.pressure_tolerance = f.number("pressure_tolerance", numerics.pressure_tolerance);
  if (const Entry* transfer = f.find("transfer")) numerics.transfer = static_cast<Transfer>(transfer->number);
  numerics.fbar = f.number("fbar", numerics.fbar);
  numerics.wet_threshold = f.number("wet_threshold", numerics.wet_threshold);
  numerics.volume_correction = f.number("volume_correction", numerics.volume_correction);
  numerics.pressure_weight = f.number("pressure_weight", numerics.pressure_weight);
  numerics.split_water = f.flag("split_water");
  numerics.max_step = f.number("max_step", numerics.max_step);
  numerics.mass_scaling = f.number("mass_scaling", numerics.mass_scaling);
  numerics.step_stretch = f.number("step_stretch", numerics.step_stretch);
  numerics.jitter = f.number("jitter", numerics.jitter);
  numerics.seed = static_cast<unsigned long long>(f.number("seed", static_cast<double>(numerics.seed)));
}

/// A side without an entry is a smooth, impermeable wall.
void add_remaining_sides(Model& model) {
  static constexpr std::pair<Side, const char*> sides[] = {{Side::left, "left"},   {Side::right, "right"},
                                                           {Side::base, "base"},   {Side::top, "top"},
                                                           {Side::front, "front"}, {Side::back, "back"}};
  for (const auto& [side, name] : sides) {
    if (model.space == SpaceKind::plane_strain && (side == Side::front || side == Side::back)) continue;
    if (std::none_of(model.boundaries.begin(), model.boundaries.end(),
                     [wanted = side](const Boundary& b) { return b.side == wanted; })) {
      Boundary wall;
      wall.name = name;
      wall.side = side;
      wall.soil = SoilCondition::roller;
      model.boundaries.push_back(std::move(wall));
    }
  }
}

std::string name_of_case(const std::string& path) {
  const std::filesystem::path file = std::filesystem::absolute(path);
  return file.stem() == "case" ? file.parent_path().filename().string() : file.stem().string();
}

}  // namespace

ReadResult read_case(const std::string& path, const std::vector<std::string>& overrides) {
  ReadResult result;
  Model& model = result.model;
  Diagnostics& diagnostics = result.diagnostics;
  model.file = path;
  model.name = name_of_case(path);
  const Value document = load_document(path, overrides, diagnostics);
  if (has_errors(diagnostics) && document.members.empty()) return result;  // nothing to check
  const Sections sections = read_sections(document, diagnostics);
  read_model(sections.model, model, diagnostics);
  read_water(sections.water, model.water);
  for (std::size_t i = 0; i < sections.materials.size(); ++i)
    model.materials.push_back(read_material(sections.materials[i], sections.laws[i], model, diagnostics));
  for (const Fields& f : sections.soils) model.soils.push_back(read_soil(f, model, diagnostics));
  for (const Fields& f : sections.free_water)
    model.free_water.push_back({read_region(f, model, diagnostics), f.text("name")});
  for (const Fields& f : sections.boundaries) model.boundaries.push_back(read_boundary(f, diagnostics));
  for (const Fields& f : sections.stages) model.stages.push_back(read_stage(f));
  for (const Fields& f : sections.walls) model.walls.push_back(read_wall(f, model, diagnostics));
  for (const Fields& f : sections.monitors) model.monitors.push_back(read_monitor(f, model, diagnostics));
  for (const Fields& f : sections.loads) model.loads.push_back(read_load(f, model, diagnostics));
  for (const Fields& f : sections.wells) model.wells.push_back(read_well(f, model, diagnostics));
  for (const Fields& f : sections.rains) model.rains.push_back(read_rain(f, diagnostics));
  for (const Fields& f : sections.changes) {
    model.changes.push_back(read_change(f, model, diagnostics));
    model.changes.back().region = read_region(f, model, diagnostics);
  }
  read_initial(sections.initial, model);
  read_output(sections.output, model.output);
  read_numerics(sections.numerics, model.numerics);
  model.numerics.step_material = known_material(sections.numerics, "step_material", model, diagnostics);
  result.seepage = read_seepage(sections, model, diagnostics);
  if (model.unsaturated) {
    model.retentions = result.seepage.retentions;
    model.pore_water = result.seepage.conditions;
  }
  result.stability = read_stability(sections, model, diagnostics);
  check_model(sections, model, diagnostics);
  check_limits(sections, model, diagnostics);
  add_remaining_sides(model);
  sort_by_place(diagnostics);
  return result;
}

}  // namespace polder
