#include "polder/seepage/flow_reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "polder/seepage/flow_results.hpp"

namespace polder {
namespace {

struct NamedFlow {
  std::string name;
  double in = 0, out = 0;  // m²/s
  double steepest = 0;
  Point2 where{0, 0};
};

// Boundaries of one name together. A node where two boundaries meet counts once, for that with a given head.
std::vector<NamedFlow> by_name(const FlowSolver& solver, const FlowState& state) {
  std::vector<NamedFlow> all;
  std::set<int> counted;
  const auto& boundaries = solver.problem().boundaries;
  for (const bool heads : {true, false})
    for (std::size_t b = 0; b < boundaries.size(); ++b) {
      if ((boundaries[b].condition == FlowCondition::head) != heads) continue;
      auto named =
          std::find_if(all.begin(), all.end(), [&](const NamedFlow& n) { return n.name == boundaries[b].name; });
      if (named == all.end()) named = all.insert(all.end(), NamedFlow{boundaries[b].name, 0, 0, 0, {0, 0}});
      const int index = static_cast<int>(b);
      for (const int n : solver.boundary_nodes(index).node)
        if (counted.insert(n).second) (state.outflow[n] < 0 ? named->in : named->out) += std::abs(state.outflow[n]);
      const ExitFlow exit = exit_flow(solver, state, index);
      for (std::size_t i = 0; i < exit.at.size(); ++i)
        if (exit.gradient[i] > named->steepest) named->steepest = exit.gradient[i], named->where = exit.at[i];
    }
  return all;
}

}  // namespace

std::vector<FlowValue> read_flow(const Model& model, const FlowSolver& solver, const FlowState& state) {
  std::vector<FlowValue> values;
  const auto add = [&](const char* quantity, std::string at, double value, const char* unit) {
    values.push_back({quantity, std::move(at), state.time, value, unit});
  };
  for (const NamedFlow& named : by_name(solver, state)) {
    if (named.in > 0) add("inflow", named.name, named.in, "m2/s");
    if (named.out > 0) add("outflow", named.name, named.out, "m2/s");
    if (named.out > 0 && named.steepest > 0)
      add("exit gradient", fmt::format("{} ({:.3g}, {:.3g}) m", named.name, named.where[0], named.where[1]),
          named.steepest, "");
  }
  const MeshLocator locator(*solver.problem().mesh);
  for (const Monitor& monitor : model.monitors) {
    if (monitor.kind == MonitorKind::section && monitor.at.size() == 2) {
      const Point2 ends[] = {{monitor.at[0][0], monitor.at[0][1]}, {monitor.at[1][0], monitor.at[1][1]}};
      add("discharge", monitor.name, discharge_through(solver, state, ends), "m2/s");
    }
    if (monitor.kind == MonitorKind::surface && monitor.quantity == "water-surface")
      for (const Point3& p : monitor.at)
        if (const auto table = phreatic_height(solver, state, p[0]))
          add("water table", fmt::format("{} (x = {:.3g} m)", monitor.name, p[0]), *table, "m");
    if (monitor.kind != MonitorKind::point) continue;
    for (const Point3& p : monitor.at) {
      const auto place = locator.find({p[0], p[1]});
      if (place.triangle < 0) continue;
      const std::string at = fmt::format("{} ({:.3g}, {:.3g}) m", monitor.name, p[0], p[1]);
      add("head", at, interpolate(*solver.problem().mesh, state.head, place), "m");
      if (const auto table = phreatic_height(solver, state, p[0])) add("water table", at, *table, "m");
    }
  }
  return values;
}

}  // namespace polder
