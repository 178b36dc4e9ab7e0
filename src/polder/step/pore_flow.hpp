#pragma once
// Flow of the pore water in the unsaturated formulation: the balance of every cell in the pressures at the end of the
// step, the soil's response included, by Newton with conservative increments (docs/theory.md, "Unsaturated soil").
#include <vector>

#include "polder/grid/pressure_solver.hpp"
#include "polder/step/cell_weights.hpp"
#include "polder/step/fields.hpp"
#include "polder/step/pore_fields.hpp"

namespace polder {

/// What passes between a cell and the outside: out = max(conductance (p − level), least).
struct PoreExit {
  std::ptrdiff_t cell;
  double conductance;  ///< m³/s/Pa
  double level;        ///< Pa, pressure of the cell at which nothing flows
  double least;        ///< m³/s: 0 at a seepage face, −rain; −∞ where a head is given
  double out = 0;      ///< m³/s, at the end of the step
  int column = -1;     ///< of cells, whose free water takes or gives it; −1: the outside does

  /// What takes m³/s from a cell, whatever its pressure.
  static PoreExit given(std::ptrdiff_t cell, double rate) { return {cell, 1, 1e300, rate}; }
};

/// Sets contents, saturations, conductivities at the pressures as they are; hosts of cells without soil; which cells
/// are active, with a pressure for those that have become so; which faces follow another.
template <class Space>
void prepare_cells(const Setup<Space>& setup, GridFields<Space>& grid, PoreFields<Space>& pores);

/// body(cell, its host) for the cells that another one stands for.
template <class Space, class Body>
void over_hosted(const Lattice<Space>& lattice, const PoreFields<Space>& pores, Body&& body) {
  over_all_cells(lattice, [&](std::ptrdiff_t cell, const auto&) {
    if (pores.host[cell] >= 0) body(cell, std::ptrdiff_t{pores.host[cell]});
  });
}

/// S at the cells' pressures, and content and storage.
template <class Space>
void fill_pores(const Setup<Space>& setup, const GridFields<Space>& grid, PoreFields<Space>& pores, Team& team);

/// Solves for the pressures. In: `grid.soil_velocity` with the old pressures' force, `grid.soil_response`, its change
/// by a force (m/s per N). Out: pressures, velocities, flows, `exits[].out`.
template <class Space>
SolveResult solve_pore_pressure(const Setup<Space>& setup, double dt, std::vector<PoreExit>& exits,
                                GridFields<Space>& grid, PoreFields<Space>& pores, PressureSolver<Space>& solver,
                                Team& team);

/// Force of the water on a face, N, along the axis, by the saturations at the start of the step: the difference of what
/// presses on either side.
template <class Space>
double pressure_force(const Lattice<Space>& lattice, const PoreFields<Space>& pores, const Array& pressure, int axis,
                      std::ptrdiff_t face) {
  const std::ptrdiff_t low = face - lattice.stride[axis];
  const Array& w = pores.weight[axis];
  return (w[low] * pores.saturation[low] * pressure[low] - w[face] * pores.saturation[face] * pressure[face]) /
         lattice.spacing[axis];
}

/// Force on a face, N, along the axis, of still water that stands on the ground: what presses on either side in the
/// room beside the soil. Upwards the weight of the water in that room is taken off, which leaves the pressure at the
/// face on the difference of the two rooms: summed over the faces of a column the load of the water, whatever its
/// depth, and nothing where there is no soil. With the pressure of the pores it is buoyancy, ρ_w g times the soil's
/// volume; that goes to the faces by the splines that the weight goes by, for a face at the surface has little of
/// either.
template <class Space>
double standing_water_force(const Lattice<Space>& lattice, const PoreFields<Space>& pores, double weight, int axis,
                            std::ptrdiff_t face) {
  const std::ptrdiff_t low = face - lattice.stride[axis];
  const auto room = [&](std::ptrdiff_t cell) {
    if (pores.flooded[cell] == 0) return 0.0;
    const std::array<int, 3> at = lattice.places(cell);
    const double full = full_weight(lattice, axis, at);
    const double held = (pores.bulk[cell] - pores.yielding[cell]) * (full / lattice.cell_volume(at));
    return full - pores.weight[axis][cell] - held;
  };
  const double below = room(low), above = room(face);
  if (axis != Space::up) return (below * pores.over_side[low] - above * pores.over_side[face]) / lattice.spacing[axis];
  const double push = pores.flooded[face] * pores.over_face[face] * (below - above) / lattice.spacing[axis];
  if (pores.flooded[low] == 0) return push;
  const int place = lattice.place(face, axis);
  const double wide_below = relative_width(lattice, axis, place - 1), wide = relative_width(lattice, axis, place);
  const double volume = 0.5 * (pores.weight[axis][low] * wide_below + pores.weight[axis][face] * wide);
  const double whole_below = lattice.cell_volume(low), whole = lattice.cell_volume(face);
  const bool deep =
      volume >= (1 - 1e-9) * 0.5 * (whole_below + whole) ||  // of different cells w_a is what balances stress
      (lattice.graded && pores.yielding[low] > 0.9 * whole_below && pores.yielding[face] > 0.9 * whole);
  return deep ? push : push + weight * pores.flooded[low] * (pores.face_bulk[face] - volume);
}

/// D of every cell by the faces' velocities, that of cells without soil added to their hosts'.
template <class Space>
void set_volume_change(const Setup<Space>& setup, const GridFields<Space>& grid, PoreFields<Space>& pores, Team& team);

}  // namespace polder
