// A cylindrical cavity that is pumped up in undrained clay. At constant volume a circle of radius R goes to
// r² = R² + Δ, Δ = a² − a0², and is sheared by γ = ln(r²/(r² − Δ)); with the shear stress min(G γ, s_u) the pressure is
//     p = ∫ 2 min(G γ, s_u)/r dr from a to the free outer radius,
// and in an endless body p = s_u [1 + ln(G/s_u (1 − a0²/a²))].
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "polder/case/geometry.hpp"
#include "polder/stability/section_from_model.hpp"
#include "polder/verify/engine.hpp"
#include "polder/verify/problem.hpp"

namespace polder::verify {

namespace {

struct Cavity {
  double radius, outer;  ///< m, at the start
  double shear, strength;

  double pressure(double a) const {
    const double growth = a * a - radius * radius, end = std::sqrt(outer * outer + growth);
    constexpr int parts = 20000;
    double sum = 0;
    const double step = std::log(end / a) / parts;  // in ln r
    for (int i = 0; i < parts; ++i) {
      const double r = a * std::exp((i + 0.5) * step), angle = std::log(r * r / (r * r - growth));
      sum += 2 * std::min(shear * angle, strength) * step;
    }
    return sum;
  }
};

Cavity cavity_of(const Model& model) {
  const MaterialInput& m = model.materials.at(0);
  const double e = stability::law_parameter(m, "young_modulus").value_or(0);
  const double nu = stability::law_parameter(m, "poisson_ratio").value_or(0);
  return {bounds(model.free_water.at(0).region.polygon).high[0], bounds(model.soils.at(0).region.polygon).high[0],
          e / (2 * (1 + nu)), stability::law_parameter(m, "undrained_shear_strength").value_or(0)};
}

Findings solve(const Source& source) {
  const Study study = source.study();
  const Cavity cavity = cavity_of(study.shipped);
  Simulation<PlaneStrain> run(study.run, 1);
  const auto& lattice = run.state().setup.lattice;
  std::vector<double> at;  // a/a0 takes the place of time
  for (const double wide : {1.1, 1.2, 1.3}) at.push_back(wide);
  Samples samples(at);
  Curve computed{"computed", {}, {}, false}, exact{"exact", {}, {}, false};
  const Boundary& pump = *std::find_if(study.run.boundaries.begin(), study.run.boundaries.end(),
                                       [](const Boundary& b) { return b.water == WaterCondition::inflow; });
  const double width = pump.span ? (*pump.span)[1] - (*pump.span)[0] : study.run.size[1];
  double volume = 0, before = run.time();
  run_case(run, [&](const auto& r) {
    volume += pump.inflow(0.5 * (before + r.time())) * width * (r.time() - before);
    before = r.time();
    const double wide = std::sqrt(1 + 4 * volume / (std::numbers::pi * cavity.radius * cavity.radius));
    double sum = 0;
    int number = 0;
    for (int j = 0; j * lattice.spacing[1] < 0.5 * cavity.radius; ++j)
      for (int i = 0; i * lattice.spacing[0] < 0.5 * cavity.radius; ++i, ++number)
        sum += r.state().grid.pressure[lattice.index(i, j)];
    const double p = sum / number / cavity.strength;
    samples.take(wide, {p});
    computed.x.push_back(wide), computed.y.push_back(p);
  });
  Findings findings;
  for (std::size_t i = 0; i < samples.rows.size(); ++i)
    findings.comparisons.push_back({"pressure", fmt::format("a/a₀ = {:g}, over s_u", at[i]),
                                    cavity.pressure(at[i] * cavity.radius) / cavity.strength, samples.rows[i][0]});
  if (findings.comparisons.empty()) findings.comparisons.push_back({"pressure", "the cavity has not grown", 1, 0});
  for (const double x : fractions(60, 1)) {
    exact.x.push_back(1 + x * (computed.x.back() - 1));
    exact.y.push_back(cavity.pressure(exact.x.back() * cavity.radius) / cavity.strength);
  }
  Chart chart{"Pressure in the cavity", "radius over that at the start", "pressure over s_u", "", "", {}, {}};
  chart.curves = {exact, thinned(computed, 300)};
  findings.figure = chart;
  return findings;
}

}  // namespace

std::vector<Problem> cylinder_problems() {
  return {{"tresca-cylinder", "A cylindrical cavity is pumped up in undrained clay",
           "Gibson and Anderson (1961), at large strains, of a body that is finite", false, solve}};
}

}  // namespace polder::verify
