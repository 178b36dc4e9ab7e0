#pragma once
// The section of a case: the same polygons and materials that `polder run` simulates, with what its [stability]
// sections add.
#include "polder/case/model.hpp"
#include "polder/stability/section.hpp"

namespace polder::stability {

/// Throws std::invalid_argument that lists every reason why the case has no factor of safety: three dimensions, no
/// soil, materials without a strength, a water table above the ground where the case has no free water.
Section section_from_model(const Model& model, const Input& input);

}  // namespace polder::stability
