// A pressure wave in saturated soil: c = √((M + K_w/n)/ρ_sat) where drag holds water and grains together. A step of
// load on the drained top of a column; the pressure behind the front is q (K_w/n)/(M + K_w/n), twice that after its
// reflection at the base.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "polder/case/geometry.hpp"
#include "polder/verify/engine.hpp"
#include "polder/verify/problem.hpp"

namespace polder::verify {

namespace {

Findings wave(const Source& source) {
  const Study study = source.study();
  const Model& model = study.shipped;
  const MaterialInput& m = model.materials.at(0);
  const double height = bounds(model.soils.at(0).region.polygon).high[1], load = model.loads.at(0).pressure(1);
  const auto law = find_soil_law(m.law)->make(m.law_parameters, {0, m.porosity, m.max_porosity});
  const double modulus = law->constrained_modulus(0), water = model.water.bulk_modulus / m.porosity;
  const double density = (1 - m.porosity) * m.grain_density + m.porosity * model.water.density;
  const double speed = std::sqrt((modulus + water) / density), plateau = load * water / (modulus + water);

  Simulation<PlaneStrain> run(study.run, 1);
  const auto& lattice = run.state().setup.lattice;
  const double gamma = model.water.density * model.gravity;
  Curve middle{"computed, middle", {}, {}, false}, base{"computed, base", {}, {}, false};
  run_case(run, [&](const auto& r) {
    const auto& pressure = r.state().grid.pressure;
    middle.x.push_back(r.time()), base.x.push_back(r.time());
    middle.y.push_back(mean_at_height(lattice, pressure, 0.5 * height) - gamma * 0.5 * height);
    base.y.push_back(row_mean(lattice, pressure, 0) - gamma * (height - 0.5 * lattice.spacing[1]));
  });
  const auto arrival = [](const Curve& curve, double level) {
    for (std::size_t i = 1; i < curve.x.size(); ++i)
      if (curve.y[i] >= level)
        return curve.x[i - 1] +
               (level - curve.y[i - 1]) / (curve.y[i] - curve.y[i - 1]) * (curve.x[i] - curve.x[i - 1]);
    return 0.0;
  };
  const auto at = [](const Curve& curve, double time) {
    const auto i = static_cast<std::size_t>(std::lower_bound(curve.x.begin(), curve.x.end(), time) - curve.x.begin());
    return curve.y.at(std::min(i, curve.y.size() - 1));
  };
  Findings findings;
  findings.comparisons.push_back(
      {"arrival", "middle, half of the plateau, s", 0.5 * height / speed, arrival(middle, 0.5 * plateau)});
  findings.comparisons.push_back({"arrival", "base, half of the plateau, s", height / speed, arrival(base, plateau)});
  // the solution with this drag (k = 1e-3 m/s, two-phase theory), from the reference numbers
  constexpr struct {
    double time, middle, base;
  } table[] = {{.004, 946.6, 0}, {.008, 998.3, 1975.4}, {.012, 1994.0, 1996.3}, {.02, 926.7, 119.8}};
  const auto compare = [&](const char* place, const Curve& curve, double time, double exact) {
    const bool on_plateau = exact > 0.9 * load;  // judged by its own height; the others by the load
    findings.comparisons.push_back({"pressure",
                                    fmt::format("{}, {:g} ms{}", place, time * 1e3, on_plateau ? "" : ", of the load"),
                                    exact, at(curve, time), on_plateau ? exact : load});
  };
  for (const auto& row : table) {
    compare("middle", middle, row.time, row.middle);
    compare("base", base, row.time, row.base);
  }
  Chart chart{"A step of load on saturated soil", "time", "excess pressure", "s", "Pa", {}, {}};
  Curve points{"exact, middle", {}, {}, true}, points_base{"exact, base", {}, {}, true};
  for (const auto& row : table) {
    points.x.push_back(row.time), points.y.push_back(row.middle);
    points_base.x.push_back(row.time), points_base.y.push_back(row.base);
  }
  chart.curves = {thinned(middle, 400), thinned(base, 400), points, points_base};
  findings.figure = chart;
  return findings;
}

}  // namespace

std::vector<Problem> wave_problems() {
  return {
      {"wave", "A pressure wave in saturated soil", "two-phase theory (Biot 1956), true stiffness of water", true,
       wave},
      {"wave-single-point", "The same, water carried by the soil points", "two-phase theory (Biot 1956)", true, wave}};
}

}  // namespace polder::verify
