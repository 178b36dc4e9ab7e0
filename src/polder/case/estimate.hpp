#pragma once
// What a case will cost, before it runs.
#include <cstddef>

#include "polder/case/model.hpp"

namespace polder {

/// Cells of the grid.
std::size_t cell_count(const Model& model);

/// s, the time step at which a run will start, about: cfl · h / c with c the drained P-wave of the stiffest soil,
/// √(M / ((1 − n) ρs)), and half a cell of a free fall from the top of the model where there is no soil.
double estimated_step(const Model& model);

/// Steps of a whole run, about, by the mass scaling of its stages.
struct StepCount {
  double moving = 0;   ///< if the ground moves all the time
  double at_rest = 0;  ///< if it rests all the time: with `step_stretch`, fewer
};
StepCount estimated_steps(const Model& model);

}  // namespace polder
