#include "polder/stage/seepage_start.hpp"

#include <cmath>
#include <limits>

#include "polder/seepage/flow_results.hpp"
#include "polder/seepage/model_flow.hpp"

namespace polder {

namespace {

std::vector<double> centres(const GridAxis& axis, int count) {
  std::vector<double> x;
  x.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) x.push_back(axis.centre(i));
  return x;
}

/// Pressures at the centres of the cells of a column, from below: in the ground as computed, else as still water from
/// the nearest cell below (or above) that has one.
std::vector<double> column_of(const Mesh& mesh, const std::vector<double>& nodal, const MeshLocator& locator, double x,
                              const std::vector<double>& heights, double unit_weight) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> p;
  for (const double y : heights) {
    const MeshLocator::Place place = locator.find({x, y});
    p.push_back(place.triangle < 0 ? none : interpolate(mesh, nodal, place));
  }
  for (std::size_t j = 1; j < p.size(); ++j)
    if (std::isnan(p[j])) p[j] = p[j - 1] - unit_weight * (heights[j] - heights[j - 1]);
  for (std::size_t j = p.size(); j-- > 1;)
    if (std::isnan(p[j - 1])) p[j - 1] = p[j] + unit_weight * (heights[j] - heights[j - 1]);
  for (double& value : p)
    if (std::isnan(value)) value = 0;  // no ground in this column
  return p;
}

}  // namespace

Model with_steady_seepage(const Model& given) {
  Model model = given;
  if (!model.initial_seepage) return model;
  SeepageInput input;
  input.retentions = model.retentions;
  input.conditions = model.pore_water;
  const ModelFlow flow = model_flow(model, input);
  const FlowSolver solver(flow.problem());
  const FlowState state = solver.steady(0);

  const GridAxis across = grid_axis(model, 0), upwards = grid_axis(model, 1);
  const std::vector<double> x = centres(across, across.cells()), y = centres(upwards, upwards.cells());
  const std::vector<std::optional<double>> table = phreatic_heights(solver, state, x);
  model.water_table.clear();
  for (std::size_t i = 0; i < x.size(); ++i) model.water_table.push_back({x[i], table[i].value_or(0)});
  if (!model.unsaturated) return model;
  const std::vector<double> nodal = pore_pressure(solver, state);
  const MeshLocator locator(flow.mesh);
  for (const double at : x)
    for (const double p : column_of(flow.mesh, nodal, locator, at, y, flow.unit_weight))
      model.start_pressure.push_back(p);
  return model;
}

}  // namespace polder
