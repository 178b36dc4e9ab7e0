#pragma once
// Steady seepage as the state of the pore water at the start.
#include "polder/case/model.hpp"

namespace polder {

/// Of a case with `initial.seepage` (plane strain) the same with the water of steady seepage by finite elements under
/// its conditions at t = 0: `water_table` through the middles of the columns of cells and, in the unsaturated
/// formulation, `start_pressure`. Any other case as it is. Throws std::invalid_argument where there is nothing to
/// compute, std::runtime_error where no solution is found.
Model with_steady_seepage(const Model& model);

}  // namespace polder
