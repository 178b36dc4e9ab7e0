// Sides of the model that are open to water: head, inflow, and the part of the side that is open.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "polder/case/sections.hpp"

namespace polder::case_file {
namespace {

void check_head_and_inflow(const Boundary& b, const Fields& f, Diagnostics& diagnostics) {
  const bool head = b.water == WaterCondition::head, inflow = b.water == WaterCondition::inflow;
  if ((head || inflow) && !f.is_given("side"))
    report(diagnostics, f.place_of("water"), f.path, fmt::format("\"{}\" is for a side of the model", f.text("water")),
           "give side = \"left\", \"right\", \"base\" or \"top\"");
  if (head && !f.is_given("head"))
    report(diagnostics, f.place_of("water"), f.path, "the head is missing", "add head = \"0.8 m\"");
  if (inflow && !f.is_given("inflow"))
    report(diagnostics, f.place_of("water"), f.path, "the inflow is missing", "add inflow = \"5 mm/s\"");
  if (f.is_given("head") && !head && b.water != WaterCondition::reservoir)
    report(diagnostics, f.place_of("head"), f.path_of("head"), "only a reservoir or a side with a head has one",
           "set water = \"reservoir\" or water = \"head\"");
  if (f.is_given("inflow") && !inflow)
    report(diagnostics, f.place_of("inflow"), f.path_of("inflow"), "only a side with an inflow has one",
           "set water = \"inflow\"");
  if (f.is_given("span") && !head && !inflow && b.water != WaterCondition::open)
    report(diagnostics, f.place_of("span"), f.path_of("span"),
           "only a side that is open, with a head or with an inflow has an opening",
           "set water = \"open\", \"head\" or \"inflow\"");
}

/// An opening lies in its side and is at least a face of the grid wide; says so where it is moved to the grid.
void check_span(const Boundary& b, const Fields& f, const Model& model, Diagnostics& diagnostics) {
  const std::size_t up = model.space == SpaceKind::solid ? 2 : 1;
  const std::size_t along = b.side == Side::left || b.side == Side::right ? up : 0;
  const double length = model.size[along], cell = model.cell[along];
  if (!(length > 0 && cell > 0)) return;
  const auto [from, to] = *b.span;
  if (from < -1e-9 * length || to > length * (1 + 1e-9)) {
    report(diagnostics, f.place_of("span"), f.path_of("span"),
           fmt::format("{:.6g} m to {:.6g} m is outside the side", from, to),
           fmt::format("the side reaches from 0 to {:.6g} m", length));
    return;
  }
  const GridAxis axis = grid_axis(model, along);
  const int low = axis.nearest_edge(from), high = axis.nearest_edge(to);
  if (low >= high)
    report(diagnostics, f.place_of("span"), f.path_of("span"),
           "is narrower than a cell: nothing of the opening is left",
           fmt::format("the grid has cells of {:.6g} m; make the opening wider or the cell smaller", cell));
  else if (std::max(std::abs(axis.edge(low) - from), std::abs(axis.edge(high) - to)) > 1e-6 * axis.least())
    warn(diagnostics, f.place_of("span"), f.path_of("span"),
         fmt::format("is moved to the faces of the grid: {:.6g} m to {:.6g} m", axis.edge(low), axis.edge(high)));
}

}  // namespace

void check_openings(const Sections& sections, const Model& model, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < sections.boundaries.size(); ++i) {
    const Boundary& b = model.boundaries[i];
    const Fields& f = sections.boundaries[i];
    check_head_and_inflow(b, f, diagnostics);
    if (b.span && b.side) check_span(b, f, model, diagnostics);
  }
}

}  // namespace polder::case_file
