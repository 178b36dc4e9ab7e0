// One-dimensional consolidation under a load on the ground: Terzaghi's, and at large strains the exact solution of the
// logarithmic law dσ' = M d(ln J) with k = k0 J² (J: height of a soil element over its height at the start).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "polder/case/geometry.hpp"
#include "polder/math/units.hpp"
#include "polder/verify/engine.hpp"
#include "polder/verify/problem.hpp"

namespace polder::verify {

namespace {

/// Terzaghi's p/p0 at depth z/H and T = c_v t/H², drained at the top, and the degree of consolidation.
double terzaghi(double depth, double T) {
  double sum = 0;
  for (int m = 0; m < 400; ++m) {
    const double a = std::numbers::pi * (2 * m + 1) / 2, decay = a * a * T;
    if (decay > 40) break;
    sum += 2 / a * std::sin(a * depth) * std::exp(-decay);
  }
  return sum;
}
double degree(double T) {
  double sum = 0;
  for (int m = 0; m < 4000; ++m) {
    const double a = std::numbers::pi * (2 * m + 1) / 2, decay = a * a * T;
    if (decay > 40) break;
    sum += 2 / (a * a) * std::exp(-decay);
  }
  return 1 - sum;
}

struct Layer {
  double height, modulus, conductivity, unit_weight, porosity, load, bulk_modulus;
  double initial_pressure() const { return load / (1 + porosity * modulus / bulk_modulus); }
  double diffusivity() const { return conductivity / (unit_weight * (1 / modulus + porosity / bulk_modulus)); }
};

double parameter(const MaterialInput& material, std::string_view key) {
  const LawDescription* law = find_soil_law(material.law);
  for (std::size_t i = 0; i < law->parameters.size(); ++i)
    if (law->parameters[i].key == key) return material.law_parameters[i];
  throw std::logic_error("the law has no " + std::string(key));
}

Layer layer_of(const Model& model) {
  const MaterialInput& m = model.materials.at(0);
  const double e = parameter(m, "young_modulus"), nu = parameter(m, "poisson_ratio");
  return {bounds(model.soils.at(0).region.polygon).high[1],
          e * (1 - nu) / ((1 + nu) * (1 - 2 * nu)),
          (*m.permeability)[1],
          model.water.density * (model.gravity > 0 ? model.gravity : standard_gravity),
          m.porosity,
          model.loads.at(0).pressure(0),
          model.water.bulk_modulus};
}

/// Excess water pressure at a height over the base, rows averaged; at the base by its zero slope.
template <class Space>
double excess(const Simulation<Space>& run, const Layer& layer, double height, double gravity) {
  const auto& lattice = run.state().setup.lattice;
  const auto& pressure = run.state().grid.pressure;
  const double hydrostatic = run.model().water.density * gravity * (layer.height - height);
  if (height > 0) return mean_at_height(lattice, pressure, height) - hydrostatic;
  const double h = lattice.spacing[Space::up], slope = run.model().water.density * gravity * h;
  const double low = row_mean(lattice, pressure, 0) + 0.5 * slope, next = row_mean(lattice, pressure, 1) + 1.5 * slope;
  return low + (low - next) / 8 - hydrostatic;
}

/// Mean settlement of the surface under the load: of the points there, and of the half of their height above them.
template <class Space>
double settlement(const Stepper<Space>& state) {
  double sum = 0;
  int number = 0;
  const double half = 0.5 * state.setup.lattice.spacing[Space::up] / state.setup.points_per_axis;
  for (std::size_t p = 0; p < state.soil.size(); ++p) {
    if (state.soil.load[p] == 0) continue;
    const SoilMaterial& material = state.setup.materials[state.soil.material[p]];
    const double height = (1 - material.initial_porosity) / (1 - state.soil.porosity[p]);  // over that at the start
    sum += state.soil.reference[Space::up][p] - state.soil.position[Space::up][p] + half * (1 - height);
    ++number;
  }
  return sum / number;
}

constexpr double times[] = {0.05, 0.1, 0.2, 0.5, 1};

template <class Space>
Findings consolidate(const Study& study) {
  const Layer layer = layer_of(study.shipped);
  const double per_T = layer.height * layer.height / layer.diffusivity(), p0 = layer.initial_pressure();
  constexpr double depths[] = {0.25, 0.5, 0.75, 1};
  std::vector<double> at;
  for (const double T : times) at.push_back(T * per_T);
  Samples samples(at);
  Simulation<Space> run(study.run, 1);
  run_case(run, [&](const auto& r) {
    std::vector<double> row;
    for (const double z : depths) row.push_back(excess(r, layer, layer.height * (1 - z), study.shipped.gravity));
    row.push_back(settlement(r.state()));
    samples.take(r.time(), row);
  });
  Findings findings;
  Chart chart{"Excess pressure over depth", "excess pressure", "height", "Pa", "m", {}, {}};
  for (std::size_t i = 0; i < samples.rows.size(); ++i) {
    const double T = times[i];
    Curve exact{fmt::format("exact, T = {:g}", T), {}, {}, false}, computed{"computed", {}, {}, true};
    for (std::size_t k = 0; k < std::size(depths); ++k) {
      findings.comparisons.push_back({"pressure", fmt::format("z/H = {:g}, T = {:g}, of the load", depths[k], T),
                                      p0 * terzaghi(depths[k], T), samples.rows[i][k], layer.load});
      computed.x.push_back(samples.rows[i][k]), computed.y.push_back(layer.height * (1 - depths[k]));
    }
    for (const double z : fractions(50))
      exact.x.push_back(p0 * terzaghi(z, T)), exact.y.push_back(layer.height * (1 - z));
    const double final_settlement = layer.load / layer.modulus * layer.height;
    const double undrained = (layer.load - p0) / layer.modulus * layer.height;
    findings.comparisons.push_back({"settlement", fmt::format("T = {:g}, of its final value", T),
                                    undrained + (final_settlement - undrained) * degree(T), samples.rows[i].back(),
                                    final_settlement});
    if (T == 0.1 || T == 0.5) chart.curves.insert(chart.curves.end(), {exact, computed});
  }
  findings.figure = chart;
  return findings;
}

Findings solve_terzaghi(const Source& source) {
  const Study study = source.study();
  return study.run.space == SpaceKind::solid ? consolidate<Solid>(study) : consolidate<PlaneStrain>(study);
}

/// Clay that has no time to drain: the load is carried by the water but for a film at the top, p/p0 = erf(z/√(4 c_v
/// t)).
Findings low_permeability(const Source& source) {
  const Study study = source.study();
  const Layer layer = layer_of(study.shipped);
  const double p0 = layer.initial_pressure();
  constexpr double depths[] = {0.25, 0.5, 0.75, 1};
  Simulation<PlaneStrain> run(study.run, 1);
  std::array<double, 4> sum{}, worst{};
  double span = 0, before = run.time();
  std::array<double, 4> exact{};
  Curve curve{"computed, base", {}, {}, false};
  run_case(run, [&](const auto& r) {
    const double dt = r.time() - before;
    before = r.time();
    const bool counts = r.time() > 0.5 * r.end_time();
    if (counts) span += dt;
    for (std::size_t k = 0; k < 4; ++k) {
      const double p = excess(r, layer, layer.height * (1 - depths[k]), study.shipped.gravity);
      exact[k] = p0 * std::erf(depths[k] * layer.height / std::sqrt(4 * layer.diffusivity() * r.time()));
      if (k == 3) curve.x.push_back(r.time()), curve.y.push_back(p);
      if (!counts) continue;
      sum[k] += p * dt;
      worst[k] = std::max(worst[k], std::abs(p - exact[k]));
    }
  });
  Findings findings;
  for (std::size_t k = 0; k < 4; ++k) {
    findings.comparisons.push_back({"pressure", fmt::format("z/H = {:g}, mean of the second half", depths[k]), exact[k],
                                    sum[k] / span, layer.load});
    findings.comparisons.push_back({"oscillation", fmt::format("z/H = {:g}, largest deviation, of the load", depths[k]),
                                    0, worst[k] / layer.load, 1});
  }
  Chart chart{"Water pressure at the base", "time", "excess pressure", "s", "Pa", {}, {}};
  chart.curves = {Curve{"exact", {0, run.time()}, {p0, p0}, false}, thinned(curve, 400)};
  findings.figure = chart;
  return findings;
}

/// u = M ln[1 + (e^{q/M} − 1) P(a, T)] at material depth a, S = H0 (1 − e^{−q/M}) U(T), T = k0 M t/(γw H0²);
/// weightless.
Findings large_strain(const Source& source) {
  const Study study = source.study();
  const Layer layer = layer_of(study.shipped);
  const double strength = layer.load / layer.modulus;
  const double per_T = layer.unit_weight * layer.height * layer.height / (layer.conductivity * layer.modulus);
  constexpr double instants[] = {0.1, 0.3, 1};
  Samples samples({0.1 * per_T, 0.3 * per_T, per_T});
  Simulation<PlaneStrain> run(study.run, 1);
  std::uint64_t middle = 0;  // the point at half depth that is next to the axis
  double nearest = 1e300;
  for (std::size_t p = 0; p < run.state().soil.size(); ++p)
    if (const double d = std::abs(run.state().soil.position[1][p] - 0.5 * layer.height); d < nearest)
      nearest = d, middle = run.state().soil.id[p];
  const double depth =
      1 -
      run.state().soil.position[1][static_cast<std::size_t>(
          std::find(run.state().soil.id.begin(), run.state().soil.id.end(), middle) - run.state().soil.id.begin())] /
          layer.height;
  run_case(run, [&](const auto& r) {
    const auto& soil = r.state().soil;
    const auto p = static_cast<std::size_t>(std::find(soil.id.begin(), soil.id.end(), middle) - soil.id.begin());
    samples.take(r.time(), {excess(r, layer, 0, 0), excess(r, layer, soil.position[1][p], 0), settlement(r.state())});
  });
  Findings findings;
  Chart chart{"Settlement", "time", "settlement", "s", "m", {}, {}};
  Curve exact{"exact", {}, {}, false}, computed{"computed", {}, {}, true};
  const auto settled = [&](double T) { return layer.height * (1 - std::exp(-strength)) * degree(T); };
  const auto pressure = [&](double a, double T) {
    return layer.modulus * std::log(1 + std::expm1(strength) * terzaghi(a, T));
  };
  for (std::size_t i = 0; i < samples.rows.size(); ++i) {
    const double T = instants[i];
    const std::string at = fmt::format("T = {:g}", T);
    findings.comparisons.push_back({"settlement", at + ", of H", settled(T), samples.rows[i][2], layer.height});
    findings.comparisons.push_back(
        {"pressure", "base, " + at + ", of the load", pressure(1, T), samples.rows[i][0], layer.load});
    findings.comparisons.push_back({"pressure", "middle of the soil, " + at + ", of the load", pressure(depth, T),
                                    samples.rows[i][1], layer.load});
    computed.x.push_back(T * per_T), computed.y.push_back(samples.rows[i][2]);
  }
  for (const double T : fractions(100)) exact.x.push_back(T * per_T), exact.y.push_back(settled(T));
  chart.curves = {exact, computed};
  findings.figure = chart;
  return findings;
}

}  // namespace

std::vector<Problem> consolidation_problems() {
  constexpr const char* theory = "Terzaghi (1923), with compressible water";
  // two cells of air above the ground on the coarse grid, too: the side above would carry a part of the load
  const Refinement refinement{"pressure", {"model.cell=0.1 m", "model.size=[\"0.1 m\", \"1.2 m\"]"}};
  return {{"terzaghi", "Consolidation under a load", theory, true, solve_terzaghi, refinement},
          {"terzaghi-single-point", "Consolidation under a load, water carried by the soil points", theory, true,
           solve_terzaghi, refinement},
          {"terzaghi-3d", "Consolidation under a load, 3d", theory, false, solve_terzaghi},
          {"terzaghi-low-permeability", "Clay under a load, true stiffness of water, at the step of sand", theory, true,
           low_permeability},
          {"large-strain-consolidation", "Consolidation by 37 % of the height",
           "exact solution of the logarithmic law with k = k0 J²", false, large_strain}};
}

}  // namespace polder::verify
