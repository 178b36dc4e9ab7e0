// What may be written in a case file but cannot be computed by this version. A feature that arrives deletes its lines.
#include <fmt/format.h>

#include <algorithm>

#include "polder/case/geometry.hpp"
#include "polder/case/sections.hpp"
#include "polder/case/wall_motion.hpp"

namespace polder::case_file {
namespace {

/// Soil on both sides of a line inside the model, which may hold the soil of one side only.
bool divides_soil(const Model& model, const Boundary& line) {
  const bool upright = line.line[0][0] == line.line[1][0];
  const std::size_t axis = upright ? 0 : 1;
  const double at = line.line[0][axis];
  bool below = false, above = false;
  for (const SoilBody& soil : model.soils) {
    if (soil.region.polygon.empty()) continue;
    const Bounds extent = bounds(soil.region.polygon);
    below = below || extent.low[axis] < at - 1e-9;
    above = above || extent.high[axis] > at + 1e-9;
  }
  return below && above;
}

void check_line_limits(const Model& model, const Boundary& boundary, const Fields& f, Diagnostics& diagnostics) {
  if (boundary.water == WaterCondition::closed)
    report(diagnostics, f.place_of("water"), f.path_of("water"),
           "lines that stop water inside the model are not available yet", "set water = \"open\"");
  if (boundary.soil != SoilCondition::none && divides_soil(model, boundary))
    report(diagnostics, f.place_of("line"), f.path_of("line"), "has soil on both sides, which is not available yet",
           "a line may hold the soil of one side");
}

/// The unsaturated formulation has its own step, which does not know everything that the double-point one does.
void check_unsaturated_limits(const Sections& sections, const Model& model, Diagnostics& diagnostics) {
  const auto refuse = [&](const Fields& f, std::string_view key, std::string_view what, std::string_view remedy) {
    report(diagnostics, f.place_of(key), f.path_of(key),
           fmt::format("{} not available in the unsaturated formulation yet", what), std::string(remedy));
  };
  if (model.numerics.transfer != Transfer::apic) refuse(sections.numerics, "transfer", "is", "leave it out");
  if (model.space == SpaceKind::solid) {
    if (!model.rains.empty())
      refuse(sections.rains.front(), "rate", "[[rain]] in 3d is",
             "give condition = \"rain\" by a [[seepage_boundary]]");
    if (!model.free_water.empty())
      refuse(sections.free_water.front(), "box", "free water in 3d is",
             "give the river's level as a head by a [[seepage_boundary]]");
    for (std::size_t i = 0; i < model.boundaries.size(); ++i)
      if (model.boundaries[i].water != WaterCondition::closed)
        refuse(sections.boundaries[i], "water", "water conditions of a [[boundary]] in 3d are",
               "give them by a [[seepage_boundary]]");
  }
  // the free water's step knows bodies that stay, and what it does to them is not summed up
  const bool flows = !model.rains.empty() || !model.free_water.empty() ||
                     std::any_of(model.boundaries.begin(), model.boundaries.end(),
                                 [](const Boundary& b) { return b.water != WaterCondition::closed; });
  const std::string_view instead = "give water levels and rain by a [[seepage_boundary]]";
  for (std::size_t i = 0; flows && i < model.walls.size(); ++i)
    for (const char* key : {"velocity_x", "velocity_upward", "displacement_x", "displacement_upward"})
      if (moves(model.walls[i]) && sections.walls[i].is_given(key))
        refuse(sections.walls[i], key, "bodies that move beside free water are", instead);
  for (std::size_t i = 0; flows && i < model.monitors.size(); ++i)
    if (model.monitors[i].kind == MonitorKind::wall && model.monitors[i].quantity != "displacement")
      refuse(sections.monitors[i], "kind", "forces on walls beside free water are", instead);
}

}  // namespace

void check_limits(const Sections& sections, const Model& model, Diagnostics& diagnostics) {
  if (model.unsaturated) check_unsaturated_limits(sections, model, diagnostics);
  for (std::size_t i = 0; i < model.stages.size(); ++i) {
    const Fields& f = sections.stages[i];
    for (const char* key : {"rest_energy", "rest_force"})
      if (!model.stages[i].until_rest && f.is_given(key))
        report(diagnostics, f.place_of(key), f.path_of(key), "has no meaning without until_rest",
               "leave it out, or set until_rest = true");
  }
  for (const Fields& f : sections.stages)
    for (const char* key : {"mass_scaling", "step_stretch"})
      if (!model.unsaturated && f.is_given(key))
        report(diagnostics, f.place_of(key), f.path_of(key), "is only for the unsaturated formulation",
               "leave it out, or set model.formulation = \"unsaturated\"");
  const auto refuse_step_material = [&](const char* what, const char* remedy) {
    const Fields& f = sections.numerics;
    report(diagnostics, f.place_of("step_material"), f.path_of("step_material"), what, remedy);
  };
  if (!model.unsaturated && sections.numerics.is_given("step_material"))
    refuse_step_material("is only for the unsaturated formulation",
                         "leave it out, or set model.formulation = \"unsaturated\"");
  for (const MaterialInput& material : model.materials)
    if (material.fixed && material.name == model.numerics.step_material)
      refuse_step_material("names a material that is fixed, which has no natural step", "name one that moves");
  int lines = 0;
  for (std::size_t i = 0; i < model.boundaries.size(); ++i) {
    const Boundary& b = model.boundaries[i];
    const Fields& f = sections.boundaries[i];
    const bool lets_out = b.water == WaterCondition::head || b.water == WaterCondition::open;
    if (b.side && lets_out && b.soil == SoilCondition::none)
      report(diagnostics, f.place_of("soil"), f.path_of("soil"), "soil cannot leave by a side that water leaves by yet",
             "set soil = \"roller\" or \"rough\"");
    if (b.side && b.soil == SoilCondition::none && !lets_out)
      report(diagnostics, f.place_of("soil"), f.path_of("soil"),
             "sides that the soil does not feel are not available yet", "set soil = \"roller\" or \"rough\"");
    if (b.soil == SoilCondition::absorbing && (!b.side || b.water != WaterCondition::closed))
      report(diagnostics, f.place_of("soil"), f.path_of("soil"), "only a closed side of the model absorbs waves",
             b.side ? "set water = \"closed\", or soil = \"roller\"" : "give a side instead of a line or a region");
    if (b.line.size() == 2) {
      check_line_limits(model, b, f, diagnostics);
      if (++lines > 1)
        report(diagnostics, f.place_of("line"), f.path_of("line"),
               "more than one line inside the model is not available yet", "keep one");
    }
  }
}

}  // namespace polder::case_file
