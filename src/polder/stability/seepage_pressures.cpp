#include "polder/stability/seepage_pressures.hpp"

#include <algorithm>
#include <cmath>

#include "polder/case/geometry.hpp"
#include "polder/seepage/flow_results.hpp"
#include "polder/stability/lines.hpp"

namespace polder::stability {

void take_pressures(const FlowSolver& solver, const FlowState& state, double spacing, Section& section) {
  const Mesh& mesh = *solver.problem().mesh;
  const Bounds box = bounds(mesh.nodes);
  const Point2 &low = box.low, &high = box.high;

  PressureGrid grid;
  grid.corner = low;
  grid.count_x = static_cast<int>(std::ceil((high[0] - low[0]) / spacing)) + 1;
  grid.count_z = static_cast<int>(std::ceil((high[1] - low[1]) / spacing)) + 1;
  grid.spacing_x = (high[0] - low[0]) / (grid.count_x - 1);
  grid.spacing_z = (high[1] - low[1]) / (grid.count_z - 1);
  const std::vector<double> nodal = polder::pore_pressure(solver, state);
  const MeshLocator locator(mesh);
  // Samples on the outline may fall a hair outside of every triangle.
  const auto within = [&](double value, std::size_t k) {
    const double hair = 1e-7 * (high[k] - low[k]);
    return std::clamp(value, low[k] + hair, high[k] - hair);
  };
  for (int j = 0; j < grid.count_z; ++j) {
    for (int i = 0; i < grid.count_x; ++i) {
      const Point2 at{within(low[0] + i * grid.spacing_x, 0), within(low[1] + j * grid.spacing_z, 1)};
      const MeshLocator::Place place = locator.find(at);
      grid.pressure.push_back(place.triangle < 0 ? 0.0 : interpolate(mesh, nodal, place));
    }
  }

  section.water.phreatic.clear();
  std::vector<double> xs;
  xs.reserve(static_cast<std::size_t>(grid.count_x));
  for (int i = 0; i < grid.count_x; ++i) xs.push_back(within(low[0] + i * grid.spacing_x, 0));
  const auto heights = phreatic_heights(solver, state, xs);
  for (std::size_t i = 0; i < xs.size(); ++i) section.water.phreatic.push_back({xs[i], heights[i].value_or(low[1])});
  section.water.phreatic = simplified(section.water.phreatic, spacing / 20);
  section.water.references.clear();
  section.water.unit_weight = solver.problem().unit_weight;
  section.pressures = std::move(grid);
}

}  // namespace polder::stability
