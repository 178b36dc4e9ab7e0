// A bar that is held at one end and swings in its first mode, v = V0 sin(πx/2L) at the start: period 4L/c with
// c = √(E/ρ), tip displacement V0/ω, and its energy stays what it was.
#include <cmath>
#include <numbers>

#include "polder/case/geometry.hpp"
#include "polder/verify/engine.hpp"
#include "polder/verify/problem.hpp"

namespace polder::verify {

namespace {

constexpr double start_speed = 0.1;  // m/s, of the tip

double parameter(const MaterialInput& material, std::string_view key) {
  const LawDescription* law = find_soil_law(material.law);
  for (std::size_t i = 0; i < law->parameters.size(); ++i)
    if (law->parameters[i].key == key) return material.law_parameters[i];
  return 0;
}

/// Gives every point the velocity, and the affine motion, of the first mode.
void set_swinging(double length, SoilPoints<PlaneStrain>& soil) {
  const double k = std::numbers::pi / (2 * length);
  for (std::size_t p = 0; p < soil.size(); ++p) {
    soil.velocity[0][p] = start_speed * std::sin(k * soil.position[0][p]);
    soil.affine[0][p] = start_speed * k * std::cos(k * soil.position[0][p]);
  }
}

/// Kinetic and elastic energy, J/m, of points that are strained along x only.
double energy_of(const SoilPoints<PlaneStrain>& soil, double grain_density, double modulus) {
  double sum = 0;
  for (std::size_t p = 0; p < soil.size(); ++p) {
    const double volume = soil.mass[p] / (grain_density * (1 - soil.porosity[p])), stress = soil.stress[0][p];
    sum += 0.5 * soil.mass[p] * soil.velocity[0][p] * soil.velocity[0][p] + 0.5 * volume * stress * stress / modulus;
  }
  return sum;
}

Findings bar(const Source& source) {
  const Study study = source.study();
  const MaterialInput& m = study.shipped.materials.at(0);
  const Bounds box = bounds(study.shipped.soils.at(0).region.polygon);
  const double length = box.high[0] - box.low[0], modulus = parameter(m, "young_modulus");
  const double density = (1 - m.porosity) * m.grain_density;
  const double frequency = std::numbers::pi / (2 * length) * std::sqrt(modulus / density);
  const double period = 2 * std::numbers::pi / frequency;

  Simulation<PlaneStrain> run(study.run, 1);
  auto& soil = run.state().soil;
  set_swinging(length, soil);
  run.begin_anew();
  const MaterialInput& running = study.run.materials.at(0);
  const double spacing = run.state().setup.lattice.spacing[0] / run.state().setup.points_per_axis;
  std::vector<std::size_t> tip;  // ids of the points at the free end
  for (std::size_t p = 0; p < soil.size(); ++p)
    if (soil.position[0][p] > box.high[0] - spacing) tip.push_back(soil.id[p]);
  const double reach = std::sin(std::numbers::pi / (2 * length) * (length - 0.5 * spacing));  // of the mode, there

  Chart chart{"Displacement of the tip", "time", "displacement", "s", "m", {}, {}};
  Curve computed{"computed", {0}, {0}, false}, exact{"exact", {}, {}, false};
  double most = 0, energy = 0;
  std::vector<double> zeros;
  run_case(run, [&](const auto& r) {
    const auto& now = r.state().soil;
    double sum = 0;
    for (std::size_t p = 0; p < now.size(); ++p)
      if (std::find(tip.begin(), tip.end(), now.id[p]) != tip.end()) sum += now.position[0][p] - now.reference[0][p];
    const double u = sum / static_cast<double>(tip.size()) / reach, last = computed.y.back(), t = computed.x.back();
    if (last != 0 && (last > 0) != (u > 0)) zeros.push_back(t + last / (last - u) * (r.time() - t));
    computed.x.push_back(r.time()), computed.y.push_back(u);
    most = std::max(most, u);
    energy = energy_of(now, running.grain_density, parameter(running, "young_modulus"));
  });
  Findings findings;
  findings.comparisons.push_back(
      {"period", "twice the time of the first return, s", period, zeros.empty() ? 0 : 2 * zeros.front()});
  findings.comparisons.push_back({"displacement", "tip, first swing, m", start_speed / frequency, most});
  const double at_start = 0.25 * density * start_speed * start_speed * length * (box.high[1] - box.low[1]);
  findings.comparisons.push_back({"energy", "after a period, J/m", at_start, energy});
  for (const double t : computed.x)
    exact.x.push_back(t), exact.y.push_back(start_speed / frequency * std::sin(frequency * t));
  chart.curves = {thinned(exact, 300), thinned(computed, 300)};
  findings.figure = chart;
  return findings;
}

}  // namespace

std::vector<Problem> bar_problems() {
  return {{"bar", "A bar swings in its first mode", "first mode of the wave equation", true, bar}};
}

}  // namespace polder::verify
