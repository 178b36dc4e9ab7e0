#pragma once
// The pressure that makes the mixture's flux divergence-free (up to the water's compressibility), its effect on both
// phases, and the correction of the water's volume by shifting positions. docs/theory.md, "Step 4" to "Step 6".
#include "polder/grid/pressure_solver.hpp"
#include "polder/step/fields.hpp"
#include "polder/step/setup.hpp"
#include "polder/step/wells.hpp"

namespace polder {

/// Solves for grid.pressure, with what wells take, and corrects both phases' face velocities.
template <class Space>
SolveResult project(const Setup<Space>& setup, double dt, const std::vector<WellFlow>& wells, GridFields<Space>& grid,
                    PressureSolver<Space>& solver, Team& team);

/// Shift of water positions (grid.shift, m on the faces) that moves cells' fill towards one. Reads nothing that
/// project() writes and writes nothing that it reads, so that both may run at the same time, each with a solver of its
/// own.
template <class Space>
SolveResult correct_volume(const Setup<Space>& setup, GridFields<Space>& grid, PressureSolver<Space>& solver,
                           Team& team);

/// Carries a face field of the water two layers past the faces that a wet cell reaches. Beyond, the field is kept where
/// `keep_ballistic` and water has written to the face, else zero. `layers` is scratch.
template <class Space>
void extrapolate_water(const Setup<Space>& setup, const GridFields<Space>& grid, FaceField<Space>& field,
                       bool keep_ballistic, Layers<Space>& layers, Team& team);

/// Carries the soil's velocity one layer past the faces that soil has written to: water beside soil moves relative to
/// it.
template <class Space>
void extrapolate_soil(const Setup<Space>& setup, GridFields<Space>& grid, Team& team);

/// Distance from a wet cell's centre to the surface towards a dry cell, in spacings.
inline double surface_distance(double fill_wet, double fill_dry) {
  const double theta = fill_wet + fill_dry - 0.5;
  return theta < 0.02 ? 0.02 : theta > 1 ? 1 : theta;
}

}  // namespace polder
