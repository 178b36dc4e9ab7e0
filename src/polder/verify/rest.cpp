// Water, and soil under water, at rest: p = ρ g z, σ'v = γ' z, and nothing moves.
#include <algorithm>
#include <cmath>
#include <map>

#include "polder/case/geometry.hpp"
#include "polder/verify/engine.hpp"
#include "polder/verify/problem.hpp"

namespace polder::verify {

namespace {

struct Heights {
  double water = 0, soil = 0;  // m
};

Heights heights_of(const Model& model) {
  Heights h;
  for (const FreeWaterBody& w : model.free_water) h.water = std::max(h.water, bounds(w.region.polygon).high[1]);
  for (const SoilBody& s : model.soils) h.soil = std::max(h.soil, bounds(s.region.polygon).high[1]);
  for (const Point2& p : model.water_table) h.water = std::max(h.water, p[1]);
  return h;
}

/// Largest error of the mean effective vertical stress of a row of cells, of the largest exact value. Single points
/// scatter with their jitter (the weights of irregular points); a row carries what lies above it.
template <class Space>
double stress_error(const Model& model, const Stepper<Space>& state, double top) {
  constexpr int up = Space::up;
  std::map<int, std::array<double, 3>> rows;  // computed, exact, number
  double largest = 0;
  for (std::size_t p = 0; p < state.soil.size(); ++p) {
    const MaterialInput& m = model.materials[state.soil.material[p]];
    const double submerged = (1 - m.porosity) * (m.grain_density - model.water.density) * model.gravity;
    auto& row = rows[static_cast<int>(state.soil.position[up][p] / state.setup.lattice.spacing[up])];
    row[0] += state.soil.stress[up][p];
    row[1] -= submerged * (top - state.soil.position[up][p]);
    row[2] += 1;
    largest = submerged * top;
  }
  double most = 0;
  for (const auto& [level, row] : rows) most = std::max(most, std::abs(row[0] - row[1]) / row[2] / largest);
  return most;
}

template <class Space>
Findings solve_in(const Study& study) {
  constexpr int up = Space::up;
  Simulation<Space> run(study.run, 1);
  run_case(run, [](const auto&) {});
  const Model& model = study.shipped;
  const auto& state = run.state();
  const auto& lattice = state.setup.lattice;
  const Heights top = heights_of(model);
  const double gamma = model.water.density * model.gravity, base = gamma * top.water;
  Chart chart{"Water pressure over height", "pressure", "height", "Pa", "m", {}, {}};
  Curve exact{"exact", {0, base}, {top.water, 0}, false}, computed{"computed", {}, {}, true};
  double squares = 0;
  int cells = 0;
  for (std::ptrdiff_t row = 0; row < lattice.row_count(); ++row)
    for (int i = 0; i < lattice.cells[0]; ++i) {
      const int at[3] = {i, static_cast<int>(row % lattice.cells[1]), static_cast<int>(row / lattice.cells[1])};
      const double height = (at[up] + 0.5) * lattice.spacing[up];
      if (height > top.water) continue;
      const double p = state.grid.pressure[lattice.index(at[0], at[1], at[2])];
      const double error = p - gamma * (top.water - height);
      squares += error * error;
      ++cells;
      if (i == 0 && (Space::axes == 2 || at[1] == 0)) computed.x.push_back(p), computed.y.push_back(height);
    }
  chart.curves = {exact, computed};
  Findings findings;
  findings.comparisons.push_back({"pressure", "rms of cells, of ρgH", 0, std::sqrt(squares / cells) / base, 1});
  findings.comparisons.push_back(
      {"speed", "fastest point, of √(gH)", 0, fastest_point(state) / std::sqrt(model.gravity * top.water), 1});
  if (state.soil.size() > 0)
    findings.comparisons.push_back(
        {"effective stress", "worst row of cells, of γ'H", 0, stress_error(model, state, top.soil), 1});
  findings.figure = chart;
  return findings;
}

Findings solve(const Source& source) {
  const Study study = source.study();
  return study.run.space == SpaceKind::solid ? solve_in<Solid>(study) : solve_in<PlaneStrain>(study);
}

}  // namespace

std::vector<Problem> rest_problems() {
  constexpr const char* theory = "hydrostatics; effective stress of submerged soil";
  return {{"hydrostatic", "Water at rest in a tank", theory, true, solve, Refinement{"pressure", {"model.cell=0.1 m"}}},
          {"hydrostatic-jump", "Water at rest above a submerged bed, points jittered", theory, true, solve},
          {"hydrostatic-single-point", "Saturated soil at rest, water carried by the soil points", theory, true, solve},
          {"hydrostatic-3d", "Water at rest in a tank, 3d", theory, true, solve}};
}

}  // namespace polder::verify
