#pragma once
// What an engineer asks of a failed slope: how high the crest still is, and how far the soil has run.
//
// Grains thrown out do not count: a point belongs to the body where at least two others are near it, in the square (or
// cube) of three bins of two spacings around it. The largest displacement is that of all but half a per cent of the
// mixture's volume.
#include "polder/result/frame.hpp"

namespace polder {

struct SoilShape {
  bool any = false;            ///< there is soil
  double crest = 0;            ///< m, height above y = 0 of the highest soil
  double left = 0, right = 0;  ///< m, ends of the soil along x
  double moved = 0;            ///< m, largest displacement, where the snapshot has displacements
};

/// `up` is the axis of height. Half a point's spacing is added, since a point stands for the soil around it.
SoilShape soil_shape(const PointSet& soil, int up);

/// How far the soil reaches beyond its first extent, on the side where it reaches farther; m, not negative.
double run_out(const SoilShape& first, const SoilShape& last);

}  // namespace polder
