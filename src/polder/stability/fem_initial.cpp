// Initial stress from the weight above (K0), without displacement.
#include <algorithm>
#include <cmath>

#include "polder/stability/fem_solver.hpp"

namespace polder {
namespace {

/// Where the vertical through x crosses a triangle: from, to (from > to: not at all).
std::array<double, 2> vertical_chord(const Mesh& mesh, int triangle, double x) {
  const auto& t = mesh.triangles[triangle];
  std::array<double, 2> chord{1e300, -1e300};
  for (int i = 0; i < 3; ++i) {
    const Point2 &a = mesh.nodes[t[i]], &b = mesh.nodes[t[(i + 1) % 3]];
    if ((a[0] > x) == (b[0] > x)) continue;
    const double y = a[1] + (x - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
    chord = {std::min(chord[0], y), std::max(chord[1], y)};
  }
  return chord;
}

}  // namespace

FemState FemSolver::k0(const FemAction& action, const std::function<double(int material)>& k0) const {
  const Mesh& mesh = *problem_.mesh;
  FemState state = unstressed();
  double low = 1e300, high = -1e300;
  for (const auto& p : mesh.nodes) low = std::min(low, p[0]), high = std::max(high, p[0]);
  const int columns = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(mesh.triangles.size()))));
  const auto column = [&](double x) {
    return std::clamp(static_cast<int>((x - low) / (high - low) * columns), 0, columns - 1);
  };
  std::vector<std::vector<int>> buckets(columns);
  std::vector<double> weight(mesh.triangles.size());
  for (int e = 0; e < static_cast<int>(mesh.triangles.size()); ++e) {
    const auto& t = mesh.triangles[e];
    const auto [from, to] = std::minmax({mesh.nodes[t[0]][0], mesh.nodes[t[1]][0], mesh.nodes[t[2]][0]});
    for (int c = column(from); c <= column(to); ++c) buckets[c].push_back(e);
    const FemMaterial& m = problem_.materials[mesh.region[e]];
    const double p = value_at(mesh, action.pore_pressure, e, {1.0 / 3, 1.0 / 3, 1.0 / 3});
    const double s = action.pore_pressure.empty() ? 0.0 : saturation(m.retention, -p);
    weight[e] = action.weight * (m.dry_unit_weight + m.porosity * s * problem_.water_unit_weight);
  }
  const MeshLocator locator(mesh);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point2& at = points_[i].position;
    double total = 0, top = at[1];
    for (const int e : buckets[column(at[0])]) {
      const auto chord = vertical_chord(mesh, e, at[0]);
      total += weight[e] * std::max(0.0, chord[1] - std::max(chord[0], at[1]));
      top = std::max(top, chord[1]);
    }
    const auto surface = locator.find({at[0], top - 1e-6 * (std::abs(top) + high - low)});
    if (surface.triangle >= 0)
      total += std::max(0.0, value_at(mesh, action.pore_pressure, surface.triangle, surface.weight));
    const int material = mesh.region[i / 3];
    const double p = value_at(mesh, action.pore_pressure, static_cast<int>(i / 3), points_[i].weight);
    const double s = saturation(problem_.materials[material].retention, -p);
    const double vertical = -(total - (p >= 0 ? p : problem_.suction ? s * p : 0.0));
    const double horizontal = k0(material) * vertical;
    state.stress[i] = {horizontal, vertical, horizontal, 0};
  }
  return state;
}

}  // namespace polder
