// Mandel's slab (1953): soil between two rigid smooth plates, a constant force on them, drained at both ends. The water
// pressure in the middle rises before it falls, for the ends soften first and the load moves inwards. Here one quarter
// of it, and the plates move as they do in the exact solution (a table in the case); that their force is constant is a
// result.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "polder/case/geometry.hpp"
#include "polder/math/units.hpp"
#include "polder/stability/section_from_model.hpp"
#include "polder/verify/engine.hpp"
#include "polder/verify/problem.hpp"

namespace polder::verify {

namespace {

/// Incompressible water and grains: Skempton's B = 1, undrained ν = ½.
struct Slab {
  double half_width, height;
  double young, poisson, diffusivity;
  double stress;  ///< Pa, the force on a plate over its area

  double undrained_pressure() const { return 0.5 * stress; }

  /// Roots of tan α/α = (1 − ν)/(½ − ν), one past each multiple of π.
  double root(int k) const {
    const double ratio = (1 - poisson) / (0.5 - poisson);
    double low = k * std::numbers::pi + (k == 0 ? 1e-9 : 0), high = (k + 0.5) * std::numbers::pi - 1e-12;
    for (int i = 0; i < 200; ++i) {
      const double a = 0.5 * (low + high);
      (std::tan(a) < ratio * a ? low : high) = a;
    }
    return 0.5 * (low + high);
  }

  /// Pressure over that of the undrained start, at x/a.
  double pressure(double x, double T) const {
    double sum = 0;
    for (int k = 0; k < 60; ++k) {
      const double a = root(k), weight = std::sin(a) / (a - std::sin(a) * std::cos(a));
      sum += weight * (std::cos(a * x) - std::cos(a)) * std::exp(-a * a * T);
    }
    return 2 * sum;
  }

  /// Way of a plate towards the middle plane, m.
  double way(double T) const {
    const double shear = young / (2 * (1 + poisson));
    double sum = 0;
    for (int k = 0; k < 60; ++k) {
      const double a = root(k);
      sum += std::sin(a) * std::cos(a) / (a - std::sin(a) * std::cos(a)) * std::exp(-a * a * T);
    }
    return stress / shear * ((1 - poisson) / 2 - 0.5 * sum) * height;
  }
};

const Table& push_of(const Model& model) {
  for (const Boundary& b : model.boundaries)
    if (!b.push.y.empty()) return b.push;
  throw std::runtime_error("no side of this case pushes");
}

/// ∫ of a table from 0 to its end.
double integral(const Table& table) {
  double sum = 0;
  for (std::size_t i = 1; i < table.x.size(); ++i)
    sum += 0.5 * (table.y[i] + table.y[i - 1]) * (table.x[i] - table.x[i - 1]);
  return sum;
}

Slab slab_of(const Model& model) {
  const MaterialInput& m = model.materials.at(0);
  const Bounds box = bounds(model.soils.at(0).region.polygon);
  const double e = stability::law_parameter(m, "young_modulus").value_or(0);
  const double nu = stability::law_parameter(m, "poisson_ratio").value_or(0);
  const double modulus = e * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
  const double weight = model.water.density * (model.gravity > 0 ? model.gravity : standard_gravity);
  Slab slab{box.high[0], box.high[1], e, nu, (*m.permeability)[0] * modulus / weight, 1};
  const Table& push = push_of(model);
  const double T = push.x.back() * slab.diffusivity / (slab.half_width * slab.half_width);
  slab.stress = integral(push) / slab.way(T);  // the force that moves the plates so far
  return slab;
}

/// Mean total pressure on the upper plate: of the points in the upper row of cells, and of the water there.
double plate_pressure(const Simulation<PlaneStrain>& run, const Slab& slab) {
  const auto& state = run.state();
  const auto& lattice = state.setup.lattice;
  const int top = lattice.cells[1] - 1;
  double sum = 0, number = 0, water = 0;
  for (std::size_t p = 0; p < state.soil.size(); ++p) {
    if (state.soil.position[1][p] < top * lattice.spacing[1]) continue;
    sum -= state.soil.stress[1][p];
    ++number;
  }
  const int cells = static_cast<int>(std::lround(slab.half_width / lattice.spacing[0]));
  for (int i = 0; i < cells; ++i) water += state.grid.pressure[lattice.index(i, top)];
  return sum / number + water / cells;
}

Findings mandel(const Source& source) {
  const Study study = source.study();
  const Slab slab = slab_of(study.shipped);
  constexpr double instants[] = {0.01, 0.05, 0.1, 0.5};
  std::vector<double> at;
  const double per_T = slab.half_width * slab.half_width / slab.diffusivity;
  for (const double T : instants) at.push_back(T * per_T);
  Samples samples(at);
  Simulation<PlaneStrain> run(study.run, 1);
  const auto& lattice = run.state().setup.lattice;
  Curve computed{"computed", {}, {}, false}, exact{"Mandel", {}, {}, false};
  run_case(run, [&](const auto& r) {
    const auto column = [&](int i) {
      double sum = 0;
      for (int j = 0; j < lattice.cells[1]; ++j) sum += r.state().grid.pressure[lattice.index(i, j)];
      return sum / lattice.cells[1];
    };
    const double middle = column(0) + (column(0) - column(1)) / 8;  // its slope there is zero
    samples.take(r.time(), {middle, plate_pressure(r, slab)});
    computed.x.push_back(r.time() / per_T), computed.y.push_back(middle / slab.undrained_pressure());
  });
  Findings findings;
  for (std::size_t i = 0; i < samples.rows.size(); ++i) {
    const std::string T = fmt::format("T = {:g}", instants[i]);
    findings.comparisons.push_back({"pressure", "middle, " + T + ", over the undrained", slab.pressure(0, instants[i]),
                                    samples.rows[i][0] / slab.undrained_pressure()});
    findings.comparisons.push_back(
        {"plate", "mean pressure, " + T + ", over the constant one", 1, samples.rows[i][1] / slab.stress});
  }
  for (const double x : fractions(200, 1))
    exact.x.push_back(x * run.time() / per_T), exact.y.push_back(slab.pressure(0, x * run.time() / per_T));
  Chart chart{"Water pressure in the middle", "T", "over the undrained pressure", "", "", {}, {}};
  chart.curves = {exact, thinned(computed, 400)};
  findings.figure = chart;
  return findings;
}

}  // namespace

std::vector<Problem> mandel_problems() {
  return {{"mandel", "A slab between rigid plates drains at its ends", "Mandel (1953), incompressible water", true,
           mandel, Refinement{"pressure", {"model.cell=0.1 m"}}}};
}

}  // namespace polder::verify
