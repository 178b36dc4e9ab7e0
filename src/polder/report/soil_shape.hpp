#pragma once
// What an engineer asks of a failed slope: how high the crest still is, and how far the soil has run.
//
// All are taken over the soil points without the outermost half per cent of the mixture's volume on the side in
// question, so that single grains thrown out do not count.
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

}  // namespace polder
