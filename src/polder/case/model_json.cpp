#include "polder/case/model_json.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "polder/case/schema.hpp"

namespace polder {
namespace {

using namespace case_file;

using Json = nlohmann::ordered_json;

/// The word of a "choice:…" key.
std::string word(std::string_view section, std::string_view key, int index) {
  return choices_of(find_key(section, key)->quantity).at(static_cast<std::size_t>(index));
}

/// JSON knows no infinity.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json region_json(const Region& region) {
  Json json{{"polygon", region.polygon}};
  if (std::isfinite(region.across[0])) json["across"] = region.across;
  return json;
}

Json with_name(Json json, const std::string& name) {
  if (!name.empty()) json["name"] = name;
  return json;
}

Json material_json(const MaterialInput& m) {
  Json json{{"name", m.name},
            {"law", m.law},
            {"grain_density", m.grain_density},
            {"porosity", m.porosity},
            {"max_porosity", m.max_porosity},
            {"drag", word("material", "drag", static_cast<int>(m.drag))},
            {"ergun_a", m.ergun_a},
            {"ergun_b", m.ergun_b},
            {"fixed", m.fixed}};
  if (m.permeability_exponent) json["permeability_exponent"] = *m.permeability_exponent;
  if (m.permeability_change) json["permeability_change"] = *m.permeability_change;
  if (m.grain_diameter > 0) json["grain_diameter"] = m.grain_diameter;
  if (m.permeability) {
    json["horizontal_permeability"] = (*m.permeability)[0];
    json["vertical_permeability"] = (*m.permeability)[1];
  }
  const LawDescription* law = find_soil_law(m.law);
  for (std::size_t i = 0; law && i < m.law_parameters.size(); ++i) {
    const Parameter& parameter = law->parameters[i];
    const auto words = choices_of(parameter.quantity);
    json[std::string(parameter.key)] =
        words.empty() ? number(m.law_parameters[i]) : Json(words.at(static_cast<std::size_t>(m.law_parameters[i])));
  }
  return json;
}

void add_table(Json& json, const char* key, const Table& table) {
  for (std::size_t i = 0; i < table.x.size(); ++i) json[key].push_back({table.x[i], table.y[i]});
}

/// The stage that an index names, where it names one.
void add_stage(Json& json, const char* key, int stage, const Model& model) {
  if (stage >= 0) json[key] = model.stages.at(static_cast<std::size_t>(stage)).name;
}

Json load_json(const GroundLoad& load, const Model& model) {
  Json json{{"name", load.name}, {"span", load.span}};
  add_table(json, "pressure", load.pressure);
  if (load.pressure_at_end) add_table(json, "pressure_at_end", *load.pressure_at_end);
  if (load.speed != 0) json["speed"] = load.speed;
  add_stage(json, "from_stage", load.from_stage, model);
  add_stage(json, "until_stage", load.until_stage, model);
  return json;
}

Json change_json(const GroundChange& change, const Model& model) {
  Json json = with_name(Json::object(), change.name);
  add_stage(json, "stage", change.stage, model);
  json["action"] = word("change", "action", static_cast<int>(change.kind));
  if (change.material >= 0) json["material"] = model.materials.at(static_cast<std::size_t>(change.material)).name;
  json.update(region_json(change.region));
  if (change.kind == ChangeKind::excavate) json["water"] = word("change", "water", static_cast<int>(change.water));
  return json;
}

Json boundary_json(const Boundary& b) {
  Json json{{"name", b.name}};
  if (b.side) json["side"] = word("boundary", "side", static_cast<int>(*b.side));
  if (!b.line.empty()) json["line"] = b.line;
  json["soil"] = word("boundary", "soil", static_cast<int>(b.soil));
  json["water"] = word("boundary", "water", static_cast<int>(b.water));
  if (!b.region.polygon.empty()) json["region"] = b.region.polygon;
  add_table(json, "head", b.head);
  add_table(json, "inflow", b.inflow);
  add_table(json, "slide", b.slide);
  add_table(json, "push", b.push);
  if (b.span) json["span"] = *b.span;
  return json;
}

Json wall_json(const WallInput& w, const Model& model) {
  Json json = Json::object();
  if (!w.name.empty()) json["name"] = w.name;
  if (!w.line.empty()) json["line"] = w.line;
  if (!w.polygon.empty()) json["polygon"] = w.polygon;
  if (w.friction_angle > 0) json["friction_angle"] = w.friction_angle;
  json["soil"] = w.rough ? "rough" : "smooth";
  static constexpr const char* along[] = {"x", "upward"};
  for (std::size_t k = 0; k < 2; ++k) {
    add_table(json, (std::string("velocity_") + along[k]).c_str(), w.velocity[k]);
    add_table(json, (std::string("displacement_") + along[k]).c_str(), w.displacement[k]);
  }
  if (std::isfinite(w.until)) json["until"] = w.until;
  add_stage(json, "from_stage", w.from_stage, model);
  add_stage(json, "until_stage", w.until_stage, model);
  return json;
}

Json stage_json(const Stage& s) {
  Json json{{"name", s.name},
            {"duration", s.duration},
            {"initial", s.initial},
            {"ramp", s.ramp},
            {"damping", s.damping},
            {"water_damping", s.water_damping},
            {"local_damping", s.local_damping},
            {"hold_water", s.hold_water},
            {"until_rest", s.until_rest}};
  if (s.until_rest) json.update({{"rest_energy", s.rest_energy}, {"rest_force", s.rest_force}});
  if (s.history_interval) json["history"] = *s.history_interval;
  if (s.snapshot_interval) json["snapshots"] = *s.snapshot_interval;
  if (s.mass_scaling) json["mass_scaling"] = *s.mass_scaling;
  if (s.step_stretch) json["step_stretch"] = *s.step_stretch;
  return json;
}

Json well_json(const Well& w, const Model& model) {
  Json json{{"name", w.name}, {"at", w.at}};
  if (w.discharge) add_table(json, "discharge", *w.discharge);
  if (w.head) {
    add_table(json, "head", *w.head);
    json["radius"] = w.radius;
    json["only_takes"] = w.only_takes;
  }
  add_stage(json, "from_stage", w.from_stage, model);
  add_stage(json, "until_stage", w.until_stage, model);
  return json;
}

Json rain_json(const Rain& r) {
  Json json{{"name", r.name}};
  add_table(json, "rate", r.rate);
  if (r.span) json["span"] = *r.span;
  return json;
}

/// How a soil holds water and conducts it, in SI units.
Json retention_json(const MaterialRetention& r) {
  constexpr std::array models{"linear", "van-genuchten", "gardner", "table"};
  constexpr std::array curves{"constant", "mualem", "hillel", "gardner", "table"};
  Json json{{"material", r.material}, {"model", models.at(r.retention.index())}};
  if (const auto* v = std::get_if<LinearRetention>(&r.retention))
    json.update({{"slope", v->slope}, {"residual", v->residual}});
  if (const auto* v = std::get_if<VanGenuchtenRetention>(&r.retention))
    json.update({{"entry_pressure", v->entry_pressure},
                 {"lambda", v->lambda},
                 {"residual", v->residual},
                 {"maximum", v->maximum}});
  if (const auto* v = std::get_if<GardnerRetention>(&r.retention))
    json.update({{"rate", v->rate}, {"residual", v->residual}, {"maximum", v->maximum}});
  if (const auto* v = std::get_if<TableRetention>(&r.retention)) add_table(json, "saturation", v->saturation);
  json["conductivity"] = curves.at(r.curve.index());
  if (const auto* v = std::get_if<MualemConductivity>(&r.curve))
    json.update({{"mualem_exponent", v->exponent}, {"mualem_lambda", v->lambda}});
  if (const auto* v = std::get_if<HillelConductivity>(&r.curve)) json["hillel_exponent"] = v->exponent;
  if (const auto* v = std::get_if<GardnerConductivity>(&r.curve)) json["conductivity_rate"] = v->rate;
  if (const auto* v = std::get_if<TableConductivity>(&r.curve)) add_table(json, "relative_conductivity", v->relative);
  return json;
}

Json condition_json(const SeepageCondition& c) {
  Json json{{"name", c.name},
            {"condition", word("seepage_boundary", "condition", static_cast<int>(c.kind))},
            {"line", c.line}};
  if (c.kind == SeepageCondition::Kind::head) add_table(json, "head", c.head);
  if (c.head_at_end) add_table(json, "head_at_end", *c.head_at_end);
  if (c.kind == SeepageCondition::Kind::rain) add_table(json, "rate", c.rate);
  return json;
}

Json monitor_json(const Monitor& m, const Model& model) {
  Json json{{"name", m.name}, {"kind", word("monitor", "kind", static_cast<int>(m.kind))}, {"quantity", m.quantity}};
  if (!m.at.empty()) json["at"] = m.at;
  if (!m.region.polygon.empty()) json["region"] = m.region.polygon;
  if (m.wall >= 0) json["wall"] = model.walls[static_cast<std::size_t>(m.wall)].name;
  json["follows_soil"] = m.follows_soil;
  return json;
}

}  // namespace

