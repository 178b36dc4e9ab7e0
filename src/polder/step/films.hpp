#pragma once
// Films of water, thinner than half a cell, on a floor or on wet soil: their cells are not wet and have no pressure of
// their own.
#include "polder/math/threads.hpp"
#include "polder/step/fields.hpp"
#include "polder/step/setup.hpp"

namespace polder {

/// What a film's weight does to it: the water on the upright faces between cells that are not wet is accelerated by
/// g ∂d/∂x towards the lesser depth d, as in shallow water. A film is water whose cell stands on a wall, a body or
/// wet soil. After predict_faces(), before the pressure acts.
template <class Space>
void spread_films(const Setup<Space>& setup, const StepControl& control, double dt, GridFields<Space>& grid,
                  Team& team);

/// Cells cut by a body that are wet while nothing beside them is count as dry: a drop on a slope slides freely. Its
/// pressure would bend its way to the openings that the cut leaves the cell, and drag what is slower along: drops were
/// shot up a bank at hundreds of m/s. After water_to_grid().
template <class Space>
void let_drops_slide(const Setup<Space>& setup, GridFields<Space>& grid);

}  // namespace polder
