#include "polder/stability/section_from_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "polder/material/law.hpp"
#include "polder/stability/columns.hpp"
#include "polder/stability/lines.hpp"

namespace polder::stability {

std::optional<double> law_parameter(const MaterialInput& material, std::string_view key) {
  const LawDescription* law = find_soil_law(material.law);
  if (law == nullptr) return std::nullopt;
  for (std::size_t i = 0; i < law->parameters.size() && i < material.law_parameters.size(); ++i)
    if (law->parameters[i].key == key) return material.law_parameters[i];
  return std::nullopt;
}

namespace {

// The strength of the material's own law; false where the law has none.
bool strength_of_law(const MaterialInput& material, Strength& strength) {
  if (const auto undrained = law_parameter(material, "undrained_shear_strength")) {
    strength.model = StrengthModel::undrained;
    strength.undrained_strength = *undrained;
    return true;
  }
  const auto friction = law_parameter(material, "friction_angle");
  if (!friction) return false;
  strength.friction_angle = *friction;
  strength.cohesion = law_parameter(material, "cohesion").value_or(0);
  return true;
}

Soil make_soil(const MaterialInput& material, const Model& model, const Input& input,
               std::optional<Preconsolidation>& state, std::vector<std::string>& problems) {
  Soil soil;
  soil.name = material.name;
  soil.unit_weight = (1 - material.porosity) * material.grain_density * model.gravity;
  soil.saturated_unit_weight = soil.unit_weight + material.porosity * model.water.density * model.gravity;
  bool above = strength_of_law(material, soil.above);
  soil.below = soil.above;
  bool below = above;
  for (const MaterialStrength& given : input.strengths) {
    if (given.material != material.name) continue;
    if (given.above) soil.above = given.strength, above = true;
    if (given.below) soil.below = given.strength, below = true;
    if (std::isfinite(given.unit_weight)) soil.unit_weight = given.unit_weight;
    if (std::isfinite(given.saturated_unit_weight)) soil.saturated_unit_weight = given.saturated_unit_weight;
    if (given.preconsolidation) state = given.preconsolidation;
  }
  if (!above || !below)
    problems.push_back(fmt::format("material '{}': its law \"{}\" has no strength; add a [[strength]] for it",
                                   material.name, material.law));
  return soil;
}

// Water above the ground must be drawn as free water, or the simulation and the factor of safety would differ.
void check_water(const Model& model, const PreparedSection& prepared, std::vector<std::string>& problems) {
  const Section& section = prepared.section;
  if (section.water.phreatic.empty()) return;
  double worst = 0, where = 0;
  for (const double x : prepared.breaks) {
    if (x < prepared.left() || x > prepared.right()) continue;
    const double ground = ground_level(prepared, x), depth = level(section.water.phreatic, x) - ground;
    const auto holds = [&](const Region& region) { return inside(region.polygon, {x, ground + depth / 2}); };
    const bool drawn = std::any_of(model.free_water.begin(), model.free_water.end(),
                                   [&](const FreeWaterBody& body) { return holds(body.region); }) ||
                       std::any_of(model.boundaries.begin(), model.boundaries.end(),
                                   [&](const Boundary& boundary) { return holds(boundary.region); });
    // A kink at the foot of a bank may lie on the edge of the water: look at what is clearly under it.
    if (depth > worst && depth > 0.01 && !drawn) worst = depth, where = x;
  }
  if (worst > 0)
    problems.push_back(
        fmt::format("the water table is {:.2f} m above the ground at x = {:g} m, where the case has no free "
                    "water; lower it there, or draw a [[free_water]]",
                    worst, where));
}

// Height between the lowest and the highest ground, m.
double relief(const PreparedSection& prepared) {
  double low = 1e300, high = -1e300;
  for (const Column& column : prepared.columns)
    for (const double z : column.pieces.front().top) low = std::min(low, z), high = std::max(high, z);
  return high - low;
}

[[noreturn]] void refuse(const std::vector<std::string>& problems) {
  std::string message = "this case has no factor of safety:";
  for (const std::string& problem : problems) message += "\n  " + problem;
  throw std::invalid_argument(message);
}

}  // namespace

Section section_from_model(const Model& model, const Input& input) {
  std::vector<std::string> problems;
  if (model.space != SpaceKind::plane_strain)
    problems.push_back("it is in 3d; the methods here are for a vertical section (model.space = \"plane-strain\")");
  if (model.soils.empty()) problems.push_back("there is no soil; add a [[soil]]");
  if (model.tilt != 0) problems.push_back("its gravity leans (model.tilt); draw the slope as it stands");
  if (!problems.empty()) refuse(problems);

  Section section;
  section.name = model.name;
  std::vector<std::optional<Preconsolidation>> states(model.materials.size());
  for (std::size_t i = 0; i < model.materials.size(); ++i)
    section.soils.push_back(make_soil(model.materials[i], model, input, states[i], problems));
  for (const SoilBody& body : model.soils) {
    Layer layer{body.name, body.region.polygon, body.material, {}};
    layer.preconsolidation = states[static_cast<std::size_t>(body.material)].value_or(Preconsolidation{});
    section.layers.push_back(layer);
  }
  section.water.unit_weight = model.water.density * model.gravity;
  section.water.phreatic = input.phreatic.empty() ? model.water_table : input.phreatic;
  section.water.references = input.heads;
  section.water.max_suction = input.max_suction;
  section.strip_loads = input.loads;
  section.line_loads = input.line_loads;
  section.earthquake = input.earthquake;
  section.crack = input.crack;
  section.limits = input.limits;
  section.movement = input.movement;
  if (!problems.empty()) refuse(problems);
  const PreparedSection prepared = prepare(section);
  if (input.phreatic.empty()) check_water(model, prepared, problems);
  if (!problems.empty()) refuse(problems);
  // Cohesionless faces, above all those through which water seeps, fail in ever thinner skins: they are no dike
  // failure.
  constexpr double skin = 0.1;
  section.limits.minimum_depth = input.minimum_depth.value_or(skin * relief(prepared));
  if (!input.daily_phreatic.empty()) {
    Section daily = section;
    daily.water.phreatic = input.daily_phreatic;
    daily.water.references.clear();
    daily.strip_loads.clear();
    daily.line_loads.clear();
    section.before.push_back(std::move(daily));
  }
  return section;
}

}  // namespace polder::stability
