#pragma once
// What is measured on a state as one would on a photograph of the experiment: surfaces, fronts, eroded area, uplift.
#include <vector>

#include "polder/case/geometry.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {

/// Height of the water above y = 0 in the column of cells at `place`, m: up to the highest wet cell.
template <class Space>
double water_surface(const Simulation<Space>& run, const Point3& place);

/// Height of the highest soil whose grains are in contact, in the column of cells at `place`, m.
template <class Space>
double soil_surface(const Simulation<Space>& run, const Point3& place);

/// Height of the soil in each column of cells, m (the columns of a row along x side by side): the grains in contact,
/// packed as at the start, so that loosening does not count; `at_start`: where the soil was at t = 0.
template <class Space>
std::vector<double> soil_columns(const Simulation<Space>& run, const Region& region, bool at_start);

/// Area (volume in 3d) of the columns that are lower than `before`, m²: Σ max(0, H₀ − H) over the columns.
template <class Space>
double eroded_area(const Simulation<Space>& run, const Region& region, const std::vector<double>& before);

/// Farthest x to which the water is half a cell deep, m; linear between the columns. Soil counts by its grains in
/// contact and where it is two and a half grains deep as well, so that a finer grid does not follow ever thinner
/// layers.
template <class Space>
double water_front(const Simulation<Space>& run);
template <class Space>
double soil_front(const Simulation<Space>& run);

/// Largest upward displacement of soil that was in the region at the start, m.
template <class Space>
double largest_uplift(const Simulation<Space>& run, const Region& region);

/// Pressure over that of the initial water table at rest, Pa, linear between the centres of wet cells.
template <class Space>
double excess_pressure(const Simulation<Space>& run, const Point3& place);

/// Angle from the horizontal, degrees, of the edge of the soil that is lifted over an opening whose right edge is
/// `edge`. In each layer of points above it the soil counts as lifted out to where its upward displacement last exceeds
/// a tenth of the layer's largest; the edge is the straight line through `edge` that fits these ends best (least
/// squares of x). 0 while nothing is lifted.
template <class Space>
double wedge_angle(const Simulation<Space>& run, const Point3& edge);

/// Whether a region that may be left out, which means everywhere, contains a place.
template <class Space>
bool inside(const Region& region, const std::array<double, 3>& x) {
  return region.polygon.empty() || contains(region, x[0], Space::axes == 3 ? x[1] : 0, x[Space::up]);
}

}  // namespace polder
