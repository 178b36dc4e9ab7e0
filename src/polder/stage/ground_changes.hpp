#pragma once
// What a stage does to the ground as it begins: soil that is excavated, placed, or becomes another material.
#include <vector>

#include "polder/case/model.hpp"
#include "polder/step/stepper.hpp"

namespace polder {

/// What changes have brought and taken, for the balances.
struct ChangedMass {
  double solid_in = 0, solid_out = 0;  ///< kg of grains
  std::vector<Exchange> water;
};

/// The law's own state of the points from number `first` on, by their stress and porosity.
template <class Space>
void start_law_state(const Setup<Space>& setup, std::size_t first, SoilPoints<Space>& soil);

/// Ids of soil that is there at the start are below this.
template <class Space>
std::uint64_t first_placed_id(const Model& model, const Lattice<Space>& lattice);

/// All changes of the stage with this number, in the order of the case. Soil is placed on the sites of the seeding
/// lattice that no soil point is on, at rest, with the stress that `initial.stress` asks for by its own weight; its
/// grains take the place of water that is there.
template <class Space>
ChangedMass change_ground(const Model& model, std::size_t stage, Stepper<Space>& state);

}  // namespace polder
