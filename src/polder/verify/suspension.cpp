// Grains that settle in still water, one by one and as a suspension of 5 %. A grain falls at the speed at which the
// drag on a sphere carries its weight under water; a uniform suspension that no volume passes through falls, relative
// to its water, at the speed at which the drag law carries all of it: c(n, q) q = (1 − n)(ρs − ρw) g with q = n |vw −
// vs|.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "polder/case/geometry.hpp"
#include "polder/verify/engine.hpp"
#include "polder/verify/problem.hpp"

namespace polder::verify {

namespace {

/// The root of a rising function.
template <class Function>
double root(Function&& f, double low, double high) {
  for (int i = 0; i < 200; ++i) {
    const double x = 0.5 * (low + high);
    (f(x) < 0 ? low : high) = x;
  }
  return 0.5 * (low + high);
}

/// Terminal velocity of a sphere by Schiller and Naumann's coefficient, C_d = 24/Re (1 + 0.15 Re^0.687), Re < 1000.
double one_grain(const Model& model) {
  const MaterialInput& m = model.materials.at(0);
  const double d = m.grain_diameter, rho = model.water.density, mu = model.water.viscosity;
  const double weight = std::numbers::pi / 6 * d * d * d * (m.grain_density - rho) * model.gravity;
  return root(
      [&](double v) {
        const double reynolds = rho * v * d / mu, coefficient = 24 / reynolds * (1 + 0.15 * std::pow(reynolds, 0.687));
        return coefficient * 0.5 * rho * v * v * std::numbers::pi / 4 * d * d - weight;
      },
      1e-9, 10);
}

/// |vw − vs| at which the drag law carries the grains at a porosity.
double by_law(const Model& model, double n) {
  const MaterialInput& m = model.materials.at(0);
  const Drag drag = make_drag({.law = m.drag,
                               .ergun_a = m.ergun_a,
                               .ergun_b = m.ergun_b,
                               .grain_diameter = m.grain_diameter,
                               .conductivity = {},
                               .initial_porosity = m.porosity,
                               .water_density = model.water.density,
                               .viscosity = model.water.viscosity,
                               .gravity = model.gravity,
                               .exponent = {},
                               .c_k = {}});
  const double weight = (1 - n) * (m.grain_density - model.water.density) * model.gravity;
  return root([&](double q) { return drag_coefficient(drag, n, q) * q - weight; }, 1e-12, 10) / n;
}

/// Mean of |vw − vs| in the middle third of the suspension over the second half of the run.
double in_suspension(const Model& model) {
  Simulation<PlaneStrain> run(model, 1);
  const auto& lattice = run.state().setup.lattice;
  const double height = bounds(model.soils.at(0).region.polygon).high[1];
  const int low = static_cast<int>(height / 3 / lattice.spacing[1]), high = 2 * low;
  double sum = 0, span = 0, before = run.time();
  run_case(run, [&](const auto& r) {
    const double dt = r.time() - before;
    before = r.time();
    if (r.time() < 0.5 * r.end_time()) return;
    const auto& grid = r.state().grid;
    double relative = 0;
    for (int j = low; j < high; ++j)
      for (int i = 0; i < lattice.cells[0]; ++i) {
        const std::ptrdiff_t f = lattice.index(i, j);
        relative += grid.water_velocity[1][f] - grid.soil_velocity[1][f];
      }
    sum += relative / ((high - low) * lattice.cells[0]) * dt;
    span += dt;
  });
  return sum / span;
}

Findings settling(const Source& source) {
  struct Grain {
    double diameter, density, viscosity;
  };
  // the first is that of the case
  constexpr Grain others[] = {{2e-3, 2700, 8.905e-4}, {0.2e-3, 2680, 1e-3}};
  const Study study = source.study();
  const MaterialInput own = study.shipped.materials.at(0);
  std::vector<Grain> grains{{own.grain_diameter, own.grain_density, study.shipped.water.viscosity}};
  grains.insert(grains.end(), std::begin(others), std::end(others));
  Findings findings;
  Chart chart{"Settling velocity", "diameter", "velocity", "m", "m/s", {}, {}};
  Curve alone{"one grain, Schiller–Naumann", {}, {}, true};
  for (const DragLaw law : {DragLaw::gidaspow, DragLaw::beetstra}) {
    const std::string name = law == DragLaw::gidaspow ? "gidaspow" : "beetstra";
    Curve computed{"5 %, computed, " + name, {}, {}, true}, exact{"5 %, " + name, {}, {}, true};
    for (std::size_t k = 0; k < grains.size(); ++k) {
      const Grain& grain = grains[k];
      Model shipped = study.shipped, running = study.run;
      for (Model* model : {&shipped, &running}) {
        MaterialInput& m = model->materials.at(0);
        const double scale = grain.diameter / own.grain_diameter, heavier = grain.density / own.grain_density;
        m.grain_diameter *= scale, m.grain_density *= heavier;
        model->water.viscosity *= grain.viscosity / grains.front().viscosity;
        m.drag = law;
        m.max_porosity = 0.6;  // out of contact from the start
      }
      const std::string at = fmt::format("{}, D = {:g} mm", name, grain.diameter * 1e3);
      findings.comparisons.push_back({"one grain", at, one_grain(shipped), by_law(running, 1 - 1e-9), 0,
                                      law == DragLaw::gidaspow});  // Beetstra's fit holds from 10 % grains on
      const double expected = by_law(shipped, shipped.materials.at(0).porosity), found = in_suspension(running);
      findings.comparisons.push_back({"suspension of 5 %", at, expected, found});
      computed.x.push_back(grain.diameter), computed.y.push_back(found);
      exact.x.push_back(grain.diameter), exact.y.push_back(expected);
      if (law == DragLaw::gidaspow) alone.x.push_back(grain.diameter), alone.y.push_back(one_grain(shipped));
    }
    chart.curves.insert(chart.curves.end(), {exact, computed});
  }
  chart.curves.push_back(alone);
  findings.figure = chart;
  return findings;
}

}  // namespace

std::vector<Problem> suspension_problems() {
  return {{"settling-grain", "Grains settle in still water, alone and as a suspension",
           "drag on a sphere (Schiller and Naumann 1933); the drag laws of Gidaspow and Beetstra", true, settling}};
}

}  // namespace polder::verify
