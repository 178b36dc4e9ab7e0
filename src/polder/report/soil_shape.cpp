#include "polder/report/soil_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

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

using Bin = std::array<std::int64_t, 3>;

/// Which points belong to the body (soil_shape.hpp).
std::vector<bool> in_body(const PointSet& soil, double axes) {
  constexpr int least = 3;  // itself included
  double volume = 0;
  for (const double v : soil.volume) volume += v;
  const double side = 2 * std::pow(volume / static_cast<double>(soil.size()), 1 / axes);
  const auto bin_of = [&](const Point3& x) {
    Bin bin;
    for (std::size_t k = 0; k < 3; ++k) bin[k] = static_cast<std::int64_t>(std::floor(x[k] / side));
    return bin;
  };
  std::map<Bin, int> count;
  for (const Point3& x : soil.position) ++count[bin_of(x)];
  const std::int64_t across = axes == 3 ? 1 : 0;
  std::vector<bool> member(soil.size());
  for (std::size_t p = 0; p < soil.size(); ++p) {
    const Bin bin = bin_of(soil.position[p]);
    int near = 0;
    for (std::int64_t i = -1; i <= 1; ++i)
      for (std::int64_t j = -1; j <= 1; ++j)
        for (std::int64_t k = -across; k <= across; ++k) {
          const auto found = count.find({bin[0] + i, bin[1] + j, bin[2] + k});
          if (found != count.end()) near += found->second;
        }
    member[p] = near >= least;
  }
  return member;
}

}  // namespace

SoilShape soil_shape(const PointSet& soil, int up) {
  SoilShape shape;
  if (soil.size() == 0) return shape;
  const double axes = up == 2 ? 3.0 : 2.0;
  const std::vector<bool> member = in_body(soil, axes);
  for (std::size_t p = 0; p < soil.size(); ++p) {
    if (!member[p]) continue;
    const double half = std::pow(soil.volume[p], 1 / axes) / 2;
    const double x = soil.position[p][0], top = soil.position[p][static_cast<std::size_t>(up)] + half;
    shape.crest = shape.any ? std::max(shape.crest, top) : top;
    shape.left = shape.any ? std::min(shape.left, x - half) : x - half;
    shape.right = shape.any ? std::max(shape.right, x + half) : x + half;
    shape.any = true;
  }
  if (const PointField* displacement = soil.find("displacement")) {
    std::vector<std::pair<double, double>> lengths(soil.size());
    const std::vector<double> size = magnitudes(*displacement);
    for (std::size_t p = 0; p < soil.size(); ++p) lengths[p] = {size[p], soil.volume[p]};
    shape.moved = upper_end(std::move(lengths));
  }
  return shape;
}

double run_out(const SoilShape& first, const SoilShape& last) {
  return std::max({0.0, last.right - first.right, first.left - last.left});
}

}  // namespace polder
