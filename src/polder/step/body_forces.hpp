#pragma once
// What soil and water do to the bodies, and the bodies to them.
#include <vector>

#include "polder/step/fields.hpp"
#include "polder/step/pore_fields.hpp"
#include "polder/step/setup.hpp"

namespace polder {

/// Of one body in a step; along x and upwards.
struct BodyForce {
  std::size_t wall;        ///< its number among the walls of the case
  Point2 soil{}, water{};  ///< N (plane strain: N/m), on the body: of the grains, and of the water's pressure
  double displaced = 0;    ///< m³/s (plane strain: m²/s) of water, net, that makes way for it
  double power = 0;        ///< W, of the body on what is in the model
};

/// After a step of `dt`, by its pressures and `grid.body_impulse`. Within a cell the pressure
/// rises downwards as in still water, so that the force of still water is the weight of what the body displaces.
/// `pores`, in the unsaturated formulation: their water presses with S p, which is part of `grid.body_impulse`.
template <class Space>
std::vector<BodyForce> body_forces(const Setup<Space>& setup, double dt, const GridFields<Space>& grid,
                                   const PoreFields<Space>* pores = nullptr);

}  // namespace polder
