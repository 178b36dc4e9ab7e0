#pragma once
// The section of a case: the same polygons and materials that `polder run` simulates, with what its [stability]
// sections add.
#include <optional>
#include <string_view>

#include "polder/case/model.hpp"
#include "polder/stability/section.hpp"

namespace polder::stability {

/// Throws std::invalid_argument that lists every reason why the case has no factor of safety: three dimensions, no
/// soil, materials without a strength, a water table above the ground where the case has no free water.
Section section_from_model(const Model& model, const Input& input);

/// A parameter of the material's law by its key; absent where the law has none of that name.
std::optional<double> law_parameter(const MaterialInput& material, std::string_view key);

}  // namespace polder::stability
