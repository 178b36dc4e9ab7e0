#pragma once
// The numbers of a seepage computation that an engineer asks for first: what enters and leaves where, what flows
// through sections, how steep the exit is, where the water table lies.
#include <string>
#include <vector>

#include "polder/seepage/flow.hpp"

namespace polder {

struct FlowValue {
  std::string quantity;  ///< "outflow", "inflow", "discharge", "exit gradient", "water table", "head"
  std::string at;        ///< the name of the boundary or monitor, or a place
  double time = 0;       ///< s
  double value = 0;      ///< SI
  std::string unit;
};

/// Inflow and outflow over all boundaries of one name (m²/s), the largest exit gradient of each, the discharge through
/// the model's section monitors (from their left to their right, looking along them), head and water table at its point
/// monitors, the water table at its monitors of the water surface.
std::vector<FlowValue> read_flow(const Model& model, const FlowSolver& solver, const FlowState& state);

}  // namespace polder
