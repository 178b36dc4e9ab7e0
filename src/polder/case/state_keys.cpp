// Keys of the state before the first stage and of the stages: [initial], [[stage]].
#include <limits>

#include "polder/case/ground_section.hpp"

namespace polder::case_file {

std::vector<Key> state_keys() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double any = -infinity;
  return {
      // ---- initial
      {"initial", "water_table", "", "polyline", false, "", any, infinity, R"([["1.8 m", "0.8 m"], ["3.8 m", "0 m"]])",
       "Phreatic line in the soil, [x, height] from left to right; it goes on level beyond its ends. Soil below it is "
       "saturated at the start, soil above it is dry. Left out: all soil is dry."},
      {"initial", "seepage", "", "flag", false, "false", any, infinity, "true",
       "The water table and, in the unsaturated formulation, pressures and suction are those of steady seepage under "
       "the conditions at t = 0 (as by `polder seepage`), instead of a `water_table`; plane strain."},
      {"initial", "suction_limit", "s", "pressure", false, "", 0, infinity, R"("50 kPa")",
       "Unsaturated formulation: the suction above the water table is hydrostatic up to this value. Left out: all the "
       "way up."},
      {"initial", "stress", "σ'", "choice:k0|k0-slope|gravity|none", false, "k0", any, infinity, R"("k0")",
       "Effective stress at the start: `k0`, the weight above and K0 times it sideways (level ground); `k0-slope`, "
       "elastic "
       "balance that on level ground is the same (sloping ground in plane strain); `gravity`, which is raised in an "
       "initial stage; or none."},
      {"initial", "k0", "K0", "ratio", false, "", 0, 10, "0.5",
       "Ratio of horizontal to vertical effective stress. Left out: 1 − sin φ' where the law has a friction angle, "
       "else ν/(1 − ν)."},
      // ---- stage
      {"stage", "name", "", "name", true, "", any, infinity, R"("seepage")", "For messages and the report."},
      {"stage", "duration", "", "time", true, "", 1e-9, 3.2e9, R"("10 s")",
       "How long it lasts; with `until_rest`, at most."},
      {"stage", "until_rest", "", "flag", false, "false", any, infinity, "true",
       "It ends as soon as `rest_energy` and `rest_force` have held for a hundred steps in a row, after the ramp. If "
       "that "
       "is not reached within its duration, the summary warns."},
      {"stage", "rest_energy", "", "ratio", false, "1e-8", 1e-20, 1, "1e-7",
       "Kinetic energy of soil and water that counts as rest, over their weight times the height of a cell."},
      {"stage", "rest_force", "", "ratio", false, "0.01", 1e-12, 1, "1e-3",
       "Out-of-balance force that counts as rest, summed over the grid, over the weight of soil and water."},
      {"stage", "initial", "", "flag", false, "false", any, infinity, "false",
       "Prepares the state at t = 0 and is not part of the event."},
      {"stage", "ramp", "", "time", false, "0 s", 0, 3.2e9, R"("0.7 s")",
       "Gravity rises linearly from zero to its value over this time at the start of the stage; 0 s: it acts in full."},
      {"stage", "damping", "", "frequency", false, "0 1/s", 0, 1e6, R"("10 1/s")",
       "Viscous damping of the soil's velocity, per unit of mass."},
      {"stage", "water_damping", "", "frequency", false, "0 1/s", 0, 1e9, R"("5 1/s")",
       "Viscous damping of the water's velocity: lets waves of a disturbed start die out in an initial stage."},
      {"stage", "local_damping", "α", "ratio", false, "0", 0, 1, "0.7",
       "Local damping as a share of the soil's out-of-balance force (Cundall)."},
      {"stage", "hold_water", "", "flag", false, "false", any, infinity, "false",
       "Water does not move horizontally, so that a level difference can wait for the next stage; in the unsaturated "
       "formulation pore pressures stay as they are."},
      {"stage", "history", "", "time", false, "", 1e-9, 3.2e9, R"("10 ms")",
       "Interval of the rows of history.csv during this stage, in place of `output.history`."},
      {"stage", "snapshots", "", "time", false, "", 1e-9, 3.2e9, R"("0.1 s")",
       "Interval of the snapshots during this stage, in place of `output.snapshots`."},
      {"stage", "mass_scaling", "F", "ratio", false, "", 1, 1e8, "1",
       "During this stage, in place of `numerics.mass_scaling`."},
      {"stage", "step_stretch", "", "ratio", false, "", 1, 1e5, "1",
       "During this stage, in place of `numerics.step_stretch`."},
  };
}

}  // namespace polder::case_file
