// Sides that move or that water sticks to, gravity that leans, models that go on beyond their ends.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "polder/case/sections.hpp"

namespace polder::case_file {
namespace {

/// The way that a side goes in all, m, in either direction.
double way(const Table& velocity, double duration) {
  constexpr int parts = 10000;
  double sum = 0;
  for (int i = 0; i < parts; ++i) sum += std::abs(velocity((i + 0.5) * duration / parts)) * duration / parts;
  return sum;
}

void check_motion(const Boundary& b, const Fields& f, const Model& model, Diagnostics& diagnostics) {
  const bool slides = f.is_given("slide"), pushes = f.is_given("push");
  const std::string_view key = slides ? "slide" : pushes ? "push" : "water";
  const bool sticky = b.water == WaterCondition::no_slip;
  if (!slides && !pushes && !sticky) return;
  if (!f.is_given("side"))
    report(diagnostics, f.place_of(key), f.path_of(key), "is for a side of the model",
           "give side = \"left\", \"right\", \"base\" or \"top\"");
  if (model.unsaturated)
    report(diagnostics, f.place_of(key), f.path_of(key), "the unsaturated formulation does not know this",
           "take another formulation, or leave it out");
  if (slides && b.soil != SoilCondition::rough && !sticky)
    report(diagnostics, f.place_of("slide"), f.path_of("slide"), "nothing sticks to this side",
           "set soil = \"rough\" or water = \"no-slip\"");
  if (!pushes) return;
  if (b.water != WaterCondition::closed && !sticky)
    report(diagnostics, f.place_of("push"), f.path_of("push"), "only a side that is closed to water pushes",
           "leave \"water\" out, or set it to \"closed\" or \"no-slip\"");
  double duration = 0;
  for (const Stage& stage : model.stages)
    if (!stage.initial) duration += stage.duration;
  const std::size_t up = model.space == SpaceKind::solid ? 2 : 1;
  const std::size_t axis = b.side == Side::left || b.side == Side::right   ? 0
                           : b.side == Side::front || b.side == Side::back ? 1
                                                                           : up;
  const double cell = model.cell[axis], far = way(b.push, duration);
  if (cell > 0 && far > 0.25 * cell)
    report(diagnostics, f.place_of("push"), f.path_of("push"),
           fmt::format("the side goes {:.3g} m, more than a quarter of a cell", far),
           fmt::format("its place on the grid stays: at most {:.3g} m here", 0.25 * cell));
}

void check_periodic(const Sections& sections, const Model& model, Diagnostics& diagnostics) {
  const Fields& own = sections.model;
  const auto refuse = [&](const std::string& what, const std::string& help) {
    report(diagnostics, own.place_of("periodic"), own.path_of("periodic"), what, help);
  };
  if (model.unsaturated) refuse("the unsaturated formulation has ends", "take another formulation");
  if (!model.walls.empty()) refuse("a periodic model has no [[wall]] yet", "leave one of the two out");
  if (model.cell[0] > 0 && std::lround(model.size[0] / model.cell[0]) < 4)
    refuse("a periodic model has at least four cells along x", "make it longer, or the cell smaller");
  for (std::size_t i = 0; i < sections.boundaries.size(); ++i) {
    const Boundary& b = model.boundaries[i];
    const Fields& f = sections.boundaries[i];
    if (b.side == Side::left || b.side == Side::right)
      report(diagnostics, f.place_of("side"), f.path_of("side"), "a periodic model has no such side",
             "leave it out, or set model.periodic = false");
    else if (!b.side)
      report(diagnostics, f.place, f.path, "a periodic model has no lines or reservoirs inside",
             "leave it out, or set model.periodic = false");
  }
}

void check_tilt(const Sections& sections, const Model& model, Diagnostics& diagnostics) {
  const Fields& own = sections.model;
  const auto refuse = [&](const std::string& what, const std::string& help) {
    report(diagnostics, own.place_of("tilt"), own.path_of("tilt"), what, help);
  };
  if (model.unsaturated) refuse("the unsaturated formulation knows upright gravity only", "take another formulation");
  if (!model.soils.empty() &&
      (model.initial_stress == InitialStress::k0 || model.initial_stress == InitialStress::k0_slope))
    refuse("the stress at rest by K0 is for upright gravity",
           "set initial.stress = \"gravity\" with an initial stage that raises it, or \"none\"");
  for (std::size_t i = 0; i < sections.boundaries.size(); ++i) {
    const Boundary& b = model.boundaries[i];
    if (b.water == WaterCondition::head || b.water == WaterCondition::reservoir)
      report(diagnostics, sections.boundaries[i].place_of("water"), sections.boundaries[i].path_of("water"),
             "heads and levels are for upright gravity", "leave it out, or set model.tilt = \"0 deg\"");
  }
}

}  // namespace

void check_sides(const Sections& sections, const Model& model, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < sections.boundaries.size(); ++i)
    check_motion(model.boundaries[i], sections.boundaries[i], model, diagnostics);
  if (model.periodic) check_periodic(sections, model, diagnostics);
  if (model.tilt != 0) check_tilt(sections, model, diagnostics);
}

}  // namespace polder::case_file
