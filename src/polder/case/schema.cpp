#include "polder/case/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "polder/case/ground_section.hpp"
#include "polder/case/seepage_section.hpp"
#include "polder/case/stability_section.hpp"
#include "polder/math/units.hpp"

namespace polder::case_file {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

const std::vector<Section> sections = {
    {"model", false, true, "The space that is computed: its size, its grid, gravity."},
    {"refine", true, false,
     "A range of an axis in which the grid's cells are finer; away from it they grow to `model.cell`. Points are "
     "seeded "
     "accordingly."},
    {"water", false, false, "Properties of the water. The defaults are fresh water at 20 °C with its true stiffness."},
    {"material", true, false,
     "A soil: its law, its density and porosity, how water flows through it. The parameters of the law stand beside "
     "these keys."},
    {"soil", true, false, "A body of soil: a material in a polygon or a box."},
    {"free_water", true, false,
     "Water outside the soil at the start. Where a region overlaps soil, the soil keeps its place; its pores are "
     "filled "
     "by `initial.water_table`."},
    {"initial", false, false, "The state before the first stage: water in the pores, stress in the soil."},
    {"boundary", true, false,
     "What happens along a side of the model, along a line of the grid inside it, or in a reservoir. A side without an "
     "entry is a smooth, impermeable wall."},
    {"wall", true, false,
     "A rigid wall inside the model that neither water nor soil crosses: a thin one, a line that lies on the faces of "
     "the "
     "grid nearest to it, or a body of any shape, a polygon or a box. `until` or `until_stage` makes it a gate."},
    {"well", true, false,
     "A well, a drain or a leaking pipe inside the soil: water is taken out, or put in, at a point or along a line, by "
     "a "
     "discharge or at a head."},
    {"rain", true, false, "Water that falls on the ground and on free water."},
    {"change", true, false,
     "What is done to the ground as a stage begins: soil in a polygon or a box is excavated, placed, or becomes "
     "another "
     "material. The masses are booked in the balances of the run."},
    {"stage", true, true,
     "A span of the run; stages follow each other in the order of the file. Those marked `initial` come first, end at "
     "t = 0, and leave displacements, velocities and plastic strains at zero."},
    {"monitor", true, false, "A quantity that history.csv records."},
    {"output", false, false, "How often what is written."},
    {"numerics", false, false, "Choices of the method; docs/theory.md argues for the defaults."},
    {"seepage", false, false,
     "Seepage by finite elements (`polder seepage`, and `polder stability` where it takes pressures from there): mesh "
     "and instants. Heads and faces come from the model's water and boundaries unless a `[[seepage_boundary]]` says "
     "otherwise."},
    {"retention", true, false, "How a material holds and conducts water under suction, for seepage."},
    {"seepage_boundary", true, false,
     "A condition for seepage along a part of the soil's outline, in place of what the model says there."},
    {"stability", false, false,
     "The factor of safety (`polder stability`): water, loads and slip surfaces beyond what the simulation needs."},
    {"strength", true, false, "Strength and weights of a material for the factor of safety, in place of its law's."},
    {"head_line", true, false,
     "A line on which the head is known, for the factor of safety: pressure is linear in height between the water "
     "table, "
     "such lines one under the other, and hydrostatic under the last."},
    {"line_load", true, false,
     "A force per metre of dike at a point of the section, for the factor of safety (a rail, an anchored fence, the "
     "wind on "
     "a tree)."},
    {"dike_check", true, false,
     "A place behind a dike where `polder stability` checks uplift, heave and (with a `d70`) piping: weights and heads "
     "are "
     "those of the section there."},
    {"load", true, false,
     "A pressure on the ground, downwards. It moves with the soil that is at the surface when it comes, or travels "
     "over "
     "it."},
};

std::vector<Key> make_keys() {
  const auto any = -infinity;
  return {
      // ---- model
      {"model", "title", "", "text", false, "", any, infinity, R"("Seepage through a dike")",
       "One line that heads the report."},
      {"model", "space", "", "choice:plane-strain|3d", false, "plane-strain", any, infinity, R"("plane-strain")",
       "A vertical section of a long structure (per metre of its length), or three dimensions."},
      {"model", "size", "", "list of length", true, "", 1e-3, 1e5, R"(["4 m", "1.5 m"])",
       "Extent of the model from its lower left corner, the origin: [width, height], in 3d [width, depth, height]."},
      {"model", "cell", "h", "list of length", true, "", 1e-5, 1e4, R"("0.1 m")",
       "Spacing of the grid: one for all axes, or one per axis. The size must be a multiple of it, unless the axis is "
       "refined (`[[refine]]`): then it is the largest."},
      {"model", "gravity", "g", "acceleration", false, "9.81 m/s2", 0, 1000, R"("9.81 m/s2")",
       "Acceleration of gravity, downwards; more than 9.81 m/s2 in a centrifuge."},
      {"model", "tilt", "", "angle", false, "0 deg", -std::numbers::pi / 2, std::numbers::pi / 2, R"("20 deg")",
       "Gravity leans from the vertical towards +x by this angle: the model of a slope, or of a channel, is drawn "
       "level. "
       "Initial stress is then `none` or by `gravity`."},
      {"model", "periodic", "", "flag", false, "false", any, infinity, "false",
       "What leaves the model on the right comes in on the left and the other way round: a piece of something long."},
      {"model", "points_per_axis", "", "count", false, "2", 1, 8, "2",
       "Soil and water points per cell along each axis at the start."},
      {"model", "formulation", "", "choice:double-point|single-point|unsaturated", false, "double-point", any, infinity,
       R"("double-point")",
       "Water in the pores of soil: on water points of its own, or carried by the soil points: `single-point` "
       "(soil is saturated or dry, and exchanges water with free water where it ends) or `unsaturated` (pores may hold "
       "air: "
       "`[[retention]]`, Bishop's effective stress, conditions by `[[seepage_boundary]]`)."},
      // ---- refine
      {"refine", "name", "", "name", false, "", any, infinity, R"("orifice")", "For messages."},
      {"refine", "along", "", "choice:x|y|height", true, "", any, infinity, R"("x")", "The axis."},
      {"refine", "span", "", "list of length", true, "", any, infinity, R"(["0.5 m", "1 m"])",
       "[from, to] of the range; both ends become lines of the grid. (A range whose cell is `model.cell` only pins "
       "them.)"},
      {"refine", "cell", "", "length", true, "", 1e-5, 1e4, R"("50 mm")",
       "Largest cell in the range, where all cells are alike. The time step follows the smallest cell of the grid."},
      {"refine", "growth", "", "ratio", false, "1.15", 1.02, 1.5, "1.15",
       "Each cell away from the range is at most this much larger than its neighbour."},
      // ---- water
      {"water", "density", "ρw", "density", false, "1000 kg/m3", 500, 2000, R"("1000 kg/m3")", "Density."},
      {"water", "bulk_modulus", "Kw", "pressure", false, "2.2 GPa", 1e4, 1e11, R"("2.2 GPa")",
       "Stiffness in compression. The true one costs nothing here; papers reduce it to lengthen an explicit step."},
      {"water", "viscosity", "μ", "viscosity", false, "1e-3 Pa s", 1e-7, 1e3, R"("1e-3 Pa s")", "Dynamic viscosity."},
      {"water", "cavitation_pressure", "pc", "pressure", false, "-98 kPa", -1e12, -1, R"("-98 kPa")",
       "Least pressure, the atmosphere's being 0: a void opens rather than that it falls further. Far below (`-1 "
       "GPa`): "
       "never."},
      {"water", "viscous", "", "flag", false, "false", any, infinity, "false",
       "Free water has (laminar) viscous stresses. Left out: only the drag in soil and sides with `no-slip` know of "
       "the "
       "viscosity, for boundary layers of water are far thinner than cells."},
      // ---- material
      {"material", "name", "", "name", true, "", any, infinity, R"("sand")", "By which `[[soil]]` refers to it."},
      {"material", "law", "", "text", true, "", any, infinity, R"("mohr-coulomb")",
       "Soil law. Its parameters are keys of the same section; see the laws below."},
      {"material", "grain_density", "ρs", "density", false, "", 500, 20000, R"("2650 kg/m3")",
       "Density of the grains; as a unit weight (\"26 kN/m3\") it is divided by 9.81 m/s2."},
      {"material", "porosity", "n", "ratio", false, "", 0.01, 0.99, "0.4", "Initial porosity."},
      {"material", "void_ratio", "e", "ratio", false, "", 0.01, 99, "0.67",
       "Initial void ratio, instead of the porosity."},
      {"material", "unsaturated_unit_weight", "γ_unsat", "unit weight", false, "", 1000, 200000, R"("16 kN/m3")",
       "Unit weight of the dry soil, (1 − n) ρs g: with one more of density, porosity and γ_sat it fixes the others."},
      {"material", "saturated_unit_weight", "γ_sat", "unit weight", false, "", 1000, 200000, R"("20 kN/m3")",
       "Unit weight of the saturated soil, [(1 − n) ρs + n ρw] g."},
      {"material", "max_porosity", "n_max", "ratio", false, "0.5", 0.02, 1, "0.5",
       "Loosest packing: beyond it the grains have lost contact and flow with the water."},
      {"material", "grain_diameter", "D", "length", false, "", 1e-7, 10, R"("0.5 mm")",
       "Mean grain diameter. Without a permeability, Kozeny–Carman gives it from this: κ = D² n³ / (A (1 − n)²)."},
      {"material", "permeability", "k", "permeability", false, "", 1e-15, 10, R"("1e-3 m/s")",
       "Hydraulic conductivity at the initial porosity, the same in all directions. It changes with the porosity as "
       "Kozeny–Carman says."},
      {"material", "horizontal_permeability", "k_h", "permeability", false, "", 1e-15, 10, R"("2e-3 m/s")",
       "Hydraulic conductivity along the layers; together with the vertical one, instead of `permeability`."},
      {"material", "vertical_permeability", "k_v", "permeability", false, "", 1e-15, 10, R"("1e-3 m/s")",
       "Hydraulic conductivity across the layers."},
      {"material", "intrinsic_permeability", "κ", "area", false, "", 1e-22, 1e-4, R"("4e-11 m2")",
       "Of the grain skeleton alone, instead of `permeability`: k = κ ρw g / μ."},
      {"material", "permeability_exponent", "m", "ratio", false, "", 0, 20, "2",
       "K changes with the porosity as [(1 − n₀)/(1 − n)]^m instead of as Kozeny–Carman says; 0: it stays."},
      {"material", "permeability_change", "c_k", "ratio", false, "", 1e-3, 1e6, "0.875",
       "K changes with the void ratio e = n/(1 − n) as 10^(Δe/c_k) instead of as Kozeny–Carman says. In `polder "
       "seepage` with "
       "`seepage.deformation`, too."},
      {"material", "drag", "", "choice:ergun|darcy|beetstra|gidaspow", false, "ergun", any, infinity, R"("ergun")",
       "Force between grains and water: Ergun–Forchheimer (quadratic), Darcy (linear), or a law that also holds for "
       "dilute suspensions."},
      {"material", "ergun_a", "A", "ratio", false, "150", 1, 1e4, "150", "Ergun's constant of the linear part."},
      {"material", "ergun_b", "B", "ratio", false, "1.75", 0, 100, "1.75", "Ergun's constant of the quadratic part."},
      {"material", "fixed", "", "flag", false, "false", any, infinity, "false",
       "Rigid soil that never moves, such as a porous block."},
      // ---- soil
      {"soil", "name", "", "name", false, "", any, infinity, R"("dike")", "For messages and the report."},
      {"soil", "material", "", "name", true, "", any, infinity, R"("sand")", "Name of a `[[material]]`."},
      {"soil", "polygon", "", "polygon", false, "", any, infinity,
       R"([["1 m", "0 m"], ["2 m", "1 m"], ["2.4 m", "1 m"], ["3.8 m", "0 m"]])",
       "Outline in the section, [x, height] of each corner, in either sense; instead of a box."},
      {"soil", "box", "", "box", false, "", any, infinity, R"([["0 m", "0 m"], ["4 m", "0.5 m"]])",
       "Two opposite corners of a rectangle; in 3d [x, y, height] of each, or a rectangle that is extruded."},
      {"soil", "across", "", "list of length", false, "", any, infinity, R"(["0 m", "1 m"])",
       "In 3d: the span [from, to] of y across which a polygon is extruded; left out: all of it."},
      // ---- free_water
      {"free_water", "name", "", "name", false, "", any, infinity, R"("reservoir")", "For messages and the report."},
      {"free_water", "polygon", "", "polygon", false, "", any, infinity,
       R"([["0 m", "0 m"], ["1 m", "0 m"], ["1.8 m", "0.8 m"], ["0 m", "0.8 m"]])", "Outline; instead of a box."},
      {"free_water", "box", "", "box", false, "", any, infinity, R"([["0 m", "0 m"], ["1 m", "0.8 m"]])",
       "Two opposite corners."},
      {"free_water", "across", "", "list of length", false, "", any, infinity, R"(["0 m", "1 m"])",
       "In 3d: the span [from, to] of y; left out: all of it."},
      // ---- boundary
      {"boundary", "name", "", "name", false, "", any, infinity, R"("base")", "For messages and the report."},
      {"boundary", "side", "", "choice:left|right|base|top|front|back", false, "", any, infinity, R"("base")",
       "A side of the model; `front` (y = 0) and `back` in 3d only."},
      {"boundary", "line", "", "polyline", false, "", any, infinity, R"([["2 m", "0 m"], ["2 m", "1.5 m"]])",
       "Instead of a side: two points of a vertical or horizontal line that lies on the grid."},
      {"boundary", "soil", "", "choice:none|roller|rough|absorbing", false, "roller", any, infinity, R"("rough")",
       "`roller`: no displacement of the soil across it; `rough`: none at all; `none`: the soil does not feel it; "
       "`absorbing`: the ground goes on beyond the side, waves leave (in initial stages a roller)."},
      {"boundary", "water", "", "choice:closed|open|reservoir|head|inflow|no-slip", false, "closed", any, infinity,
       R"("closed")",
       "`closed`: no flow; `open`: of a line, water passes freely, of a side, it falls out and none comes in; "
       "`reservoir`: the head is given in a region; `head`: the head "
       "is "
       "given on a side, above it water may only leave (a seepage face); `inflow`: the discharge is given on a side; "
       "`no-slip`: a side is closed and water sticks to it; where "
       "free water is not `viscous`, by the law of the wall for a smooth one."},
      {"boundary", "slide", "", "table of velocity", false, "", -100, 100, R"("0.1 m/s")",
       "A side moves along itself, towards +x or, an upright one, upwards, and takes with it what sticks to it "
       "(`rough` "
       "soil, `no-slip` water): one value, a list [[time, velocity], …], or a CSV file."},
      {"boundary", "push", "", "table of velocity", false, "", -100, 100, R"([["0 s", "1 mm/s"]])",
       "A side moves into the model, as a rigid plate (negative: out of it). For displacements that are small against "
       "a "
       "cell: its place on the grid stays."},
      {"boundary", "region", "", "polygon", false, "", any, infinity,
       R"([["0 m", "0 m"], ["0.3 m", "0 m"], ["0.3 m", "1.5 m"], ["0 m", "1.5 m"]])",
       "Where a reservoir keeps its level."},
      {"boundary", "head", "H", "table of length", false, "", -1e5, 1e5, R"("0.8 m")",
       "Water level of a reservoir, or head on a side, above y = 0: one value, a hydrograph [[time, level], …], or a "
       "CSV file with the "
       "columns time in s and level in m. Linear between the points, constant beyond."},
      {"boundary", "inflow", "q", "table of velocity", false, "", -100, 100, R"("5 mm/s")",
       "Discharge into the model per area of the side: one value, a list [[time, discharge], …], or a CSV file."},
      {"boundary", "span", "", "list of length", false, "", any, infinity, R"(["0.45 m", "0.55 m"])",
       "The part of a side that is open, or with a head or an inflow, [from, to] along x or of the height of an "
       "upright "
       "side, to the nearest face of the grid: an orifice. Left out: all of it."},
      // ---- wall
      {"wall", "name", "", "name", false, "", any, infinity, R"("sheet pile")", "For messages and the report."},
      {"wall", "line", "", "polyline", false, "", any, infinity, R"([["2 m", "1 m"], ["2 m", "0.3 m"]])",
       "A thin wall from end to end. An oblique part is stepped along the grid."},
      {"wall", "polygon", "", "polygon", false, "", any, infinity,
       R"([["0 m", "0 m"], ["4 m", "0 m"], ["4 m", "0.2 m"]])",
       "Outline of a body, such as a sloping bed; it need not follow the grid. Where it overlaps soil or water, the "
       "body "
       "keeps its place."},
      {"wall", "box", "", "box", false, "", any, infinity, R"([["1 m", "0 m"], ["1.3 m", "0.4 m"]])",
       "Two opposite corners of a rectangular body, instead of a polygon."},
      {"wall", "soil", "", "choice:smooth|rough", false, "smooth", any, infinity, R"("smooth")",
       "Whether soil slides along the wall or sticks to it. Water always slides."},
      {"wall", "friction_angle", "δ", "angle", false, "0 deg", 0, 1.5533430342749532, R"("20 deg")",
       "Of soil that slides along it."},
      {"wall", "velocity_x", "", "table of velocity", false, "", -100, 100, R"("5 mm/s")",
       "Of a body that moves, along x, from t = 0 on: one value, a list [[time, velocity], …], or a CSV file."},
      {"wall", "velocity_upward", "", "table of velocity", false, "", -100, 100, R"("-1 mm/s")", "Likewise, upwards."},
      {"wall", "displacement_x", "", "table of length", false, "", -1e5, 1e5, R"([["0 s", "0 m"], ["2 s", "0.1 m"]])",
       "Of a body that moves, along x, instead of its velocity: a list [[time, displacement], …] that begins with 0 at "
       "t = 0, or a CSV file."},
      {"wall", "displacement_upward", "", "table of length", false, "", -1e5, 1e5,
       R"([["0 s", "0 m"], ["2 s", "-0.1 m"]])", "Likewise, upwards."},
      {"wall", "from_stage", "", "name", false, "", any, infinity, R"("dig")",
       "Name of the stage at whose beginning a thin wall is put in. Left out: it is there from the start."},
      {"wall", "until", "", "time", false, "", 0, 3.2e9, R"("2 s")",
       "When the wall vanishes, in time of the event (t = 0 after the initial stages). Left out: it stays."},
      {"wall", "until_stage", "", "name", false, "", any, infinity, R"("rest")",
       "Name of the stage at whose beginning the wall vanishes, instead of a time."},
      // ---- monitor
      {"monitor", "name", "", "name", true, "", any, infinity, R"("toe")", "Heads its column of history.csv."},
      {"monitor", "kind", "", "choice:point|section|surface|integral|wall", false, "point", any, infinity, R"("point")",
       "At points, through a section (a line of two points), of the height of a surface at points, over a region, or "
       "of "
       "a wall that is a body."},
      {"monitor", "quantity", "",
       "choice:pressure|porosity|velocity|displacement|effective-stress|water-velocity|discharge|water-surface|"
       "soil-surface|water-volume|soil-volume|kinetic-energy|settlement|largest-porosity|excess-pressure|wedge-angle|"
       "largest-uplift|eroded-area|water-front|soil-front|total-stress|saturation|uplift-length|force|soil-force",
       true, "", any, infinity, R"("displacement")",
       "What is recorded. At a point: pressure, excess-pressure (over the initial water table), porosity, velocity, "
       "displacement, effective-stress, water-velocity, wedge-angle (of the soil that is lifted over an opening whose "
       "edge the point is), in the unsaturated formulation total-stress (vertical, of the row of cells above the "
       "place, "
       "down to it) and saturation; through a section: discharge, pressure, uplift-length (of the row of cells on the "
       "line, where the mean vertical effective stress is below 2 kPa); of a surface: water-surface, soil-surface; "
       "over a "
       "region: water-volume, soil-volume, kinetic-energy, settlement (mean, of the soil that was there at the start), "
       "largest-porosity, largest-uplift, eroded-area, water-front, soil-front; of a wall: force (of soil and water on "
       "it), soil-force, displacement."},
      {"monitor", "at", "", "points", false, "", any, infinity, R"([["3.5 m", "0.2 m"]])",
       "The points; of a section the two ends of the line; of a surface the places where its height is taken, each for "
       "the "
       "column of cells in which it lies."},
      {"monitor", "wall", "", "name", false, "", any, infinity, R"("footing")",
       "Name of the `[[wall]]` that a monitor of that kind is about."},
      {"monitor", "region", "", "polygon", false, "", any, infinity,
       R"([["2 m", "0 m"], ["4 m", "0 m"], ["4 m", "1.5 m"], ["2 m", "1.5 m"]])",
       "Of an integral; left out: the whole model."},
      {"monitor", "follows_soil", "", "flag", false, "true", any, infinity, "true",
       "A point moves with the soil that was there at the start; false: it stays in place."},
      // ---- output
      {"output", "history", "", "time", false, "0.1 s", 1e-9, 3.2e9, R"("0.1 s")",
       "Interval of the rows of history.csv."},
      {"output", "snapshots", "", "time", false, "1 s", 1e-9, 3.2e9, R"("1 s")",
       "Interval of the snapshots that the report plays and ParaView opens."},
      {"output", "pictures", "", "list of time", false, "", 0, 3.2e9, R"(["2 s", "10 s"])",
       "Instants of the pictures; each is a snapshot too."},
      {"output", "checkpoint", "", "time", false, "300 s", 0.01, 1e6, R"("300 s")",
       "Interval of the checkpoints, in time of the clock on the wall."},
      // ---- numerics
      {"numerics", "cfl", "", "ratio", false, "0.8", 0.01, 1, "0.8",
       "Share of the cell that the drained P-wave crosses in a step; in the unsaturated formulation 0.5 at most."},
      {"numerics", "pressure_tolerance", "", "ratio", false, "1e-6", 1e-14, 1e-2, "1e-6",
       "Relative residual at which the pressure is solved."},
      {"numerics", "transfer", "", "choice:apic|xpic", false, "apic", any, infinity, R"("xpic")",
       "Of the soil's velocities between points and grid. `apic` damps motion shorter than some ten cells, as soil "
       "does; "
       "`xpic` (second order) damps less of what the grid resolves, for elastic bodies that vibrate or are sheared "
       "fast, "
       "and takes a twentieth longer."},
      {"numerics", "fbar", "", "ratio", false, "0.5", 0, 1, "0.5",
       "Share of the cell's mean in a soil point's change of volume, against locking."},
      {"numerics", "wet_threshold", "", "ratio", false, "0.5", 0.01, 0.99, "0.5", "Fill above which a cell is wet."},
      {"numerics", "volume_correction", "", "ratio", false, "0.3", 0, 1, "0.3",
       "Share of the error of a cell's fill that a step removes by shifting water points."},
      {"numerics", "pressure_weight", "θ", "ratio", false, "1", 0.5, 1, "0.5",
       "Of the new pressure in a step: 1 damps waves of the water, 0.5 carries them (with a max_step that resolves "
       "them)."},
      {"numerics", "split_water", "", "flag", false, "true", any, infinity, "true",
       "Split water points that have stretched on entering soil."},
      {"numerics", "max_step", "Δt", "time", false, "", 1e-12, 3.2e9, R"("1e-3 s")",
       "Upper bound of the time step. Left out: only what stability asks for."},
      {"numerics", "mass_scaling", "F", "ratio", false, "1", 1, 1e8, "100",
       "Unsaturated formulation: factor on the soil's inertia (not on its weight), which lengthens the step by its "
       "root."},
      {"numerics", "step_stretch", "", "ratio", false, "1", 1, 1e5, "1000",
       "Unsaturated formulation: how many times the natural step a step may have while the ground is at rest. Soil too "
       "stiff for it gets as much more inertia as it needs; where the ground runs, steps are natural again."},
      {"numerics", "step_material", "", "name", false, "", any, infinity, R"("clay")",
       "Unsaturated formulation: the material whose stiffness sets the natural step. Soil too stiff for it gets as "
       "much more inertia as it needs, also where the ground runs. Left out: the stiffest, so that none is given any."},
      {"numerics", "jitter", "", "ratio", false, "0", 0, 0.5, "0",
       "Random displacement of the points at the start, as a share of their spacing."},
      {"numerics", "seed", "", "count", false, "1", 0, 9007199254740992.0, "1", "Of the random numbers."},
  };
}

/// The default of a law's parameter as one would write it.
std::string standard_of(const Parameter& p) {
  if (p.required || std::isnan(p.standard)) return {};
  if (const auto words = choices_of(p.quantity); !words.empty()) return words.at(static_cast<std::size_t>(p.standard));
  const Quantity* quantity = find_quantity(p.quantity);
  return quantity ? show_measure(p.standard, *quantity) : fmt::format("{:g}", p.standard);
}

}  // namespace

