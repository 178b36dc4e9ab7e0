#pragma once
// Points to grid and back in the unsaturated formulation. Derivatives along a component's own axis are the difference
// of the two faces of the point's cell: B-splines would smear the strain of soft soil into stiff soil beside it.
#include "polder/points/tiles.hpp"
#include "polder/step/fields.hpp"
#include "polder/step/grid_to_points.hpp"
#include "polder/step/pore_fields.hpp"

namespace polder {

/// Half the edges, in cells, of the box over which a point counts for cells: that of its volume at the start, so that
/// its shares change by its motion alone. It has the proportions of the cell in which the point's displacement began.
template <class Space>
std::array<double, 3> box_half(const Setup<Space>& setup, const SoilPoints<Space>& soil, std::size_t p);

/// Inertia of a point, kg: that of soil and water times `scaling`, or what soil of modulus M needs at the step:
/// V M (Δt/(cfl h))².
struct InertiaRule {
  double scaling = 1;
  double step = 0;  ///< s
};

/// Mass (of inertia), momentum and force (internal, weight) to the faces; volumes, water, resistances, weights to the
/// cells. `gravity_factor`: how much of gravity acts; loads on the ground as at `time`.
template <class Space>
void mixture_to_grid(const Setup<Space>& setup, const SoilPoints<Space>& soil, const Tiling<Space>& tiling,
                     InertiaRule inertia, double gravity_factor, double time, GridFields<Space>& grid,
                     PoreFields<Space>& pores, Team& team);

/// The volume of the soil that yields to the upward faces, into `pores.face_bulk`.
template <class Space>
void bulk_to_faces(const Setup<Space>& setup, const SoilPoints<Space>& soil, const Tiling<Space>& tiling,
                   PoreFields<Space>& pores, Team& team);

/// Velocities and rates of strain to the points; dilation such that each cell's points change their volume as its
/// faces' velocities say; then stress and porosity. The points have not moved yet. `grid.soil_velocity` is reflected.
template <class Space>
Motion strain_points(const Setup<Space>& setup, double dt, const GridFields<Space>& grid, const Tiling<Space>& tiling,
                     SoilPoints<Space>& soil, PoreFields<Space>& pores, Team& team);

/// Pore volumes of the cells from the porosities as they are, into `pores.composition` and `pores.pores`.
template <class Space>
void pores_to_grid(const Setup<Space>& setup, const SoilPoints<Space>& soil, const Tiling<Space>& tiling,
                   PoreFields<Space>& pores, Team& team);

/// What the cells' water has changed by to the points, Δ(n V S(p)(1 + p/K)) + n V surplus, and the points to where they
/// move. Changes, not the water itself: that would be mixed between cells at every step by the points that lie in two.
template <class Space>
void move_points(const Setup<Space>& setup, double dt, const Tiling<Space>& tiling, PoreFields<Space>& pores,
                 SoilPoints<Space>& soil, Team& team);

}  // namespace polder
