#pragma once
// The signs of section drawings: water levels, rollers, hatched supports, reservoirs, dimension lines; and the samples
// of them that stand in a legend.
#include <string>

#include "polder/case/model.hpp"
#include "polder/result/drawing.hpp"
#include "polder/result/panel.hpp"

namespace polder {

/// The triangle of a water level, its tip at `at`, with the two short lines below.
void draw_level_mark(Drawing& drawing, Point2 at);

/// The support and the water condition along a side of the panel, outside of it, or along an inner line.
void draw_boundary(Drawing& drawing, const Panel& panel, const Boundary& boundary);

/// A region whose head is held, with the head.
void draw_reservoir(Drawing& drawing, const Panel& panel, const Boundary& boundary);

/// A line between two arrow heads, with `text` in its middle.
void draw_dimension(Drawing& drawing, Point2 from, Point2 to, const std::string& text);

// Samples for a legend, 22 units wide from x, centred at the height y.
void swatch(Drawing& drawing, double x, double y, const Colour& colour);
void striped_swatch(Drawing& drawing, double x, double y, const Colour& colour);
void dashes(Drawing& drawing, double x, double y, const Colour& colour);
void heavy_dashes(Drawing& drawing, double x, double y, const Colour& colour);
void wall_sample(Drawing& drawing, double x, double y, const Colour& colour);
void gate_sample(Drawing& drawing, double x, double y, const Colour& colour);
void roller_sample(Drawing& drawing, double x, double y, const Colour& colour);
void hatch_sample(Drawing& drawing, double x, double y, const Colour& colour);
void absorbing_sample(Drawing& drawing, double x, double y, const Colour& colour);
void well_sample(Drawing& drawing, double x, double y, const Colour& colour);
void change_sample(Drawing& drawing, double x, double y, const Colour& colour);

}  // namespace polder
