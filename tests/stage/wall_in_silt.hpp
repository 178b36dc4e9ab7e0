#pragma once
// Steady seepage of the unsaturated formulation under a wall half way down a layer of silt, 1 m of head across it.
#include <string>

#include "case_text.hpp"
#include "polder/stage/simulation.hpp"
#include "silt.hpp"

namespace polder {

/// `cells`: model.cell, and what refines it.
inline Model wall_in_silt(const std::string& cells) {
  return read_text(R"(
[model]
formulation = "unsaturated"
size = ["20 m", "3 m"]
)" + cells + R"([initial]
stress = "none"
water_table = [[0, 2], [20, 2]]
)" + silt("fixed = true") +
                   R"(
[[soil]]
material = "silt"
polygon = [[0, 0], [20, 0], [20, 2], [0, 2]]
[[wall]]
line = [[10, 3], [10, 1]]
[[seepage_boundary]]
name = "edge"
line = [[0, 2], [10, 2]]
head = "3 m"
[[seepage_boundary]]
name = "other"
line = [[10, 2], [20, 2]]
head = "2 m"
[numerics]
step_stretch = 1000
[[stage]]
name = "flow"
duration = "20 s"
)");
}

/// Runs to the end and returns what leaves in the last step, over k and the head.
inline double discharge_at_the_end(Simulation<PlaneStrain>& run) {
  double q = 0;
  while (!run.finished()) {
    const double out = run.audit().water_out, from = run.time();
    run.advance();
    q = (run.audit().water_out - out) / (run.time() - from);
  }
  return q / 5e-4;
}

}  // namespace polder
