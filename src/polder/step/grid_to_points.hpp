#pragma once
// Grid to points: velocities, affine motion and positions of both phases; strain, porosity, contact and stress of the
// soil. docs/theory.md, "Step 7".
#include "polder/points/tiles.hpp"
#include "polder/step/fields.hpp"
#include "polder/step/setup.hpp"

namespace polder {

inline constexpr double possible_porosity[2] = {1e-6, 1 - 1e-6};  ///< of a soil point, at least and at most

/// Largest values met, for the choice of the next step and of the next sort.
struct Motion {
  double speed = 0;   ///< max |v_a|/h_a, 1/s
  double drift = 0;   ///< max |Δx_a|/h_a of this step
  bool sound = true;  ///< velocities, stresses and porosities that the points have got are possible ones
  void take(const Motion& other) {
    speed = speed > other.speed ? speed : other.speed;
    drift = drift > other.drift ? drift : other.drift;
    sound = sound && other.sound;
  }
};

template <class Space>
Motion grid_to_water(const Setup<Space>& setup, double dt, const GridFields<Space>& grid, const Tiling<Space>& tiling,
                     WaterPoints<Space>& water, Team& team);

/// With F-bar: a point's volume change is (1 − fbar) its own + fbar the mean of its group.
template <class Space>
Motion grid_to_soil(const Setup<Space>& setup, double dt, const GridFields<Space>& grid, const Tiling<Space>& tiling,
                    SoilPoints<Space>& soil, Team& team);

}  // namespace polder
