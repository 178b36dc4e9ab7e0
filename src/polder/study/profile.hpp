#pragma once
// The surface of soil and water along x in a snapshot, as a photograph would show it.
#include <optional>
#include <vector>

#include "polder/result/frame.hpp"

namespace polder::study {

struct Profile {
  std::vector<double> x, height;  ///< m; NaN where there is nothing
};

/// Heights of the highest points in strips along x, two point spacings wide; `contact`: of soil whose grains are in
/// contact. Points with fewer than two others in the strip within two spacings below or above do not count.
Profile surface(const PointSet& points, int up, bool contact);

}  // namespace polder::study
