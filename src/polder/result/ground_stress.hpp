#pragma once
// Stresses of the ground as bulk quantities: what single points carry beside an interface scatters.
#include <array>

#include "polder/case/model.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {

/// Vertical total stress at a place, Pa, compression positive: mean effective stress of the soil in the row of cells
/// above the place, one cell to each side, and the pressure that Bishop adds there, brought down to the place by the
/// soil's weight in between.
template <class Space>
double total_vertical_stress(const Simulation<Space>& run, const std::array<double, 3>& place);

/// Degree of saturation of the soil point p.
template <class Space>
double point_saturation(const Simulation<Space>& run, std::size_t p);

/// Length of the line, m, along which the mean vertical effective stress of the soil in the cell above it is below 2
/// kPa.
template <class Space>
double uplift_length(const Simulation<Space>& run, const Point3& from, const Point3& to);

}  // namespace polder
