// Waves that meet absorbing sides: the share of a pulse's energy that is left when all of it should have gone, and what
// is left in the same time where the sides are closed.
#include <algorithm>
#include <cmath>
#include <limits>

#include "polder/verify/engine.hpp"
#include "polder/verify/problem.hpp"

namespace polder::verify {

namespace {

struct Elastic {
  double modulus, young, poisson;  // M and E, Pa
};

Elastic elastic_of(const MaterialInput& m) {
  const LawDescription* law = find_soil_law(m.law);
  Elastic e{law->make(m.law_parameters, {0, m.porosity, m.max_porosity})->constrained_modulus(0), 0, 0};
  for (std::size_t k = 0; k < law->parameters.size(); ++k) {
    if (law->parameters[k].key == "young_modulus") e.young = m.law_parameters[k];
    if (law->parameters[k].key == "poisson_ratio") e.poisson = m.law_parameters[k];
  }
  return e;
}

/// J per metre: of motion, of the grains' stress, of the water's pressure.
double energy(const Simulation<PlaneStrain>& run, const Elastic& e) {
  const auto& state = run.state();
  const auto& soil = state.soil;
  const double rho = state.setup.water.density;
  double sum = 0;
  for (std::size_t p = 0; p < soil.size(); ++p) {
    double square = 0, trace = 0;
    for (int s = 0; s < PlaneStrain::stress; ++s) square += (s < 3 ? 1 : 2) * std::pow(soil.stress[s][p], 2);
    for (int a = 0; a < 3; ++a) trace += soil.stress[a][p];
    const double volume = soil.mass[p] / state.setup.materials[soil.material[p]].grain_density / (1 - soil.porosity[p]);
    sum += 0.5 * soil.mass[p] * speed_squared(soil, p) +
           0.5 * volume / e.young * ((1 + e.poisson) * square - e.poisson * trace * trace);
  }
  for (std::size_t p = 0; p < state.water.size(); ++p)
    sum += 0.5 * rho * state.water.volume[p] * speed_squared(state.water, p);
  over_all_cells(state.setup.lattice, [&](std::ptrdiff_t cell, const std::array<int, 3>&) {
    if (state.grid.wet[cell])
      sum += 0.5 * state.grid.cell_porosity[cell] * state.setup.lattice.cell_volume() *
             std::pow(state.grid.pressure[cell], 2) / state.setup.water.bulk_modulus;
  });
  return sum;
}

/// Runs a Gaussian pulse of velocity (unit direction `across`) in the middle of the model for twice the time that a
/// wave of `speed` takes to the sides; the share of its energy that is left.
double left_of_pulse(Model model, double speed, const std::array<double, 2>& direction, double width, Curve& curve) {
  const Elastic e = elastic_of(model.materials.at(0));
  const Point2 middle{0.5 * model.size[0], 0.5 * model.size[1]};
  model.stages.at(0).duration = model.size[0] / speed;
  Simulation<PlaneStrain> run(model, 1);
  const bool bar = model.size[1] < 0.1 * model.size[0];
  const auto shake = [&](auto& points) {
    for (std::size_t p = 0; p < points.size(); ++p) {
      const double x = points.position[0][p] - middle[0], y = bar ? 0 : points.position[1][p] - middle[1];
      for (std::size_t a = 0; a < 2; ++a)
        points.velocity[a][p] = 0.01 * direction[a] * std::exp(-(x * x + y * y) / (width * width));
    }
  };
  shake(run.state().soil);
  shake(run.state().water);
  const double start = energy(run, e);
  // step by step, past the guards: the pulse was given after they had taken the energy of the start
  const double end = model.size[0] / speed;
  StepControl control;
  while (control.time < end * (1 - 1e-9)) {
    const double dt = std::min(run.state().natural_step(), end - control.time);
    control.time += dt;
    run.state().advance(control, dt);
    curve.x.push_back(control.time / end);
    curve.y.push_back(energy(run, e) / start);
  }
  return curve.y.back();
}

Model with_sides(Model model, SoilCondition condition, bool all) {
  for (Boundary& b : model.boundaries)
    if (b.side == Side::left || b.side == Side::right || all) b.soil = condition;
  return model;
}

Findings absorbing(const Source& source) {
  const Study study = source.study();
  const Model& bar = study.run;
  const MaterialInput& m = bar.materials.at(0);
  const Elastic e = elastic_of(m);
  const double dry = (1 - m.porosity) * m.grain_density, wet = dry + m.porosity * bar.water.density;
  const double shear = e.young / (2 * (1 + e.poisson));
  Model dry_bar = bar;
  dry_bar.water_table.clear();
  dry_bar.numerics.max_step = std::numeric_limits<double>::infinity();
  Model square = dry_bar;
  square.size = {8, 8, 0};
  square.soils.at(0).region.polygon = {{0, 0}, {8, 0}, {8, 8}, {0, 8}};

  Findings findings;
  Chart chart{"A pulse between absorbing sides",
              "time over that to cross the model",
              "energy over that of the pulse",
              "",
              "",
              {},
              {}};
  const auto compare = [&](const char* at, const Model& model, double speed, std::array<double, 2> direction,
                           double width, bool all) {
    Curve open{std::string(at) + ", absorbing", {}, {}, false}, shut{std::string(at) + ", closed", {}, {}, false};
    const double left = left_of_pulse(with_sides(model, SoilCondition::absorbing, all), speed, direction, width, open);
    left_of_pulse(with_sides(model, SoilCondition::roller, all), speed, direction, width, shut);
    findings.comparisons.push_back({"energy left", at, 0, left, 1});
    findings.comparisons.push_back({"energy left by closed sides", at, 1, shut.y.back(), 1});
    chart.curves.push_back(thinned(open, 300));
    chart.curves.push_back(thinned(shut, 300));
  };
  compare("bar of saturated soil", bar, std::sqrt((e.modulus + bar.water.bulk_modulus / m.porosity) / wet), {1, 0}, 1.5,
          false);
  compare("bar of dry soil", dry_bar, std::sqrt(e.modulus / dry), {1, 0}, 1.5, false);
  compare("square of dry soil", square, std::sqrt(shear / dry), {0, 1}, 0.8, true);
  findings.figure = chart;
  return findings;
}

}  // namespace

std::vector<Problem> far_field_problems() {
  return {{"absorbing", "Waves that leave through absorbing sides", "no energy comes back from an endless ground", true,
           absorbing}};
}

}  // namespace polder::verify
