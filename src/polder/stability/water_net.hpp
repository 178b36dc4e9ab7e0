#pragma once
// Water pressure from a phreatic line and heads prescribed on reference lines.
#include "polder/stability/section.hpp"

namespace polder::stability {

/// Pore pressure at (x, z), Pa, under ground at height `ground`. Above the phreatic line: 0, or suction (negative) down
/// to −max_suction.
double pore_pressure(const WaterNet& net, double x, double z, double ground);

/// Pore pressure of the grid at (x, z), Pa, suction down to −max_suction.
double pore_pressure(const PressureGrid& grid, double max_suction, double x, double z);

}  // namespace polder::stability
