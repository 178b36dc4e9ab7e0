#pragma once
// How far the ground is from rest.
#include "polder/step/stepper.hpp"

namespace polder {

/// Both are 0 at rest and count grains and water together.
struct Unrest {
  double energy = 0;  ///< kinetic energy over the weight times the height of a cell, Σ ½ m v² / (Σ m g · h)
  /// Out-of-balance force over the weight, Σ |m Δv/Δt| / Σ m g, with what damping left of it; in the unsaturated
  /// formulation before damping.
  double force = 0;
};

/// Of the step of length `dt`, s, that has just been made, from the faces of the grid.
template <class Space>
Unrest unrest(const Stepper<Space>& state, double dt);

}  // namespace polder
