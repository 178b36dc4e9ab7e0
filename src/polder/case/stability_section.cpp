#include "polder/case/stability_section.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace polder::case_file {
namespace {

using namespace stability;

Line line_of(const Fields& f, std::string_view key) {
  Line line;
  if (const auto* field = f.find(key))
    for (const auto& p : field->points) line.push_back({p.front(), p.back()});
  return line;
}

std::optional<Range> range_of(const Fields& f, std::string_view key, Diagnostics& diagnostics) {
  const auto* field = f.find(key);
  if (field == nullptr) return std::nullopt;
  if (field->numbers.size() == 2) return Range{field->numbers[0], field->numbers[1]};
  report(diagnostics, field->place, f.path_of(key), fmt::format("has {} lengths", field->numbers.size()),
         "it is [from, to] along x");
  return std::nullopt;
}

MaterialStrength read_strength(const Fields& f, const Model& model, Diagnostics& diagnostics) {
  MaterialStrength out;
  out.material = material_named(f, model, diagnostics);
  const std::string where = f.text("where");
  out.above = where != "below", out.below = where != "above";
  const std::string model_name = f.text("model");
  Strength& s = out.strength;
  s.model = model_name == "undrained" ? StrengthModel::undrained
            : model_name == "shansep" ? StrengthModel::shansep
                                      : StrengthModel::drained;
  s.cohesion = f.number("cohesion");
  s.friction_angle = f.number("friction_angle");
  if (f.find("dilatancy_angle")) s.dilatancy_angle = f.number("dilatancy_angle");
  s.undrained_strength = f.number("undrained_strength");
  s.strength_gradient = f.number("strength_gradient");
  if (f.find("reference_level")) s.reference_level = f.number("reference_level");
  s.ratio = f.number("ratio");
  s.exponent = f.number("exponent", s.exponent);
  if (f.find("overburden")) out.preconsolidation = Preconsolidation{PreconsolidationKind::pop, f.number("overburden")};
  if (f.find("overconsolidation"))
    out.preconsolidation = Preconsolidation{PreconsolidationKind::ocr, f.number("overconsolidation")};
  if (f.find("unit_weight")) out.unit_weight = f.number("unit_weight");
  if (f.find("saturated_unit_weight")) out.saturated_unit_weight = f.number("saturated_unit_weight");
  out.variation = f.number("variation");
  return out;
}

LineLoad read_line_load(const Fields& f, const Model& model, Diagnostics& diagnostics) {
  LineLoad load;
  load.name = f.text("name");
  const Line at = line_of(f, "at");
  if (at.size() == 1)
    load.at = at.front();
  else if (!at.empty())
    report(diagnostics, f.place_of("at"), f.path_of("at"), fmt::format("has {} points", at.size()),
           "give the one point where the force acts");
  load.force = f.number("force");
  load.angle = f.number("angle");
  load.spread = f.number("spread");
  if (const double degree = f.number("consolidation", 1); degree < 1)
    load.consolidation.assign(model.soils.size(), degree);
  return load;
}

DikeCheckInput read_dike_check(const Fields& f, const Model& model, std::size_t number, Diagnostics& diagnostics) {
  DikeCheckInput out;
  out.name = f.text("name").empty() ? fmt::format("{}", number) : f.text("name");
  need(f, "at", diagnostics), need(f, "aquifer", diagnostics);
  out.at = f.number("at");
  out.aquifer = f.text("aquifer");
  const bool known = std::any_of(model.materials.begin(), model.materials.end(),
                                 [&](const MaterialInput& m) { return m.name == out.aquifer; });
  if (!known && f.is_given("aquifer"))
    report(diagnostics, f.place_of("aquifer"), f.path_of("aquifer"),
           fmt::format("there is no material \"{}\"", out.aquifer), "name one of the [[material]] sections");
  out.critical_gradient = f.number("critical_gradient", 0.3);
  out.d70 = f.number("d70");
  if (out.d70 > 0) need(f, "seepage_length", diagnostics), need(f, "outside_head", diagnostics);
  out.seepage_length = f.number("seepage_length");
  out.outside_head = f.number("outside_head");
  out.thickness = f.number("thickness");
  return out;
}

void read_surfaces(const Fields& f, Input& input, Diagnostics& diagnostics) {
  const auto pair = [&](std::string_view one, std::string_view other) {
    if (f.is_given(one) != f.is_given(other))
      report(diagnostics, f.place_of(f.is_given(one) ? one : other), f.path_of(f.is_given(one) ? other : one),
             "missing", fmt::format("{} and {} go together", one, other));
    return f.find(one) && f.find(other);
  };
  if (pair("circle_centre", "circle_radius"))
    input.circle = Circle{line_of(f, "circle_centre").front(), f.number("circle_radius")};
  if (pair("plane_centres", "plane_level")) {
    const Line centres = line_of(f, "plane_centres");
    if (centres.size() == 2)
      input.plane = UpliftVanPlane{centres[0], centres[1], f.number("plane_level")};
    else
      report(diagnostics, f.place_of("plane_centres"), f.path_of("plane_centres"),
             fmt::format("has {} points", centres.size()), "give the active centre and the passive centre");
  }
  input.surface = line_of(f, "slip_surface");
}

}  // namespace

