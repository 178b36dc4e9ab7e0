#pragma once
// What acts on the drawn model along its ground: water with a given head, seepage, rain, loads.
#include "polder/case/model.hpp"
#include "polder/result/drawing.hpp"
#include "polder/result/panel.hpp"

namespace polder {

/// Conditions of the pore water along their lines, with the levels of heads (unsaturated formulation).
void draw_pore_water(Drawing& drawing, const Panel& panel, const Model& model);

/// Arrows on the ground over the span of each load, with its largest pressure.
void draw_loads(Drawing& drawing, const Panel& panel, const Model& model);

// Samples for a legend, 22 units wide from x, centred at the height y.
void head_sample(Drawing& drawing, double x, double y, const Colour& colour);
void seepage_sample(Drawing& drawing, double x, double y, const Colour& colour);
void rain_sample(Drawing& drawing, double x, double y, const Colour& colour);
void load_sample(Drawing& drawing, double x, double y, const Colour& colour);

}  // namespace polder
