#pragma once
// Sides of an outline that follow each other and mean the same, as polylines.
#include <vector>

#include "polder/case/model.hpp"

namespace polder {

/// Joins segments [from, to] end to start, where the ends are the same point, into as few polylines as that gives.
std::vector<std::vector<Point2>> chain_sides(std::vector<std::array<Point2, 2>> segments);

}  // namespace polder