stability::Input read_stability(const Sections& sections, const Model& model, Diagnostics& diagnostics) {
  const Fields& f = sections.stability;
  Input input;
  for (const Fields& strength : sections.strengths)
    input.strengths.push_back(read_strength(strength, model, diagnostics));
  input.phreatic = line_of(f, "phreatic_line");
  input.daily_phreatic = line_of(f, "daily_phreatic_line");
  const std::string pressures = f.text("pressures");
  input.pressures = pressures == "seepage" ? PressureSource::seepage
                    : pressures == "both"  ? PressureSource::both
                                           : PressureSource::water_net;
  input.fixed_line = line_of(f, "fixed_line");
  input.mesh_file = f.text("mesh");
  input.fem_triangles = f.number("triangles");
  input.max_suction = f.number("suction");
  input.head_deviation = f.number("head_deviation");
  for (const Fields& head : sections.head_lines) {
    need(head, "line", diagnostics);
    const Line above = line_of(head, "head_above");
    const Line below = line_of(head, "head_below");
    input.heads.push_back({line_of(head, "line"), above, below.empty() ? above : below});
  }
  for (const Fields& load : sections.loads) {
    need(load, "span", diagnostics);
    const auto span = range_of(load, "span", diagnostics);
    if (!span) continue;
    StripLoad strip{load.text("name"),
                    (*span)[0],
                    (*span)[1],
                    load.find("pressure") ? load.find("pressure")->table.y.back() : 0,
                    load.number("spread"),
                    {}};
    if (const double degree = load.number("consolidation", 1); degree < 1)
      strip.consolidation.assign(model.soils.size(), degree);
    input.loads.push_back(strip);
  }
  for (const Fields& load : sections.line_loads) input.line_loads.push_back(read_line_load(load, model, diagnostics));
  for (const Fields& check : sections.dike_checks)
    input.dike_checks.push_back(read_dike_check(check, model, input.dike_checks.size() + 1, diagnostics));
  input.earthquake = {f.number("horizontal_quake"), f.number("vertical_quake")};
  input.crack = {f.number("crack_depth"), f.number("crack_water")};
  input.limits.entry = range_of(f, "entry", diagnostics);
  input.limits.exit = range_of(f, "exit", diagnostics);
  if (f.find("minimum_depth")) input.minimum_depth = f.number("minimum_depth");
  input.limits.minimum_length = f.number("minimum_length");
  if (f.find("forbidden_line")) input.limits.forbidden_lines.push_back(line_of(f, "forbidden_line"));
  if (f.find("forbidden_zone")) input.limits.forbidden_zones.push_back(line_of(f, "forbidden_zone"));
  const std::string movement = f.text("movement");
  input.movement = movement == "left" ? Movement::left : movement == "right" ? Movement::right : Movement::automatic;
  read_surfaces(f, input, diagnostics);
  input.partial_factors = {f.number("partial_cohesion", 1), f.number("partial_friction", 1),
                           f.number("partial_undrained", 1), f.number("partial_load", 1), f.number("partial_model", 1)};
  return input;
}

}  // namespace polder::case_file
