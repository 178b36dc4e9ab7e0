#pragma once
// Friction of soil that slides along thin walls: on each side of a face of a wall the soil's effective pressure on it,
// times tan δ and the face, is the most that its motion along the wall can be resisted with.
#include "polder/points/point_sets.hpp"
#include "polder/step/fields.hpp"
#include "polder/step/setup.hpp"

namespace polder {

/// Slows the soil's velocity on the faces along the walls, at most to rest. After the pressure has acted.
template <class Space>
void rub_along_walls(const Setup<Space>& setup, double dt, const SoilPoints<Space>& soil, GridFields<Space>& grid);

}  // namespace polder
