// Laboratory tests on one point of a material, against closed forms for Mohr–Coulomb: drained and undrained triaxial
// compression, Rankine's earth pressures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "polder/case/element_input.hpp"
#include "polder/verify/problem.hpp"

namespace polder::verify {

namespace {

ElementInput read(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  ElementInput input = read_element_file(file.string(), overrides);
  if (!input.ok()) throw std::runtime_error(format(input.diagnostics));
  return input;
}

double parameter(const ElementMaterial& material, std::string_view key) {
  for (std::size_t i = 0; i < material.law->parameters.size(); ++i)
    if (material.law->parameters[i].key == key) return material.law_parameters[i];
  throw std::logic_error("the law has no " + std::string(key));
}

std::unique_ptr<SoilLaw> law_of(const ElementMaterial& material) {
  return material.law->make(material.law_parameters, {0, material.porosity, material.max_porosity});
}

std::vector<ElementRow> run_test(const ElementInput& input, const ElementRun& run) {
  const ElementMaterial& material = input.materials[static_cast<std::size_t>(run.material)];
  ElementResult result = run_element_test(*law_of(material), run.path, material.porosity, material.max_porosity);
  if (!result.stopped.empty()) throw std::runtime_error(result.stopped);
  return std::move(result.rows);
}

Chart stress_strain(const std::string& title, const std::vector<ElementRow>& rows, double exact) {
  Chart chart{title, "axial strain", "deviator", "", "Pa", {}, {}};
  Curve curve{"computed", {}, {}, false};
  for (const ElementRow& row : rows) curve.x.push_back(row.axial_strain), curve.y.push_back(row.deviator);
  chart.curves = {Curve{"exact at failure", {0, curve.x.back()}, {exact, exact}, false}, thinned(curve, 400)};
  return chart;
}

/// Compression from σ3 all around: q_f = (K_p − 1) σ3 + 2c√K_p, ε1 at yield q_f/E, and then dε_v/dε1 =
/// −2 sin ψ/(1 − sin ψ).
Findings triaxial_drained(const Source& source) {
  const ElementInput shipped = read(source.file, {}), input = read(source.file, source.overrides);
  const ElementMaterial& m = shipped.materials.at(0);
  const double sine = std::sin(parameter(m, "friction_angle")), dilation = std::sin(parameter(m, "dilatancy_angle"));
  const double kp = (1 + sine) / (1 - sine), confining = shipped.runs.at(0).path.vertical_stress;
  const double strength = (kp - 1) * confining + 2 * parameter(m, "cohesion") * std::sqrt(kp);
  const std::vector<ElementRow> rows = run_test(input, input.runs.at(0));
  const auto yield =
      std::find_if(rows.begin(), rows.end(), [](const ElementRow& row) { return row.plastic_shear_strain > 0; });
  const ElementRow &end = rows.back(), &before = rows[rows.size() - rows.size() / 20];
  Findings findings;
  findings.comparisons.push_back({"deviator", "failure, Pa", strength, end.deviator});
  findings.comparisons.push_back({"axial strain", "yield", strength / parameter(m, "young_modulus"),
                                  yield == rows.end() ? 0 : yield->axial_strain});
  findings.comparisons.push_back(
      {"volumetric slope", "failure", -2 * dilation / (1 - dilation),
       (end.volumetric_strain - before.volumetric_strain) / (end.axial_strain - before.axial_strain)});
  findings.figure = stress_strain("Drained triaxial compression", rows, strength);
  return findings;
}

/// ψ = 0 keeps p' at its start: q_f = 6 sin φ/(3 − sin φ) p', u_f = q_f/3.
Findings triaxial_undrained(const Source& source) {
  const ElementInput shipped = read(source.file, {}), input = read(source.file, source.overrides);
  const double sine = std::sin(parameter(shipped.materials.at(0), "friction_angle"));
  const double strength = 6 * sine / (3 - sine) * shipped.runs.at(0).path.vertical_stress;
  const std::vector<ElementRow> rows = run_test(input, input.runs.at(0));
  Findings findings;
  findings.comparisons.push_back({"deviator", "failure, Pa", strength, rows.back().deviator});
  findings.comparisons.push_back({"pore pressure", "failure, Pa", strength / 3, rows.back().pore_pressure});
  findings.figure = stress_strain("Undrained triaxial compression", rows, strength);
  return findings;
}

/// Plane strain under a held vertical stress, spread or pushed sideways until it yields: σ'h/σ'v.
double earth_pressure(const SoilLaw& law, double porosity, double vertical, double way) {
  StressBatch<4> point{};
  point.count = 1;
  point.porosity[0] = porosity;
  for (int k = 0; k < 3; ++k) point.stress[k][0] = -vertical;
  for (int step = 0; step < 20000; ++step) {
    // vertical strain from the last miss of the held stress: a first-order servo, exact once the stress is steady
    point.strain[0][0] = way * 1e-5;
    point.strain[1][0] = 0.2 * (-vertical - point.stress[1][0]) / law.constrained_modulus(vertical);
    law.update(point);
  }
  return point.stress[0][0] / point.stress[1][0];
}

Findings rankine(const Source& source) {
  const ElementInput shipped = read(source.file, {}), input = read(source.file, source.overrides);
  Findings findings;
  Chart chart{"Earth pressure coefficients", "friction angle", "σ'h/σ'v", "", "", {}, {}};
  Curve exact{"Rankine", {}, {}, false}, computed{"computed", {}, {}, true};
  for (std::size_t m = 0; m < shipped.materials.size(); ++m) {
    const double angle = parameter(shipped.materials[m], "friction_angle");
    const double active = (1 - std::sin(angle)) / (1 + std::sin(angle));
    const auto law = law_of(input.materials[m]);
    for (const double way : {1.0, -1.0}) {
      const double coefficient = way > 0 ? active : 1 / active;
      const double found = earth_pressure(*law, input.materials[m].porosity, 100e3, way);
      findings.comparisons.push_back({way > 0 ? "active coefficient" : "passive coefficient",
                                      fmt::format("φ = {:g}°", angle * 180 / std::numbers::pi), coefficient, found});
      computed.x.push_back(angle * 180 / std::numbers::pi), computed.y.push_back(found);
      exact.x.push_back(angle * 180 / std::numbers::pi), exact.y.push_back(coefficient);
    }
  }
  exact.marks = true;
  chart.curves = {exact, computed};
  findings.figure = chart;
  return findings;
}

}  // namespace

std::vector<Problem> element_problems() {
  return {{"triaxial-drained", "Drained triaxial compression of one point", "Mohr–Coulomb in closed form", true,
           triaxial_drained},
          {"triaxial-undrained", "Undrained triaxial compression of one point", "Mohr–Coulomb in closed form", true,
           triaxial_undrained},
          {"rankine", "Active and passive earth pressure", "Rankine (1857)", true, rankine}};
}

}  // namespace polder::verify
