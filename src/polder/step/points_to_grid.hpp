#pragma once
// Points to grid: APIC momentum and mass on the faces, internal forces of the soil, volumes and drag in the cells.
// docs/theory.md, "Step 1" and "Step 2".
#include "polder/points/tiles.hpp"
#include "polder/step/fields.hpp"
#include "polder/step/setup.hpp"

namespace polder {

/// Soil to faces (mass, momentum, −V σ'·∇N, loads on the ground at `time`) and to cells (solid volume, mass, drag);
/// then the cells' porosity.
template <class Space>
void soil_to_grid(const Setup<Space>& setup, const SoilPoints<Space>& soil, const Tiling<Space>& tiling, double time,
                  GridFields<Space>& grid, Team& team);

/// Water to faces (mass, momentum) and to cells (volume by overlap of boxes in the pores of the soil), in the
/// single-point formulation also what the soil points carry; then fill and which cells are wet. After soil_to_grid().
template <class Space>
void water_to_grid(const Setup<Space>& setup, const SoilPoints<Space>& soil, const Tiling<Space>& soil_tiling,
                   const WaterPoints<Space>& water, const Tiling<Space>& tiling, GridFields<Space>& grid, Team& team);

}  // namespace polder