Json case_json(const Model& model) {
  const std::ptrdiff_t axes = model.space == SpaceKind::solid ? 3 : 2;
  const auto per_axis = [&](const std::array<double, 3>& v) {
    return std::vector<double>(v.begin(), v.begin() + axes);
  };
  Json json{{"name", model.name}, {"file", model.file}};
  json["model"] = {{"title", model.title},
                   {"space", word("model", "space", static_cast<int>(model.space))},
                   {"size", per_axis(model.size)},
                   {"cell", per_axis(model.cell)},
                   {"gravity", model.gravity},
                   {"tilt", model.tilt},
                   {"periodic", model.periodic},
                   {"points_per_axis", model.points_per_axis},
                   {"formulation", model.unsaturated    ? "unsaturated"
                                   : model.single_point ? "single-point"
                                                        : "double-point"}};
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(axes); ++axis)
    for (const FineRange& r : model.finer[axis])
      json["refine"].push_back({{"along", axis == 0                                       ? "x"
                                          : static_cast<std::ptrdiff_t>(axis) + 1 == axes ? "height"
                                                                                          : "y"},
                                {"span", {r.from, r.to}},
                                {"cell", r.cell},
                                {"growth", r.growth}});
  json["water"] = {{"density", model.water.density},
                   {"bulk_modulus", model.water.bulk_modulus},
                   {"viscosity", model.water.viscosity},
                   {"cavitation_pressure", model.water.cavitation_pressure},
                   {"viscous", model.water.viscous}};
  json["material"] = Json::array();
  for (const MaterialInput& m : model.materials) json["material"].push_back(material_json(m));
  json["soil"] = Json::array();
  for (const SoilBody& s : model.soils) {
    Json soil{{"material", model.materials.at(static_cast<std::size_t>(s.material)).name}};
    soil.update(region_json(s.region));
    json["soil"].push_back(with_name(soil, s.name));
  }
  json["free_water"] = Json::array();
  for (const FreeWaterBody& w : model.free_water)
    json["free_water"].push_back(with_name(region_json(w.region), w.name));
  json["initial"] = {{"water_table", model.water_table},
                     {"seepage", model.initial_seepage},
                     {"stress", word("initial", "stress", static_cast<int>(model.initial_stress))}};
  if (model.unsaturated) {
    json["initial"]["suction_limit"] = number(model.suction_limit);
    json["retention"] = Json::array();
    for (const MaterialRetention& r : model.retentions) json["retention"].push_back(retention_json(r));
    json["seepage_boundary"] = Json::array();
    for (const SeepageCondition& c : model.pore_water) json["seepage_boundary"].push_back(condition_json(c));
  }
  if (model.k0) json["initial"]["k0"] = *model.k0;
  json["boundary"] = Json::array();
  for (const Boundary& b : model.boundaries) json["boundary"].push_back(boundary_json(b));
  for (const WallInput& w : model.walls) json["wall"].push_back(wall_json(w, model));
  json["load"] = Json::array();
  for (const GroundLoad& load : model.loads) json["load"].push_back(load_json(load, model));
  for (const Well& well : model.wells) json["well"].push_back(well_json(well, model));
  for (const Rain& rain : model.rains) json["rain"].push_back(rain_json(rain));
  for (const GroundChange& change : model.changes) json["change"].push_back(change_json(change, model));
  json["stage"] = Json::array();
  for (const Stage& s : model.stages) json["stage"].push_back(stage_json(s));
  json["monitor"] = Json::array();
  for (const Monitor& m : model.monitors) json["monitor"].push_back(monitor_json(m, model));
  json["output"] = {{"history", model.output.history_interval},
                    {"snapshots", model.output.snapshot_interval},
                    {"pictures", model.output.pictures},
                    {"checkpoint", model.output.checkpoint_interval}};
  const Numerics& n = model.numerics;
  json["numerics"] = {{"cfl", n.cfl},
                      {"pressure_tolerance", n.pressure_tolerance},
                      {"transfer", word("numerics", "transfer", static_cast<int>(n.transfer))},
                      {"fbar", n.fbar},
                      {"wet_threshold", n.wet_threshold},
                      {"volume_correction", n.volume_correction},
                      {"pressure_weight", n.pressure_weight},
                      {"split_water", n.split_water},
                      {"max_step", number(n.max_step)},
                      {"jitter", n.jitter},
                      {"seed", n.seed}};
  if (model.unsaturated) {
    json["numerics"]["mass_scaling"] = n.mass_scaling;
    json["numerics"]["step_stretch"] = n.step_stretch;
    if (!n.step_material.empty()) json["numerics"]["step_material"] = n.step_material;
  }
  return json;
}

}  // namespace polder
