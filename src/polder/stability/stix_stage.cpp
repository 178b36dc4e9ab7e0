#include "polder/stability/stix_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "polder/stability/lines.hpp"
#include "polder/stability/reliability.hpp"

namespace polder::stability {
namespace {

constexpr double kilo = 1e3, radian = std::numbers::pi / 180;

std::string text(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

bool flag(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_boolean() && found->get<bool>();
}

const Json& member(const Json& json, const char* key) {
  static const Json nothing;
  const auto found = json.find(key);
  return found != json.end() ? *found : nothing;
}

// A strength and, beside it, its scatter: in design calculations the 5 % value of a lognormal distribution.
double strength_value(const Json& json, const std::string& key, bool design) {
  const Json& scatter = member(json, (key + "StochasticParameter").c_str());
  if (design && flag(scatter, "IsProbabilistic")) {
    const double mean = stix_number(scatter, "Mean"), deviation = stix_number(scatter, "StandardDeviation");
    return mean > 0 && deviation > 0 ? characteristic_value(mean, deviation / mean) : mean;
  }
  return stix_number(json, key.c_str());
}

Strength read_strength(const Json& soil, const std::string& model, bool design, std::vector<std::string>& notes) {
  Strength strength;
  if (model == "MohrCoulombAdvanced" || model == "MohrCoulombClassic") {
    const Json& law = member(soil, (model + "ShearStrengthModel").c_str());
    strength.cohesion = strength_value(law, "Cohesion", design) * kilo;
    strength.friction_angle = strength_value(law, "FrictionAngle", design) * radian;
    if (model == "MohrCoulombAdvanced") strength.dilatancy_angle = strength_value(law, "Dilatancy", design) * radian;
  } else if (model == "Su") {
    const Json& law = member(soil, "SuShearStrengthModel");
    strength.model = StrengthModel::shansep;
    strength.ratio = strength_value(law, "ShearStrengthRatio", design);
    strength.exponent = strength_value(law, "StrengthIncreaseExponent", design);
  } else if (model == "SuTable") {
    strength.model = StrengthModel::table;
    for (const Json& row : member(member(soil, "SuTable"), "SuTablePoints"))
      strength.stress_table.push_back({stix_number(row, "EffectiveStress") * kilo, stix_number(row, "Su") * kilo});
  } else if (model != "None") {
    notes.push_back(
        fmt::format("soil '{}': strength model '{}' is not known; it gets none", text(soil, "Name"), model));
  }
  return strength;
}

Soil read_soil(const Json& json, bool design, std::vector<std::string>& notes) {
  Soil soil;
  soil.name = text(json, "Name");
  soil.unit_weight = stix_number(json, "VolumetricWeightAbovePhreaticLevel") * kilo;
  soil.saturated_unit_weight = stix_number(json, "VolumetricWeightBelowPhreaticLevel") * kilo;
  const bool scattered = design && flag(json, "IsProbabilistic");
  soil.above = read_strength(json, text(json, "ShearStrengthModelTypeAbovePhreaticLevel"), scattered, notes);
  soil.below = read_strength(json, text(json, "ShearStrengthModelTypeBelowPhreaticLevel"), scattered, notes);
  return soil;
}

void read_water(const Json& json, Section& section) {
  section.water.unit_weight = stix_number(json, "UnitWeightWater", 9.81) * kilo;
  std::map<std::string, Line> heads;
  for (const Json& head : member(json, "HeadLines")) heads[text(head, "Id")] = stix_points(member(head, "Points"));
  const std::string phreatic = text(json, "PhreaticLineId");
  if (phreatic.empty()) return;
  section.water.phreatic = heads[phreatic];
  for (const Json& line : member(json, "ReferenceLines")) {
    const std::string above = text(line, "TopHeadLineId"), below = text(line, "BottomHeadLineId");
    if (above.empty() && below.empty()) continue;  // drawn, but without heads: it does nothing
    section.water.references.push_back({stix_points(member(line, "Points")), heads[above.empty() ? below : above],
                                        heads[below.empty() ? above : below]});
  }
}

std::vector<double> degrees(const Json& json, const std::map<std::string, int>& layers) {
  std::vector<double> degrees(layers.size(), 1.0);
  for (const Json& degree : member(json, "Consolidations"))
    if (const auto layer = layers.find(text(degree, "LayerId")); layer != layers.end())
      degrees[static_cast<std::size_t>(layer->second)] = stix_number(degree, "Degree", 100) / 100;
  return degrees;
}

void read_loads(const Json& json, const std::map<std::string, int>& layers, const std::string& where, Section& section,
                std::vector<std::string>& notes) {
  for (const Json& load : member(json, "UniformLoads"))
    section.strip_loads.push_back({text(load, "Label"), stix_number(load, "Start"), stix_number(load, "End"),
                                   stix_number(load, "Magnitude") * kilo, stix_number(load, "Spread") * radian,
                                   degrees(load, layers)});
  for (const Json& load : member(json, "LineLoads"))
    section.line_loads.push_back({text(load, "Label"), stix_point(member(load, "Location")),
                                  stix_number(load, "Magnitude") * kilo, stix_number(load, "Angle") * radian,
                                  stix_number(load, "Spread") * radian, degrees(load, layers)});
  for (const Json& layer : member(json, "LayerLoads"))
    for (const double degree : degrees(layer, layers))
      if (degree < 1) {
        notes.push_back(where + ": consolidation under raised layers is left out (taken as complete)");
        break;
      }
  if (!member(json, "Trees").empty()) notes.push_back(where + ": the wind on trees is left out");
  const Json& quake = member(json, "Earthquake");
  if (flag(quake, "IsEnabled"))
    section.earthquake = {stix_number(quake, "HorizontalFactor"), stix_number(quake, "VerticalFactor")};
}

void read_reinforcements(const Json& json, const std::string& where, Section& section,
                         std::vector<std::string>& notes) {
  for (const Json& line : member(json, "ForbiddenLines"))
    section.limits.forbidden_lines.push_back({stix_point(member(line, "Start")), stix_point(member(line, "End"))});
  if (!member(json, "Geotextiles").empty()) notes.push_back(where + ": geotextiles are left out");
  if (!member(json, "Nails").empty()) notes.push_back(where + ": nails are left out");
}

Preconsolidation read_state(const Json& json, bool design, bool scattered) {
  const std::string type = text(json, "StateType");
  const double yield = stix_number(json, "YieldStress") * kilo;
  const Json& scatter = member(json, "PopStochasticParameter");
  if (type == "Ocr") return {PreconsolidationKind::ocr, stix_number(json, "Ocr", 1)};
  if (type == "YieldStress") return {PreconsolidationKind::yield_stress, yield};
  // A state with scatter whose overburden has none is carried by its yield stress in design calculations.
  if (design && scattered && !flag(scatter, "IsProbabilistic") && yield > 0 && stix_number(json, "Pop") == 0)
    return {PreconsolidationKind::yield_stress, yield};
  return {PreconsolidationKind::pop, strength_value(json, "Pop", design) * kilo};
}

}  // namespace

Point stix_point(const Json& json) { return {stix_number(json, "X"), stix_number(json, "Z")}; }

Line stix_points(const Json& json) {
  Line line;
  for (const Json& point : json) line.push_back(stix_point(point));
  return line;
}

double stix_number(const Json& json, const char* key, double otherwise) {
  if (!json.is_object()) return otherwise;
  const auto found = json.find(key);
  return found != json.end() && found->is_number() ? found->get<double>() : otherwise;
}

const Json& StixFiles::get(const std::string& folder, const std::string& id) const {
  static const Json nothing = Json::object();
  const auto files = by_folder.find(folder);
  if (files == by_folder.end()) return nothing;
  const auto file = files->second.find(id);
  return file == files->second.end() ? nothing : file->second;
}

Section read_stage(const StixFiles& files, const Json& stage, bool design, std::vector<std::string>& notes) {
  Section section;
  section.name = text(stage, "Label");
  const std::string where = fmt::format("stage '{}'", section.name);
  std::map<std::string, int> soils, layers;
  std::map<std::string, std::string> soil_of_layer;
  for (const Json& pair : member(files.get("soillayers", text(stage, "SoilLayersId")), "SoilLayers"))
    soil_of_layer[text(pair, "LayerId")] = text(pair, "SoilId");
  for (const Json& soil : member(files.soils, "Soils")) {
    const std::string id = text(soil, "Id");
    const bool used =
        std::any_of(soil_of_layer.begin(), soil_of_layer.end(), [&](const auto& p) { return p.second == id; });
    if (!used) continue;
    soils[id] = static_cast<int>(section.soils.size());
    section.soils.push_back(read_soil(soil, design, notes));
  }
  for (const Json& layer : member(files.get("geometries", text(stage, "GeometryId")), "Layers")) {
    const std::string id = text(layer, "Id");
    const auto soil = soils.find(soil_of_layer[id]);
    layers[id] = static_cast<int>(section.layers.size());
    section.layers.push_back({fmt::format("{} ({})", text(layer, "Label"), id),
                              stix_points(member(layer, "Points")),
                              soil == soils.end() ? -1 : soil->second,
                              {}});
  }
  if (section.layers.empty()) throw std::invalid_argument(where + ": it has no geometry");
  for (const Json& dug : member(files.get("decorations", text(stage, "DecorationsId")), "Excavations"))
    if (Line line = stix_points(member(dug, "Points")); line.size() >= 2)
      section.excavations.push_back(std::move(line));
  read_water(files.get("waternets", text(stage, "WaternetId")), section);
  read_loads(files.get("loads", text(stage, "LoadsId")), layers, where, section, notes);
  read_reinforcements(files.get("reinforcements", text(stage, "ReinforcementsId")), where, section, notes);
  return section;
}

bool has_states(const StixFiles& files, const Json& stage) {
  const Json& states = files.get("states", text(stage, "StateId"));
  return !member(states, "StatePoints").empty() || !member(states, "StateLines").empty();
}

void read_states(const StixFiles& files, const Json& stage, bool design, Section& section) {
  const Json& states = files.get("states", text(stage, "StateId"));
  for (const Json& point : member(states, "StatePoints")) {
    StatePoint state;
    state.at = stix_point(member(point, "Point"));
    state.value = read_state(member(point, "Stress"), design, flag(point, "IsProbabilistic"));
    for (std::size_t i = 0; i < section.layers.size(); ++i)
      if (inside(section.layers[i].polygon, state.at)) {
        state.layer = static_cast<int>(i);
        section.state_points.push_back(state);
        break;
      }
  }
  for (const Json& line : member(states, "StateLines")) {
    StateLine state{stix_points(member(line, "Points")), {}};
    for (const Json& value : member(line, "Values")) {
      const bool scattered = flag(value, "IsProbabilistic");
      state.values.push_back({stix_number(value, "X"), read_state(member(value, "Above"), design, scattered),
                              read_state(member(value, "Below"), design, scattered)});
    }
    std::sort(state.values.begin(), state.values.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
    section.state_lines.push_back(std::move(state));
  }
}

}  // namespace polder::stability
