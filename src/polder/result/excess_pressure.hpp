#pragma once
// How far the pressure of pores is from that of still water.
#include <array>

#include "polder/stage/simulation.hpp"

namespace polder {

/// Pa: the pressure at x less that of still water up to the top of the water over x. The top is that of the unbroken
/// stack of wet cells from the cell of x upwards, so what stands or flows over the ground counts and drops in the air
/// do not. In the unsaturated formulation the stack goes up as long as the ground's pressure is positive, and ends
/// where the last of these pressures would be nought; where water hangs above that line (suction) there is no excess:
/// 0.
template <class Space>
double excess_pressure(const Simulation<Space>& run, const std::array<double, 3>& x);

}  // namespace polder
