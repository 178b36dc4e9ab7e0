#pragma once
// Whether the state of a run can be one at all: finite values, points inside the model, indices that exist.
#include <string>

#include "polder/step/stepper.hpp"

namespace polder {

/// The first point that has a value which is not finite, has left the model, or has a porosity, mass or volume that
/// cannot be: "soil point 12 at (0.5, 0.2): its velocity is not finite". Empty: there is none.
template <class Space>
std::string unsound_point(const Stepper<Space>& state);

/// The same after a step, whose transfers have looked at what they gave the points while they had it at hand: only the
/// rest is looked through.
template <class Space>
std::string unsound_point_after_step(const Stepper<Space>& state, Team& team);

/// The first point outside the model, likewise. Takes a fraction of the time: positions only.
template <class Space>
std::string escaped_point(const Stepper<Space>& state);

/// What would lead a step astray in a state that comes from a file: arrays of different lengths, indices beyond their
/// tables, unsound points. Empty: nothing. `sorted`: the points are said to lie in the order of their homes.
template <class Space>
std::string flaw_of(Stepper<Space>& state, bool sorted);

}  // namespace polder
