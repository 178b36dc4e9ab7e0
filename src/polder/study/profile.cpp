#include "polder/study/profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace polder::study {

Profile surface(const PointSet& points, int up, bool contact) {
  Profile profile;
  if (points.size() == 0) return profile;
  std::vector<double> sizes = points.volume;
  std::nth_element(sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2), sizes.end());
  const double spacing = std::pow(sizes[sizes.size() / 2], up == 2 ? 1.0 / 3 : 0.5), width = 2 * spacing;
  const PointField* fluid = contact ? points.find("liquefied") : nullptr;
  std::map<long, std::vector<double>> strips;
  for (std::size_t p = 0; p < points.size(); ++p)
    if (!fluid || fluid->values[p] < 0.5)
      strips[static_cast<long>(std::floor(points.position[p][0] / width))].push_back(
          points.position[p][static_cast<std::size_t>(up)]);
  if (strips.empty()) return profile;
  for (long k = strips.begin()->first; k <= strips.rbegin()->first; ++k) {
    double top = std::numeric_limits<double>::quiet_NaN();
    if (const auto found = strips.find(k); found != strips.end()) {
      std::vector<double>& heights = found->second;
      std::sort(heights.rbegin(), heights.rend());
      for (std::size_t i = 0; i + 2 < heights.size(); ++i) {
        if (heights[i] - heights[i + 2] > 2 * spacing) continue;
        top = heights[i] + 0.5 * spacing;
        break;
      }
    }
    profile.x.push_back((static_cast<double>(k) + 0.5) * width);
    profile.height.push_back(top);
  }
  return profile;
}

}  // namespace polder::study
