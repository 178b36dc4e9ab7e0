#include "polder/stability/sliding_area.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "polder/case/geometry.hpp"

namespace polder {

double sliding_area(const Mesh& mesh, std::span<const double> displacement) {
  const auto [low, high] = bounds(mesh.nodes);
  const MeshLocator locator(mesh);
  std::vector<double> size(mesh.nodes.size());
  for (std::size_t n = 0; n < size.size(); ++n) size[n] = std::hypot(displacement[2 * n], displacement[2 * n + 1]);
  constexpr int columns = 200, rows = 200;
  const double dx = (high[0] - low[0]) / columns, dy = (high[1] - low[1]) / rows;
  double area = 0;
  for (int i = 0; i < columns; ++i) {
    std::vector<double> profile;  // from the top of the ground down
    for (int j = rows; j-- > 0;) {
      const auto place = locator.find({low[0] + (i + 0.5) * dx, low[1] + (j + 0.5) * dy});
      if (place.triangle >= 0) profile.push_back(interpolate(mesh, size, place));
    }
    if (profile.empty()) continue;
    auto at = std::max_element(profile.begin(), profile.end());
    const double half = *at / 2;
    at = std::find_if(at, profile.end(), [&](double u) { return u < half; });
    area += static_cast<double>(at - profile.begin()) * dx * dy;
  }
  return area;
}

}  // namespace polder
