// Steady flow through soil: a column under a given gradient (Ergun), unconfined between two reservoirs (Dupuit, exact
// for the discharge).
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

/// q under the gradient i by Ergun's law: a q + b q² = ρ g i.
double ergun_discharge(const Model& model, double i) {
  const MaterialInput& m = model.materials.at(0);
  const double n = m.porosity, phi = 1 - n, d = m.grain_diameter, weight = model.water.density * model.gravity;
  const double a = m.ergun_a * model.water.viscosity * phi * phi / (n * n * n * d * d);
  const double b = m.ergun_b * model.water.density * phi / (n * n * n * d);
  return 2 * weight * i / (a + std::sqrt(a * a + 4 * b * weight * i));
}

/// The gradient that the heads of the two sides set at a time.
double gradient_at(const Model& model, double time) {
  double left = 0, right = 0;
  for (const Boundary& b : model.boundaries) {
    if (b.water != WaterCondition::head) continue;
    (b.side == Side::left ? left : right) = b.head(time);
  }
  return (left - right) / model.size[0];
}

/// Discharge through the column at the end of each span of constant heads.
void add_column(const Study& study, const std::string& material, Findings& findings, Chart& chart) {
  const std::vector<double> ends{0.99, 1.99, 2.99};  // s, of the spans
  Samples samples(ends);
  Simulation<PlaneStrain> run(study.run, 1);
  const int middle = run.state().setup.lattice.cells[0] / 2;
  Curve computed{"computed, " + material, {}, {}, true}, exact{"Ergun, " + material, {}, {}, false};
  run_case(run,
           [&](const auto& r) { samples.take(r.time(), {column_discharge(r.state(), middle) / study.run.size[1]}); });
  for (std::size_t k = 0; k < samples.rows.size(); ++k) {
    const double i = gradient_at(study.shipped, ends[k]), q = ergun_discharge(study.shipped, i);
    findings.comparisons.push_back({"discharge", fmt::format("{}, i = {:g}", material, i), q, samples.rows[k][0]});
    computed.x.push_back(i), computed.y.push_back(samples.rows[k][0]);
  }
  for (const double i : fractions(50)) exact.x.push_back(i), exact.y.push_back(ergun_discharge(study.shipped, i));
  chart.curves.insert(chart.curves.end(), {exact, computed});
}

/// Discharge at a time after the gradient i was put on water at rest: ρ dq/dt = n (ρ g i − a q − b q²).
double starting_discharge(const Model& model, double i, double time) {
  const MaterialInput& m = model.materials.at(0);
  const double n = m.porosity, phi = 1 - n, d = m.grain_diameter, rho = model.water.density;
  const double a = m.ergun_a * model.water.viscosity * phi * phi / (n * n * n * d * d) / rho;
  const double b = m.ergun_b * phi / (n * n * n * d), root = std::sqrt(a * a + 4 * b * model.gravity * i);
  const double high = (root - a) / (2 * b), low = (-root - a) / (2 * b), decay = std::exp(-n * root * time);
  return high * (1 - decay) / (1 - high / low * decay);
}

/// The first moments, in steps that resolve them, over the relaxation time K/(n g).
void add_start(const Study& study, Findings& findings) {
  const Model& model = study.shipped;
  const MaterialInput& m = model.materials.at(0);
  const double n = m.porosity, phi = 1 - n;
  const double relaxation = model.water.density * m.grain_diameter * m.grain_diameter * n * n /
                            (m.ergun_a * model.water.viscosity * phi * phi);
  Model running = study.run;
  running.stages.at(0).duration = 2.2 * relaxation;
  constexpr double fine = 1e-4;  // s
  running.numerics.max_step = study.run.numerics.max_step < 10 * fine ? study.run.numerics.max_step : fine;
  Samples samples({0.5 * relaxation, relaxation, 2 * relaxation});
  Simulation<PlaneStrain> run(running, 1);
  const int middle = run.state().setup.lattice.cells[0] / 2;
  run_case(run,
           [&](const auto& r) { samples.take(r.time(), {column_discharge(r.state(), middle) / running.size[1]}); });
  for (std::size_t k = 0; k < samples.rows.size(); ++k)
    findings.comparisons.push_back(
        {"start", fmt::format("i = {:g}, t = {:.3g} ms", gradient_at(model, 0), samples.times[k] * 1e3),
         starting_discharge(model, gradient_at(model, 0), samples.times[k]), samples.rows[k][0]});
}

/// Two sands: the one of the case, and a fine one in water of 1 mPa s.
Findings ergun_column(const Source& source) {
  Findings findings;
  Chart chart{"Discharge over gradient", "gradient", "discharge", "", "m/s", {}, {}};
  Study study = source.study();
  add_start(study, findings);
  add_column(study, fmt::format("D = {:g} mm", study.shipped.materials.at(0).grain_diameter * 1e3), findings, chart);
  for (Model* model : {&study.shipped, &study.run}) {
    model->materials.at(0).grain_diameter *= 0.1;
    model->water.viscosity *= 1e-3 / 8.905e-4;
  }
  Chart fine = chart;
  add_column(study, fmt::format("D = {:g} mm", study.shipped.materials.at(0).grain_diameter * 1e3), findings, fine);
  findings.figure = chart;
  return findings;
}

}  // namespace

std::vector<Problem> seepage_problems() {
  const Refinement steps{"start", {"numerics.max_step=0.2 ms"}};  // of the time step
  return {
      {"ergun-column", "Flow through a column of sand under a given gradient", "Ergun (1952)", true, ergun_column,
       steps},
      {"ergun-column-single-point", "The same, water carried by the soil points", "Ergun (1952)", true, ergun_column},
      {"dupuit", "Unconfined flow through a block between two reservoirs",
       "Dupuit (1863), Charny (1951): exact for the discharge", true, dupuit}};
}

}  // namespace polder::verify