const std::vector<Section>& case_sections() { return sections; }

const std::vector<Key>& case_keys() {
  static const std::vector<Key> keys = [] {
    std::vector<Key> all = make_keys();
    for (Key& key : state_keys()) all.push_back(std::move(key));
    for (Key& key : ground_keys()) all.push_back(std::move(key));
    for (Key& key : seepage_keys()) all.push_back(std::move(key));
    for (Key& key : stability_keys()) all.push_back(std::move(key));
    return all;
  }();
  return keys;
}

std::vector<const Key*> keys_of(std::string_view section) {
  std::vector<const Key*> found;
  for (const Key& key : case_keys())
    if (key.section == section) found.push_back(&key);
  return found;
}

const Key* find_key(std::string_view section, std::string_view name) {
  for (const Key& key : case_keys())
    if (key.section == section && key.name == name) return &key;
  return nullptr;
}

Key law_key(const Parameter& p) {
  Key key;
  key.section = "material";
  key.name = p.key;
  key.symbol = p.symbol;
  key.quantity = p.quantity;
  key.required = p.required;
  key.standard = standard_of(p);
  key.doc = p.doc;
  if (!p.required && !std::isnan(p.standard)) key.preset = p.standard;
  if (choices_of(p.quantity).empty()) {
    key.low = p.low;
    key.high = p.high;
  }
  return key;
}

