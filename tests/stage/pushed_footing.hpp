#pragma once
// A smooth strip, 1 m wide, that is pushed into weightless clay of 10 kPa: it bears (2 + π) s_u.
#include <cmath>
#include <string>

#include "case_text.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {

inline const double bearing_of_clay = (2 + std::acos(-1.0)) * 10e3;  // N/m of strip

/// Further keys of the model and of the clay, which has no Poisson's ratio and nothing for water by itself.
inline Model pushed_footing(const std::string& model_keys, const std::string& clay_keys) {
  return read_text(R"(
[model]
size = ["6 m", "2.6 m"]
cell = "0.1 m"
gravity = "0 m/s2"
)" + model_keys + R"(
[[material]]
name = "clay"
law = "tresca"
young_modulus = "5 MPa"
undrained_shear_strength = "10 kPa"
grain_density = "2650 kg/m3"
porosity = 0.4
)" + clay_keys + R"(
[[soil]]
material = "clay"
box = [[0, 0], [6, 2]]
[initial]
stress = "none"
[[wall]]
name = "footing"
box = [[2.5, 2], [3.5, 2.5]]
velocity_upward = [["0 s", "0 m/s"], ["0.2 s", "-0.1 m/s"]]
[[boundary]]
side = "base"
soil = "rough"
[[monitor]]
name = "footing"
kind = "wall"
wall = "footing"
quantity = "force"
[[stage]]
name = "push"
duration = "1.1 s"
local_damping = 0.3
)");
}

/// Runs to the end; mean over its last 0.2 s of force(run), N/m.
template <class Force>
double mean_at_the_end(Simulation<PlaneStrain>& run, Force&& force) {
  double sum = 0, since = 0;
  while (!run.finished()) {
    const double before = run.time();
    run.advance();
    if (before < 0.9) continue;
    sum += force(run) * (run.time() - before);
    since += run.time() - before;
  }
  return sum / since;
}

}  // namespace polder
