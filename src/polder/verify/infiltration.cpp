// Rain on an unsaturated column over a water table (Srivastava and Yeh 1991): Gardner's soil, k = k_s e^{αψ}, θ = θ_r +
// (θ_s − θ_r) e^{αψ}, linear in K = e^{αψ}. With z' = αz, t' = αk_s t/(θ_s − θ_r), rain q over k_s:
//   K = q_B − (q_B − 1) e^{−z'} − 4 (q_B − q_A) e^{(L'−z')/2} e^{−t'/4} Σ sin(λz') sin(λL') e^{−λ²t'}/(1 + L'/2 +
//   2λ²L'), tan(λL') + 2λ = 0.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "polder/verify/engine.hpp"
#include "polder/verify/problem.hpp"

namespace polder::verify {

namespace {

struct Column {
  double height, rate, conductivity, before, after, drainable;  // m, 1/m, m/s, –, –, –

  /// Pressure head, m, at a height over the water table.
  double head(double z, double t) const {
    const double L = rate * height, Z = rate * z, T = rate * conductivity * t / drainable;
    double sum = 0;
    for (int i = 1; i <= 200; ++i) {  // the root between (i − ½)π/L and iπ/L
      double low = (i - 0.5) * std::numbers::pi / L * (1 + 1e-12), high = i * std::numbers::pi / L;
      for (int halving = 0; halving < 80; ++halving) {
        const double middle = 0.5 * (low + high);
        (std::tan(middle * L) + 2 * middle < 0 ? low : high) = middle;
      }
      const double a = 0.5 * (low + high);
      if (a * a * T > 60) break;
      sum += std::sin(a * Z) * std::sin(a * L) * std::exp(-a * a * T) / (1 + L / 2 + 2 * a * a * L);
    }
    const double k =
        after - (after - 1) * std::exp(-Z) - 4 * (after - before) * std::exp((L - Z) / 2) * std::exp(-T / 4) * sum;
    return std::log(k) / rate;
  }
};

Findings infiltrate(const Source& source) {
  const Study study = source.study();
  const Model& model = study.shipped;
  const double weight = model.water.density * model.gravity;
  const auto& retention = std::get<GardnerRetention>(model.retentions.at(0).retention);
  const double k = (*model.materials.at(0).permeability)[1];
  const Table& rain = model.pore_water.at(1).rate;
  const Column column{model.pore_water.at(1).line.front()[1],
                      retention.rate * weight,
                      k,
                      rain.y.front() / k,
                      rain.y.back() / k,
                      model.materials.at(0).porosity * (retention.maximum - retention.residual)};
  constexpr double hours[] = {5, 10, 30};
  Samples samples({5 * 3600.0, 10 * 3600.0, 30 * 3600.0});
  Simulation<PlaneStrain> run(study.run, 1);
  constexpr double places[] = {0.25, 0.5, 0.75, 1};
  run_case(run, [&](const auto& r) {
    const double h = r.state().setup.lattice.spacing[1];
    std::vector<double> row;
    for (const double z : places) {
      const double y = z * column.height, low = std::floor(y / h - 0.5 - 1e-9);  // cells whose centres are around it
      const double below = (std::min(low, std::round(column.height / h) - 2) + 0.5) * h;
      const auto at = [&](double height) { return r.pressure_at({0.5 * h, height, 0}) / weight; };
      row.push_back(at(below) + (y - below) / h * (at(below + h) - at(below)));
    }
    samples.take(r.time(), row);
  });
  Findings findings;
  Chart chart{"Pressure head over height", "pressure head", "height", "m", "m", {}, {}};
  for (std::size_t i = 0; i < samples.rows.size(); ++i) {
    Curve exact{fmt::format("exact, {:g} h", hours[i]), {}, {}, false}, computed{"computed", {}, {}, true};
    for (std::size_t z = 0; z < std::size(places); ++z) {
      const double y = places[z] * column.height;
      findings.comparisons.push_back({"pressure head", fmt::format("z = {:g} m, {:g} h", y, hours[i]),
                                      column.head(y, hours[i] * 3600), samples.rows[i][z]});
      computed.x.push_back(samples.rows[i][z]), computed.y.push_back(y);
    }
    for (const double z : fractions(100, 1))
      exact.x.push_back(column.head(z * column.height, hours[i] * 3600)), exact.y.push_back(z * column.height);
    chart.curves.insert(chart.curves.end(), {exact, computed});
  }
  findings.comparisons.push_back(
      {"balance of water", "30 h, of all water", 0, run.audit().water_balance_error(run.state()), 1});
  findings.figure = chart;
  return findings;
}

}  // namespace

std::vector<Problem> infiltration_problems() {
  return {{"srivastava-yeh", "Infiltration into an unsaturated column", "Srivastava and Yeh (1991)", true, infiltrate}};
}

}  // namespace polder::verify