std::vector<std::string> choices_of(std::string_view quantity) {
  std::vector<std::string> words;
  if (!quantity.starts_with("choice:")) return words;
  quantity.remove_prefix(7);
  while (true) {
    const std::size_t bar = quantity.find('|');
    words.emplace_back(quantity.substr(0, bar));
    if (bar == std::string_view::npos) return words;
    quantity.remove_prefix(bar + 1);
  }
}

std::optional<TableKind> table_kind(std::string_view quantity) {
  if (!quantity.starts_with("table of ")) return {};
  quantity.remove_prefix(9);
  const auto by = quantity.find(" by ");
  return TableKind{find_quantity(quantity.substr(0, by)),
                   find_quantity(by == std::string_view::npos ? "time" : quantity.substr(by + 4))};
}

std::string expected(const Key& key) {
  if (const auto words = choices_of(key.quantity); !words.empty())
    return fmt::format("one of \"{}\"", fmt::join(words, "\", \""));
  if (const Quantity* q = find_quantity(key.quantity))
    return q->unit.empty() ? fmt::format("a ratio such as {}", key.example.empty() ? "0.4" : key.example)
                           : fmt::format("{} such as \"{}\"", q->article, q->example);
  const std::string such = key.example.empty() ? "" : " such as " + key.example;
  if (key.quantity == "flag") return "true or false";
  if (key.quantity == "count") return "a whole number" + such;
  if (key.quantity == "polygon") return "a list of at least 3 points" + such;
  if (key.quantity == "polyline") return "a list of at least 2 points" + such;
  if (key.quantity == "box") return "two corners" + such;
  if (key.quantity == "points") return "a list of points" + such;
  if (key.quantity == "list of length") return "lengths" + such;
  if (key.quantity == "list of time") return "times" + such;
  if (key.quantity == "list of pressure") return "pressures" + such;
  if (const auto table = table_kind(key.quantity)) {
    const std::string one = table->by_time() ? fmt::format("a {}, ", table->of->name) : "";
    return fmt::format("{}a list of [{}, {}], or a CSV file{}", one, table->by->name, table->of->name, such);
  }
  if (key.quantity == "file") return "the name of a file" + such;
  return "a text" + such;
}

std::string range_of(const Key& key) {
  std::string_view kind = key.quantity;
  if (const auto of = kind.find(" of "); of != std::string_view::npos) kind.remove_prefix(of + 4);
  kind = kind.substr(0, kind.find(" by "));
  const Quantity* quantity = find_quantity(kind);
  const auto show = [&](double value) {
    return quantity ? show_measure(value, *quantity) : fmt::format("{:.16g}", value);
  };
  const bool below = std::isfinite(key.low), above = std::isfinite(key.high);
  if (below && above) return fmt::format("between {} and {}", show(key.low), show(key.high));
  if (below) return "at least " + show(key.low);
  if (above) return "at most " + show(key.high);
  return {};
}

}  // namespace polder::case_file
