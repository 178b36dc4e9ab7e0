// The generalised vortex: a ring of a neo-Hookean body in which every circle turns by its own angle α(R, t), to and
// fro, so that material is sheared by up to 6 and turned by up to a radian while its shape stays. Manufactured: the
// body force that makes it so follows from the momentum balance,
//     b_r = (G/ρ) R α'² − R α̇²,    b_θ = R α̈ − (G/ρ)(3α' + R α''),
// with α = sin(πt) [1 − 32 (R − 1)² + 256 (R − 1)⁴] between R = 0.75 and 1.25, and 0 elsewhere.
#include <cmath>
#include <numbers>

#include "polder/stability/section_from_model.hpp"
#include "polder/verify/engine.hpp"
#include "polder/verify/problem.hpp"

namespace polder::verify {

namespace {

constexpr double inner = 0.75, outer = 1.25;  // m

/// The bracket of α and its derivatives in R.
struct Shape {
  double value = 0, slope = 0, curvature = 0;

  explicit Shape(double radius) {
    if (radius <= inner || radius >= outer) return;
    const double s = radius - 1;
    value = 1 - 32 * s * s + 256 * s * s * s * s;
    slope = -64 * s + 1024 * s * s * s;
    curvature = -64 + 3072 * s * s;
  }
};

struct Vortex {
  double x, y;   ///< m, the middle
  double ratio;  ///< G/ρ, m²/s²

  double body_force(int component, const std::array<double, 3>& at, double time) const {
    const double dx = at[0] - x, dy = at[1] - y, radius = std::hypot(dx, dy);
    const Shape f(radius);
    if (f.value == 0 && f.slope == 0) return 0;
    const double pi = std::numbers::pi, swing = std::sin(pi * time), rate = pi * std::cos(pi * time);
    const double radial = ratio * radius * std::pow(swing * f.slope, 2) - radius * std::pow(rate * f.value, 2);
    const double around = -radius * pi * pi * swing * f.value - ratio * swing * (3 * f.slope + radius * f.curvature);
    return (component == 0 ? radial * dx - around * dy : radial * dy + around * dx) / radius;
  }
};

Findings solve(const Source& source) {
  const Study study = source.study();
  const Model& model = study.shipped;
  const MaterialInput& m = model.materials.at(0);
  const double young = stability::law_parameter(m, "young_modulus").value_or(0);
  const double poisson = stability::law_parameter(m, "poisson_ratio").value_or(0);
  const Vortex vortex{0.5 * model.size[0], 0.5 * model.size[1],
                      young / (2 * (1 + poisson)) / ((1 - m.porosity) * m.grain_density)};
  Simulation<PlaneStrain> run(study.run, 1);
  auto& soil = run.state().soil;
  for (std::size_t p = 0; p < soil.size(); ++p) {  // v = π f(R) (−y, x) about the middle
    const double dx = soil.position[0][p] - vortex.x, dy = soil.position[1][p] - vortex.y, radius = std::hypot(dx, dy);
    const Shape f(radius);
    const double turn = std::numbers::pi * f.value, slope = std::numbers::pi * f.slope / std::max(radius, 1e-9);
    soil.velocity[0][p] = -turn * dy;
    soil.velocity[1][p] = turn * dx;
    soil.affine[0][p] = -slope * dx * dy;
    soil.affine[1][p] = -turn - slope * dy * dy;
    soil.affine[2][p] = turn + slope * dx * dx;
    soil.affine[3][p] = slope * dx * dy;
  }
  run.begin_anew();
  run.body_force = [&](int component, const std::array<double, 3>& at, double time) {
    return vortex.body_force(component, at, time);
  };
  run_case(run, [](const auto&) {});

  double squares = 0;
  std::size_t number = 0;
  const double swing = std::sin(std::numbers::pi * run.time());
  Curve exact{"exact", {}, {}, false}, computed{"computed", {}, {}, true};
  for (std::size_t p = 0; p < soil.size(); ++p) {
    const double X = soil.reference[0][p] - vortex.x, Y = soil.reference[1][p] - vortex.y, radius = std::hypot(X, Y);
    if (radius < inner || radius > outer) continue;
    const double angle = swing * Shape(radius).value, c = std::cos(angle), s = std::sin(angle);
    const double dx = soil.position[0][p] - vortex.x - (c * X - s * Y),
                 dy = soil.position[1][p] - vortex.y - (s * X + c * Y);
    squares += dx * dx + dy * dy;
    ++number;
    if (std::abs(Y) < 0.5 * model.cell[1] && X > 0) {
      const double at = std::atan2(soil.position[1][p] - vortex.y, soil.position[0][p] - vortex.x) - std::atan2(Y, X);
      computed.x.push_back(radius), computed.y.push_back(at);
    }
  }
  for (const double x : fractions(100))
    exact.x.push_back(inner + x * (outer - inner)), exact.y.push_back(swing * Shape(exact.x.back()).value);
  Findings findings;
  findings.comparisons.push_back({"displacement", "rms of the ring, of its largest", 0,
                                  std::sqrt(squares / static_cast<double>(number)) / (2 * std::sin(0.5 * swing)), 1,
                                  false});
  Chart chart{"Turn of the ring's circles", "radius", "angle", "m", "rad", {}, {}};
  chart.curves = {exact, computed};
  findings.figure = chart;
  return findings;
}

}  // namespace

std::vector<Problem> vortex_problems() {
  return {{"vortex", "A ring of an elastic body is turned to and fro", "manufactured solution", false, solve,
           Refinement{"displacement", {"model.cell=0.1 m", "numerics.max_step=2 ms"}, 2, 1.8}}};
}

}  // namespace polder::verify
