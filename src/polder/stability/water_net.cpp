#include "polder/stability/water_net.hpp"

#include <algorithm>

#include "polder/stability/lines.hpp"

namespace polder::stability {

double pore_pressure(const WaterNet& net, double x, double z, double ground) {
  if (net.phreatic.empty()) return 0;
  const double table = level(net.phreatic, x);
  if (z >= table) return -std::min(net.max_suction, net.unit_weight * (z - table));

  // The nearest reference lines over and under the point; of coinciding ones the first drawn counts.
  const ReferenceLine* over = nullptr;
  const ReferenceLine* under = nullptr;
  double z_over = 0, z_under = 0;
  for (const ReferenceLine& reference : net.references) {
    if (!covers(reference.line, x)) continue;
    const double at = level(reference.line, x);
    if (at >= z && (over == nullptr || at < z_over)) over = &reference, z_over = at;
    if (at < z && (under == nullptr || at > z_under)) under = &reference, z_under = at;
  }
  const auto head = [&](const Line& line) { return line.empty() ? table : level(line, x); };
  // Above the first reference line the net hangs on the phreatic line, or on the ground where free water stands on it.
  const double top = over != nullptr ? z_over : std::min(table, ground);
  const double at_top = net.unit_weight * ((over != nullptr ? head(over->head_below) : table) - top);
  double pressure = at_top + net.unit_weight * (top - z);
  if (under != nullptr && z < top) {
    const double at_base = net.unit_weight * (head(under->head_above) - z_under);
    pressure = at_top + (top - z) / (top - z_under) * (at_base - at_top);
  }
  return std::max(pressure, -net.max_suction);
}

double pore_pressure(const PressureGrid& grid, double max_suction, double x, double z) {
  const double i = std::clamp((x - grid.corner[0]) / grid.spacing_x, 0.0, grid.count_x - 1.000001);
  const double j = std::clamp((z - grid.corner[1]) / grid.spacing_z, 0.0, grid.count_z - 1.000001);
  const auto column = static_cast<std::size_t>(i), row = static_cast<std::size_t>(j);
  const double u = i - static_cast<double>(column), v = j - static_cast<double>(row);
  const double* below = &grid.pressure[row * static_cast<std::size_t>(grid.count_x) + column];
  const double* above = below + grid.count_x;
  const double pressure = (1 - v) * ((1 - u) * below[0] + u * below[1]) + v * ((1 - u) * above[0] + u * above[1]);
  return std::max(pressure, -max_suction);
}

}  // namespace polder::stability
