// Steady flow through soil: unconfined between two reservoirs (Dupuit, exact for the discharge).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "polder/case/geometry.hpp"
#include "polder/verify/engine.hpp"
#include "polder/verify/problem.hpp"

namespace polder::verify {

namespace {

/// Mean discharge (m²/s) through the faces of column `i`, of all cells that are wet beside it.
double column_discharge(const Stepper<PlaneStrain>& state, int i) {
  const auto& lattice = state.setup.lattice;
  double flow = 0;
  for (int j = 0; j < lattice.cells[1]; ++j) {
    const std::ptrdiff_t f = lattice.index(i, j);
    if (!state.grid.reached[0][f]) continue;
    const double fill = std::min(1.0, 0.5 * (state.grid.fill[f] + state.grid.fill[f - 1]));
    flow += fill * state.grid.porosity[0][f] * state.grid.water_velocity[0][f] * lattice.spacing[1];
  }
  return flow;
}

Findings dupuit(const Source& source) {
  const Study study = source.study();
  const Model& model = study.shipped;
  const Bounds dam = bounds(model.soils.at(0).region.polygon);
  double high = 0, low = 0;
  for (const Boundary& b : model.boundaries) {
    if (b.water != WaterCondition::reservoir) continue;
    (bounds(b.region.polygon).high[0] <= dam.low[0] + 1e-9 ? high : low) = b.head(0);
  }
  const double length = dam.high[0] - dam.low[0], conductivity = (*model.materials.at(0).permeability)[0];
  const double exact = conductivity * (high * high - low * low) / (2 * length);

  Simulation<PlaneStrain> run(study.run, 1);
  const auto& lattice = run.state().setup.lattice;
  const int first = static_cast<int>(std::lround(dam.low[0] / lattice.spacing[0]));
  const int last = static_cast<int>(std::lround(dam.high[0] / lattice.spacing[0]));
  double sum = 0, span = 0, before = run.time();
  Chart chart{"Unconfined flow between two reservoirs", "time", "discharge", "s", "m2/s", {}, {}};
  Curve curve{"computed, middle of the block", {}, {}, false};
  run_case(run, [&](const auto& r) {
    const double flow = column_discharge(r.state(), (first + last) / 2), dt = r.time() - before;
    before = r.time();
    curve.x.push_back(r.time()), curve.y.push_back(flow);
    if (r.time() < 0.75 * r.end_time()) return;
    sum += flow * dt;
    span += dt;
  });
  Findings findings;
  findings.comparisons.push_back({"discharge", "mean of the last quarter, middle of the block", exact, sum / span});
  chart.curves = {Curve{"Dupuit", {0, run.time()}, {exact, exact}, false}, thinned(curve, 400)};
  findings.figure = chart;
  return findings;
}

}  // namespace

std::vector<Problem> seepage_problems() {
  return {{"dupuit", "Unconfined flow through a block between two reservoirs",
           "Dupuit (1863), Charny (1951): exact for the discharge", true, dupuit}};
}

}  // namespace polder::verify
