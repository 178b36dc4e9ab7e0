// A bed of sand in water that flows upwards: the gradient rises with the discharge until it carries the grains
// (i_c = (1 − n)(G_s − 1)), the bed then expands until the drag carries them again.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "polder/case/geometry.hpp"
#include "polder/verify/engine.hpp"
#include "polder/verify/problem.hpp"

namespace polder::verify {

namespace {

double bed_height(const Model& model) { return bounds(model.soils.at(0).region.polygon).high[1]; }

double critical_gradient(const Model& model, double n) {
  return (1 - n) * (model.materials.at(0).grain_density / model.water.density - 1);
}

/// Ergun's gradient at a discharge and a porosity.
double ergun_gradient(const Model& model, double n, double q) {
  const MaterialInput& m = model.materials.at(0);
  const double phi = 1 - n, d = m.grain_diameter;
  const double viscous = m.ergun_a * model.water.viscosity * phi * phi / (n * n * n * d * d);
  const double inertial = m.ergun_b * model.water.density * phi / (n * n * n * d);
  return (viscous * q + inertial * q * q) / (model.water.density * model.gravity);
}

/// The root of a decreasing function.
template <class Function>
double root(Function&& f, double low, double high) {
  for (int i = 0; i < 200; ++i) {
    const double x = 0.5 * (low + high);
    (f(x) > 0 ? low : high) = x;
  }
  return 0.5 * (low + high);
}

const Boundary& inflow_of(const Model& model) {
  return *std::find_if(model.boundaries.begin(), model.boundaries.end(),
                       [](const Boundary& b) { return b.water == WaterCondition::inflow; });
}

/// Head lost from the base to the water above the bed, over the bed's height at the start. Over all of the bed: where a
/// layer in it has opened, its grains rest on those below, and within these the gradient is larger by what they carry.
double gradient_over_bed(const Simulation<PlaneStrain>& run, double height) {
  const auto& state = run.state();
  const double weight = run.model().water.density * run.model().gravity, above = 1.2 * height;
  const double drop = mean_at_height(state.setup.lattice, state.grid.pressure, 0) -
                      mean_at_height(state.setup.lattice, state.grid.pressure, above);
  return (drop / weight - above) / height;
}

/// The discharge rises slowly past fluidisation: the plateau of the gradient, and the discharge at which it is reached.
Findings critical(const Source& source) {
  const Study study = source.study();
  const Model& model = study.shipped;
  const double n = model.materials.at(0).porosity, height = bed_height(model), exact = critical_gradient(model, n);
  const double minimum = root([&](double q) { return exact - ergun_gradient(model, n, q); }, 0, 1);
  Simulation<PlaneStrain> run(study.run, 1);
  const Table& inflow = inflow_of(study.run).inflow;
  Chart chart{"Gradient over discharge", "discharge", "gradient", "m/s", "", {}, {}};
  Curve computed{"computed", {}, {}, false}, law{"Ergun, then i_c", {}, {}, false};
  double plateau = 0, span = 0, before = run.time(), reached = 0, last_q = 0, last_i = 0;
  run_case(run, [&](const auto& r) {
    const double q = inflow(r.time()), i = gradient_over_bed(r, height), dt = r.time() - before;
    before = r.time();
    computed.x.push_back(q), computed.y.push_back(i);
    // where the gradient passes 95 % of i_c: there the bed is still as it was, and Ergun's law gives the discharge
    if (reached == 0 && i > 0.95 * exact) reached = last_q + (0.95 * exact - last_i) / (i - last_i) * (q - last_q);
    last_q = q, last_i = i;
    if (q > 1.02 * minimum && q < 1.08 * minimum) plateau += i * dt, span += dt;
  });
  const double at_95 = root([&](double q) { return 0.95 * exact - ergun_gradient(model, n, q); }, 0, 1);
  Findings findings;
  findings.comparisons.push_back(
      {"gradient", "1.02 to 1.08 of the minimum discharge, over i_c", 1, span > 0 ? plateau / span / exact : 0});
  findings.comparisons.push_back({"minimum discharge", "from 95 % of i_c, m/s", minimum, minimum * reached / at_95});
  for (const double q : computed.x) law.x.push_back(q), law.y.push_back(std::min(exact, ergun_gradient(model, n, q)));
  chart.curves = {thinned(law, 300), thinned(computed, 300)};
  findings.figure = chart;
  return findings;
}

/// Mean porosity of the bed's points, over the last quarter of the time, at a constant multiple of the minimum
/// discharge. The height follows: H/H0 = (1 − n0)/(1 − n).
Findings expansion(const Source& source) {
  const Study study = source.study();
  const Model& model = study.shipped;
  const double n0 = model.materials.at(0).porosity;
  Findings findings;
  Chart chart{"Height of the bed", "time", "height over that at the start", "s", "", {}, {}};
  for (const double multiple : {1.0, 2.0}) {
    Model shipped = model, running = study.run;
    for (Model* m : {&shipped, &running})
      for (Boundary& b : m->boundaries)
        for (double& q : b.inflow.y) q *= multiple;
    const double q = inflow_of(shipped).inflow.y.back();
    const double n =
        root([&](double x) { return ergun_gradient(model, x, q) - critical_gradient(model, x); }, n0, 0.95);
    Simulation<PlaneStrain> run(running, 1);
    Curve computed{fmt::format("computed, q = {:.3g} mm/s", q * 1e3), {}, {}, false};
    double sum = 0, span = 0, before = run.time();
    run_case(run, [&](const auto& r) {
      const auto& soil = r.state().soil;
      double volume = 0, solid = 0;
      for (std::size_t p = 0; p < soil.size(); ++p) {
        const double s = soil.mass[p] / model.materials.at(0).grain_density;
        solid += s;
        volume += s / (1 - soil.porosity[p]);
      }
      const double dt = r.time() - before, height = volume / solid * (1 - n0);
      before = r.time();
      computed.x.push_back(r.time()), computed.y.push_back(height);
      if (r.time() > 0.75 * r.end_time()) sum += height * dt, span += dt;
    });
    const double exact = (1 - n0) / (1 - n);
    findings.comparisons.push_back(
        {"height", fmt::format("q = {:.4g} mm/s, over that at the start", q * 1e3), exact, sum / span});
    chart.curves.push_back({"Ergun", {0, run.time()}, {exact, exact}, false});
    chart.curves.push_back(thinned(computed, 300));
  }
  findings.figure = chart;
  return findings;
}

}  // namespace

std::vector<Problem> fluidisation_problems() {
  return {
      {"critical-gradient", "A bed of sand is lifted by water that flows upwards",
       "weight of the grains in water; Ergun (1952)", true, critical},
      {"fluidisation", "The same with a coarse sand", "weight of the grains in water; Ergun (1952)", false, critical},
      {"bed-expansion", "A fluidised bed expands until the drag carries the grains", "Ergun (1952) at each porosity",
       false, expansion}};
}

}  // namespace polder::verify
