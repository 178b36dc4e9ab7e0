#pragma once
// The model as an engineer draws it: soils by material, free water and water table, supports and water boundaries,
// monitors, cells and dimensions. `polder check` shows it. In 3d it is the section (x, height).
#include "polder/case/model.hpp"
#include "polder/result/drawing.hpp"

namespace polder {

struct ModelStyle {
  double width = 960;       ///< drawing units
  double max_height = 600;  ///< of the model itself; a tall model makes a narrower drawing
};

Drawing draw_model(const Model& model, const ModelStyle& style = {});

/// The conventional colours of section drawings where a material's name tells the soil, each used once; the rest by
/// turns.
std::vector<Colour> material_colours(const std::vector<std::string>& names);

}  // namespace polder
