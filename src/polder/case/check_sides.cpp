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
  if (slides && b.soil != SoilCondition::rough && !sticky)
    report(diagnostics, f.place_of("slide"), f.path_of("slide"), "nothing sticks to this side",
           "set soil = \"rough\" or water = \"no-slip\"");
  if (!pushes) return;
  if (b.soil == SoilCondition::absorbing)
    report(diagnostics, f.place_of("push"), f.path_of("push"), "this side absorbs waves, and yields to what it pushes",
           "set soil = \"roller\" or \"rough\"");
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

/// Free water on unsaturated ground, by the keys that bring it: its step takes the ground for a body.
void refuse_free_water(const Sections& sections, const Model& model, std::string_view what, Diagnostics& diagnostics) {
  const auto refuse = [&](const Fields& f, std::string_view key, std::string_view help) {
    report(diagnostics, f.place_of(key), f.path_of(key), std::string(what), std::string(help));
  };
  for (const Fields& f : sections.free_water) refuse(f, "box", "leave it out, or take the double-point formulation");
  for (const Fields& f : sections.rains) refuse(f, "rate", "give condition = \"rain\" by a [[seepage_boundary]]");
  for (std::size_t i = 0; i < model.boundaries.size(); ++i) {
    const WaterCondition water = model.boundaries[i].water;
    if (water != WaterCondition::closed && water != WaterCondition::no_slip)
      refuse(sections.boundaries[i], "water", "give what passes the ground by a [[seepage_boundary]]");
  }
}

/// Whether a line lies on the left or the right end of the model.
bool on_end(const std::vector<std::array<double, 2>>& line, const Model& model) {
  const double near = 1e-6 * model.cell[0];
  return !line.empty() && std::all_of(line.begin(), line.end(), [&](const auto& p) {
    return std::abs(p[0] - line[0][0]) < near && (p[0] < near || p[0] > model.size[0] - near);
  });
}

void check_periodic(const Sections& sections, const Model& model, Diagnostics& diagnostics) {
  const Fields& own = sections.model;
  const auto refuse = [&](const std::string& what, const std::string& help) {
    report(diagnostics, own.place_of("periodic"), own.path_of("periodic"), what, help);
  };
  if (model.unsaturated) {
    refuse_free_water(sections, model, "free water over unsaturated ground has ends, and a periodic model has none",
                      diagnostics);
    for (std::size_t i = 0; i < model.pore_water.size(); ++i)
      if (on_end(model.pore_water[i].line, model))
        report(diagnostics, sections.seepage_boundaries[i].place_of("line"),
               sections.seepage_boundaries[i].path_of("line"), "a periodic model has no such end",
               "leave it out, or set model.periodic = false");
  }
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
  if (model.unsaturated) {
    refuse_free_water(sections, model, "free water over unsaturated ground is for upright gravity", diagnostics);
    for (std::size_t i = 0; i < model.pore_water.size(); ++i)
      if (model.pore_water[i].kind == SeepageCondition::Kind::head)
        report(diagnostics, sections.seepage_boundaries[i].place_of("head"),
               sections.seepage_boundaries[i].path_of("head"), "heads and levels are for upright gravity",
               "take condition = \"seepage\", \"rain\" or \"closed\", or set model.tilt = \"0 deg\"");
    for (std::size_t i = 0; i < model.wells.size(); ++i)
      if (model.wells[i].head)
        report(diagnostics, sections.wells[i].place_of("head"), sections.wells[i].path_of("head"),
               "heads and levels are for upright gravity", "give a discharge, or set model.tilt = \"0 deg\"");
  }
  if (model.initial_seepage)
    report(diagnostics, sections.initial.place_of("seepage"), sections.initial.path_of("seepage"),
           "steady seepage at the start is for upright gravity", "give initial.water_table");
  if (!model.soils.empty() && is_by_k0(model.initial_stress))
    refuse("the stress at rest by K0 is for upright gravity",
           "set initial.stress = \"gravity\" with an initial stage that raises it, or \"none\"");
  for (std::size_t i = 0; i < sections.boundaries.size(); ++i) {
    const Boundary& b = model.boundaries[i];
    if (!model.unsaturated && (b.water == WaterCondition::head || b.water == WaterCondition::reservoir))
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
