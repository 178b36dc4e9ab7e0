#pragma once
// Sides beyond which the ground goes on: they hold the ground with the force that it had at rest, and answer motion by
// dashpots of the waves' impedances (Lysmer & Kuhlemeyer 1969), Z = ρ c, c = √(M/ρ) across the side and √(G/ρ) along
// it. Grains and water move as one on such a side; M has the stiffness of the pore water where there is some. In
// initial stages the sides are smooth walls.
#include <functional>
#include <vector>

#include "polder/points/point_sets.hpp"
#include "polder/step/fields.hpp"
#include "polder/step/pore_fields.hpp"
#include "polder/step/setup.hpp"

namespace polder {

/// The absorbing sides, as over_side() takes them.
template <class Space>
std::vector<OpenSide> far_sides(const Setup<Space>& setup);

/// In the first step of the event: what holds the sides at rest, and their impedances. After points_to_grid. The
/// pressures are those of the last step or, in the `first` step of a run, of still water under the water table.
template <class Space>
void know_far_field(const Setup<Space>& setup, const SoilPoints<Space>& soil, double gravity, bool first,
                    GridFields<Space>& grid);

/// The same in the unsaturated formulation, where faces move with one velocity. `at_rest(axis, face)`: force on a face,
/// N, along the axis. Needs the cells' volumes and storages.
template <class Space>
void know_far_ground(const Setup<Space>& setup, const SoilPoints<Space>& soil, const PoreFields<Space>& pores,
                     const std::function<double(int, std::ptrdiff_t)>& at_rest, GridFields<Space>& grid);

/// N s/m: the dashpots on the face of component c at this place, of the sides that it lies on or beside.
template <class Space>
double far_dashpot(const Setup<Space>& setup, const GridFields<Space>& grid, int c, std::array<int, 3> at);

/// The pressures beyond the sides, for the projection. After water_to_grid().
template <class Space>
void prepare_far_field(const Setup<Space>& setup, GridFields<Space>& grid);

/// So that the correction of volumes does not push water through the sides. After project().
template <class Space>
void close_far_field(const Setup<Space>& setup, GridFields<Space>& grid);

/// J, at most, that what lies beyond has done in a step.
template <class Space>
double far_work(const Setup<Space>& setup, const GridFields<Space>& grid, double dt);

}  // namespace polder
