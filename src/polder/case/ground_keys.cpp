// Keys of what is done to the ground during a run: [[change]], [[load]], [[well]], [[rain]].
#include <limits>

#include "polder/case/ground_section.hpp"

namespace polder::case_file {

std::vector<Key> ground_keys() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double any = -infinity;
  return {
      // ---- change
      {"change", "name", "", "name", false, "", any, infinity, R"("first cut")", "For messages and the report."},
      {"change", "stage", "", "name", true, "", any, infinity, R"("dig")",
       "Name of the stage at whose beginning it is done; not the first one."},
      {"change", "action", "", "choice:excavate|place|convert", true, "", any, infinity, R"("excavate")",
       "`excavate`: the soil that is in the region by then is taken out; `place`: the part of the region that is free "
       "of soil is filled with a material; `convert`: the soil in the region becomes another material, at the same "
       "porosity and stress."},
      {"change", "material", "", "name", false, "", any, infinity, R"("sand")",
       "Name of the `[[material]]` that is placed or that the soil becomes."},
      {"change", "polygon", "", "polygon", false, "", any, infinity,
       R"([["2 m", "1 m"], ["4 m", "1 m"], ["4 m", "2 m"], ["2 m", "2 m"]])", "Outline; instead of a box."},
      {"change", "box", "", "box", false, "", any, infinity, R"([["2 m", "1 m"], ["4 m", "2 m"]])",
       "Two opposite corners."},
      {"change", "across", "", "list of length", false, "", any, infinity, R"(["0 m", "1 m"])",
       "In 3d: the span [from, to] of y; left out: all of it."},
      {"change", "water", "", "choice:take|leave|replace", false, "take", any, infinity, R"("replace")",
       "What becomes of the water in the pores of excavated soil: `take`: it goes with the soil; `leave`: it stays "
       "where it is; `replace`: it stays, and water takes the place of the grains (dredging)."},
      // ---- well
      {"well", "name", "", "name", false, "", any, infinity, R"("drain")", "For messages and the report."},
      {"well", "at", "", "points", true, "", any, infinity, R"([["3 m", "0.5 m"]])",
       "One point, in plane strain a pipe across the section; or the two ends of a line, in plane strain a slot, in 3d "
       "a "
       "well [x, y, height]."},
      {"well", "discharge", "Q", "table of discharge", false, "", -1e4, 1e4, R"("2e-4 m2/s")",
       "Out of the soil, per metre: of the section's length in plane strain, of the well's own in 3d; negative: into "
       "it. "
       "One value, a list [[time, discharge], …], or a CSV file. Instead of a head."},
      {"well", "head", "H", "table of length", false, "", -1e5, 1e5, R"("0.4 m")",
       "Water level in the well, or head in the pipe, above y = 0; in time as a discharge. Its pressure is at least "
       "that "
       "of the air."},
      {"well", "radius", "r", "length", false, "", 1e-4, 100, R"("5 cm")",
       "Of the pipe or the well. Needed for a head, but not for a slot."},
      {"well", "only_takes", "", "flag", false, "true", any, infinity, "true",
       "With a head: no water comes out of it into the soil, as of a drain; false: of a pipe under pressure it does."},
      {"well", "from_stage", "", "name", false, "", any, infinity, R"("pumping")",
       "Name of the stage at whose beginning it starts. Left out: it runs from the start."},
      {"well", "until_stage", "", "name", false, "", any, infinity, R"("recovery")",
       "Name of the stage at whose beginning it stops. Left out: it runs to the end."},
      // ---- rain
      {"rain", "name", "", "name", false, "", any, infinity, R"("cloudburst")", "For messages and the report."},
      {"rain", "rate", "", "table of velocity", true, "", -1, 1, R"("50 mm/h")",
       "Height of water per time: one value, a list [[time, rate], …], or a CSV file. Negative: evaporation, from free "
       "water and from soil that is wet up to its surface."},
      {"rain", "span", "", "list of length", false, "", any, infinity, R"(["0 m", "4 m"])",
       "[from, to] of x. Left out: everywhere."},
      // ---- load
      {"load", "name", "", "name", false, "", any, infinity, R"("traffic")", "For messages and the report."},
      {"load", "span", "", "list of length", false, "", any, infinity, R"(["1 m", "2 m"])",
       "[from, to] of x where it stands on the ground. Needed."},
      {"load", "pressure", "q", "table of pressure", false, "0 kPa", -1e7, 1e7, R"("13 kPa")",
       "Pressure on the ground: one value, a list [[time, pressure], …], or a CSV file. The factor of safety takes the "
       "last."},
      {"load", "pressure_at_end", "", "table of pressure", false, "", -1e7, 1e7, R"("5 kPa")",
       "At the end of the span, linear in between. Left out: the same all along. A run only."},
      {"load", "speed", "v", "velocity", false, "0 m/s", -100, 100, R"("14 m/s")",
       "Of a strip that travels along x from t = 0 on, where it is `span`: traffic. 0 m/s: it stays on its soil. A run "
       "only."},
      {"load", "from_stage", "", "name", false, "", any, infinity, R"("traffic")",
       "Name of the stage at whose beginning it comes, on the ground as it is then. Left out: it is there from the "
       "start."},
      {"load", "until_stage", "", "name", false, "", any, infinity, R"("rest")",
       "Name of the stage at whose beginning it goes. Left out: it stays."},
      {"load", "spread", "", "angle", false, "0 deg", 0, 1.2, R"("30 deg")",
       "Angle from the vertical over which it spreads with depth."},
      {"load", "consolidation", "U", "ratio", false, "1", 0, 1, "1",
       "Degree of consolidation under it; the rest is carried by the pore water of all layers."},
  };
}

}  // namespace polder::case_file
