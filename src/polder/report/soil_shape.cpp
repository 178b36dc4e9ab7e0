#include "polder/report/soil_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace polder {
namespace {

constexpr double left_out = 0.005;  ///< share of the volume

/// The value below which all but `left_out` of the volume lies.
double upper_end(std::vector<std::pair<double, double>> value_and_volume) {
  std::sort(value_and_volume.begin(), value_and_volume.end(), std::greater<>());
  double total = 0;
  for (const auto& [value, volume] : value_and_volume) total += volume;
  double beyond = 0;
  for (const auto& [value, volume] : value_and_volume)
    if ((beyond += volume) > left_out * total) return value;
  return value_and_volume.back().first;
}

}  // namespace

SoilShape soil_shape(const PointSet& soil, int up) {
  SoilShape shape;
  if (soil.size() == 0) return shape;
  shape.any = true;
  const double axes = up == 2 ? 3.0 : 2.0;
  const auto end_along = [&](std::size_t axis, double sign) {
    std::vector<std::pair<double, double>> places(soil.size());
    for (std::size_t p = 0; p < soil.size(); ++p)
      places[p] = {sign * soil.position[p][axis] + std::pow(soil.volume[p], 1 / axes) / 2, soil.volume[p]};
    return sign * upper_end(std::move(places));
  };
  shape.crest = end_along(static_cast<std::size_t>(up), 1);
  shape.right = end_along(0, 1);
  shape.left = end_along(0, -1);
  if (const PointField* displacement = soil.find("displacement")) {
    std::vector<std::pair<double, double>> lengths(soil.size());
    const std::vector<double> size = magnitudes(*displacement);
    for (std::size_t p = 0; p < soil.size(); ++p) lengths[p] = {size[p], soil.volume[p]};
    shape.moved = upper_end(std::move(lengths));
  }
  return shape;
}

}  // namespace polder
