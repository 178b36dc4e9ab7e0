// Water that is dragged into motion between two plates, laminar: Poiseuille's flow, driven by a body force, and
// Couette's, driven by one of the plates. Both start from rest.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "polder/verify/engine.hpp"
#include "polder/verify/problem.hpp"

namespace polder::verify {

namespace {

constexpr double instants[] = {0.02, 0.05, 0.1, 0.2, 0.5};  // ν t/h²

/// u/u_max half-way between the plates, u_max = g h²/(8ν).
double poiseuille(double T) {
  double sum = 0;
  for (int m = 0; m < 200; ++m) {
    const double a = (2 * m + 1) * std::numbers::pi;
    sum += (m % 2 == 0 ? 32 : -32) / (a * a * a) * std::exp(-a * a * T);
  }
  return 1 - sum;
}

/// u/U half-way between a plate at rest and one with the velocity U.
double couette(double T) {
  double u = 0.5;
  for (int m = 1; m < 400; ++m) {
    const double a = m * std::numbers::pi;
    u += 2 * (m % 2 == 0 ? 1 : -1) / a * std::sin(a / 2) * std::exp(-a * a * T);
  }
  return u;
}

Findings channel(const Source& source, double (*exact)(double), double (*scale)(const Model&), const char* title) {
  const Study study = source.study();
  const Model& model = study.shipped;
  const double height = model.size[1], nu = model.water.viscosity / model.water.density, full = scale(model);
  std::vector<double> at;
  for (const double T : instants) at.push_back(T * height * height / nu);
  Samples samples(at);
  Simulation<PlaneStrain> run(study.run, 1);
  const auto& lattice = run.state().setup.lattice;
  Curve computed{"computed", {}, {}, false}, curve{"exact", {}, {}, false};
  run_case(run, [&](const auto& r) {
    const double u = row_mean(lattice, r.state().grid.water_velocity[0], lattice.cells[1] / 2);
    samples.take(r.time(), {u});
    computed.x.push_back(r.time()), computed.y.push_back(u);
  });
  Findings findings;
  for (std::size_t i = 0; i < samples.rows.size(); ++i)
    findings.comparisons.push_back({"velocity", fmt::format("half-way, νt/h² = {:g}, of the last", instants[i]),
                                    exact(instants[i]), samples.rows[i][0] / full, 1});
  for (const double x : fractions(100))
    curve.x.push_back(x * run.time()), curve.y.push_back(full * exact(x * run.time() * nu / height / height));
  Chart chart{title, "time", "velocity half-way", "s", "m/s", {}, {}};
  chart.curves = {curve, thinned(computed, 300)};
  findings.figure = chart;
  return findings;
}

Findings solve_poiseuille(const Source& source) {
  const auto scale = [](const Model& m) {
    return m.gravity * std::sin(m.tilt) * m.size[1] * m.size[1] * m.water.density / (8 * m.water.viscosity);
  };
  return channel(source, poiseuille, scale, "Flow between two plates, driven by gravity");
}

Findings solve_couette(const Source& source) {
  const auto scale = [](const Model& m) {
    for (const Boundary& b : m.boundaries)
      if (!b.slide.y.empty()) return b.slide(0);
    return 0.0;
  };
  return channel(source, couette, scale, "Flow between two plates, one of which moves");
}

}  // namespace

std::vector<Problem> channel_problems() {
  const Refinement refinement{"velocity", {"model.cell=15 mm"}, 3, 1.8};
  return {{"poiseuille", "Water starts to flow between two plates", "Poiseuille flow from rest, a Fourier series", true,
           solve_poiseuille, refinement},
          {"couette", "Water between two plates, one of which starts to move",
           "Couette flow from rest, a Fourier series", true, solve_couette, refinement}};
}

}  // namespace polder::verify
