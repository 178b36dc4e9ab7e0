#pragma once
// A case as plain data, SI units, every default filled in: what the parser hands to every other room.
// Signs: stress positive in tension, water pressure positive in compression, up is +y (plane strain) or +z (3d).
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "polder/case/grid_axis.hpp"
#include "polder/case/pore_water.hpp"
#include "polder/material/drag.hpp"
#include "polder/math/table.hpp"

namespace polder {

using Point2 = std::array<double, 2>;  ///< m; (x, height)
using Point3 = std::array<double, 3>;  ///< m; in plane strain the third is unused

enum class SpaceKind { plane_strain, solid };
enum class Transfer { apic, xpic };  ///< of the soil's velocities between points and grid
enum class InitialStress { k0, k0_slope, gravity, none };
inline bool is_by_k0(InitialStress stress) { return stress == InitialStress::k0 || stress == InitialStress::k0_slope; }

/// A polygon in the section (x, height); in 3d extruded across y from `across[0]` to `across[1]`.
struct Region {
  std::vector<Point2> polygon;
  std::array<double, 2> across{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
};

struct WaterProperties {
  double density = 1000;               ///< kg/m³
  double bulk_modulus = 2.2e9;         ///< Pa
  double viscosity = 1.0e-3;           ///< Pa s
  double cavitation_pressure = -98e3;  ///< Pa, beyond the atmosphere's: a void opens rather than that it is less
  bool viscous = false;  ///< free water has viscous stresses, too; else only the drag knows of its viscosity
};

struct MaterialInput {
  std::string name;
  std::string law;                     ///< name of a soil law (material/law.hpp)
  std::vector<double> law_parameters;  ///< in the order of the law's parameter table, SI, defaults filled in
  double grain_density = 2650;         ///< kg/m³
  double porosity = 0.4;               ///< initial
  double max_porosity = 0.5;           ///< loosest state: no contact between grains beyond it
  double grain_diameter = 0;           ///< m; 0: not given (then permeability is)
  DragLaw drag = DragLaw::ergun;
  double ergun_a = 150, ergun_b = 1.75;
  /// Hydraulic conductivity m/s (horizontal, vertical) at the initial porosity; absent: Kozeny–Carman from the grain
  /// diameter. With a given one the dependence on porosity is Kozeny–Carman's, scaled.
  std::optional<std::array<double, 2>> permeability;
  /// m of K = K(n₀) [(1 − n₀)/(1 − n)]^m, in place of Kozeny–Carman's change with the porosity.
  std::optional<double> permeability_exponent;
  /// c_k of K = K(n₀) 10^(Δe/c_k), in place of Kozeny–Carman's change with the porosity.
  std::optional<double> permeability_change;
  bool fixed = false;  ///< rigid soil that does not move (a porous block)
};

struct SoilBody {
  int material = 0;  ///< index into Model::materials
  Region region;
  std::string name;  ///< may be empty
};

/// Water outside the soil at the start; inside the soil the pores are filled below the water table.
struct FreeWaterBody {
  Region region;
  std::string name;  ///< may be empty
};

enum class SoilCondition { none, roller, rough, absorbing };
/// `no_slip`: closed, and the water sticks to it.
enum class WaterCondition { closed, open, reservoir, head, inflow, no_slip };
enum class Side { left, right, base, top, front, back };

/// What happens along a side of the model, along a grid-aligned line inside it, or in a region (reservoir).
struct Boundary {
  std::string name;
  std::optional<Side> side;
  std::vector<Point2> line;  ///< two points of a vertical or horizontal line; used where `side` is absent
  /// `roller`: no normal displacement of the soil; `rough`: no displacement at all; `absorbing`: the ground goes on
  /// beyond the side, which lets waves out.
  SoilCondition soil = SoilCondition::none;
  WaterCondition water = WaterCondition::closed;
  Region region;                              ///< of a reservoir
  Table head;                                 ///< m above datum y = 0, as a function of time (reservoir, head)
  Table inflow;                               ///< m/s into the model, as a function of time (inflow)
  std::optional<std::array<double, 2>> span;  ///< m, the part of a side with a head or an inflow: along x, or height
  /// A side that moves, m/s, as functions of time: along itself (towards +x, of upright sides upwards), with which goes
  /// what sticks to it, and into the model. Its place on the grid stays.
  Table slide, push;
};

/// A pressure on the ground, downwards. It acts on the soil that is at the surface when it comes, and moves with that
/// soil; a travelling one moves over it.
struct GroundLoad {
  std::string name;
  std::array<double, 2> span{};          ///< m, [from, to] of x; of a travelling load at t = 0
  Table pressure;                        ///< Pa, as a function of time
  std::optional<Table> pressure_at_end;  ///< Pa, at the span's end, linear in between; absent: the same all along
  double speed = 0;                      ///< m/s along x, from t = 0 on
  int from_stage = -1;   ///< index into Model::stages; it comes as that stage begins; −1: at the start
  int until_stage = -1;  ///< likewise; it goes as that stage begins; −1: it stays
};

enum class ChangeKind { excavate, place, convert };
/// Of the water in the pores of excavated soil: it goes with the soil, it stays, or water also takes the grains' place.
enum class ExcavatedWater { take, leave, replace };

/// What is done to the ground as a stage begins: the soil in a region is taken out, soil is placed there, or what is
/// there becomes another material.
struct GroundChange {
  std::string name;
  int stage = 0;  ///< index into Model::stages, at least 1
  ChangeKind kind = ChangeKind::excavate;
  int material = -1;  ///< index into Model::materials, of what is placed or what it becomes
  Region region;
  ExcavatedWater water = ExcavatedWater::take;
};

/// Water that is taken out of the soil, or put into it, at a place inside the model: a well, a drain, a leaking pipe.
struct Well {
  std::string name;
  std::vector<Point3> at;  ///< m, one point (in plane strain a pipe across the section) or the two ends of a line
  std::optional<Table> discharge;         ///< m²/s, per metre of the section or of a line in 3d, of the time in s
  std::optional<Table> head;              ///< m above datum y = 0, instead
  double radius = 0;                      ///< m, of the pipe or well where a head is given
  bool only_takes = false;                ///< a drain: no water comes out of it
  int from_stage = -1, until_stage = -1;  ///< index into Model::stages; −1: from the start, to the end
};

/// Water that falls on the ground or on free water.
struct Rain {
  std::string name;
  std::optional<std::array<double, 2>> span;  ///< m, [from, to] of x; absent: everywhere
  Table rate;                                 ///< m/s, as a function of time
};

/// A rigid wall: a thin one or a body. A thin one is a line, thinner than a cell: it lies on the faces of the grid
/// nearest to the line, neither water nor soil crosses it, and the two sides do not feel each other except around its
/// ends. A body is a polygon that need not follow the grid.
struct WallInput {
  std::string name;             ///< may be empty
  std::vector<Point2> line;     ///< of a thin wall, (x, height) from end to end; in 3d it extends all across y
  std::vector<Point2> polygon;  ///< of a body; likewise
  bool rough = false;           ///< soil sticks to it; else it slides along
  double friction_angle = 0;    ///< rad, between the wall and soil that slides along it
  double until = std::numeric_limits<double>::infinity();  ///< s; then it vanishes
  /// Of a body that moves, along x and upwards from t = 0 on: its velocity, m/s, or its displacement, m, as functions
  /// of time; empty: none.
  std::array<Table, 2> velocity, displacement;
  int from_stage = -1;   ///< index into Model::stages; it is put in as that stage begins; −1: it is there
  int until_stage = -1;  ///< likewise; it vanishes as that stage begins; −1: none
};

/// A span of the run. Stages marked `initial` run before t = 0 and end with displacements, velocities and plastic
/// strains set to zero.
struct Stage {
  std::string name;
  double duration = 0;  ///< s
  bool initial = false;
  double ramp = 0;           ///< s; gravity rises linearly from 0 to its value over this time (0: full at once)
  double damping = 0;        ///< 1/s, viscous damping of the soil's velocity
  double water_damping = 0;  ///< 1/s, of the water's velocity
  double local_damping = 0;  ///< Cundall's factor on the soil's out-of-balance force
  bool hold_water = false;   ///< water is held horizontally (the papers' gravity phase)
  bool until_rest = false;   ///< it ends as soon as the ground has come to rest
  double rest_energy = 1e-8, rest_force = 0.01;  ///< what counts as rest, of Unrest (stage/rest.hpp)
  /// In place of Output's and Numerics' during this stage.
  std::optional<double> history_interval, snapshot_interval;  ///< s
  std::optional<double> mass_scaling, step_stretch;
};

enum class MonitorKind { point, section, surface, integral, wall };
struct Monitor {
  std::string name;
  MonitorKind kind = MonitorKind::point;
  std::string quantity;
  std::vector<Point3> at;  ///< points; the two ends of a section; where the height of a surface is taken
  bool follows_soil = true;
  Region region;  ///< of an integral; without corners: the whole model
  int wall = -1;  ///< index into Model::walls, of kind wall
};

struct Output {
  double history_interval = 0.1;     ///< s, rows of history.csv
  double snapshot_interval = 1;      ///< s, points.pvd
  std::vector<double> pictures;      ///< s, instants of the PNG pictures (and of extra snapshots)
  double checkpoint_interval = 300;  ///< s of wall time
};

/// Choices of the method; the defaults are those that docs/theory.md argues for.
struct Numerics {
  double cfl = 0.8;                  ///< of the drained P-wave and of the fastest point
  double pressure_tolerance = 1e-6;  ///< relative residual of the pressure solve
  Transfer transfer = Transfer::apic;
  double fbar = 0.5;               ///< share of the cell's mean in a soil point's volume change
  double wet_threshold = 0.5;      ///< fill above which a cell is wet
  double pressure_weight = 1;      ///< θ of the step: 1 damped, ½ time-centred
  double volume_correction = 0.3;  ///< share of the fill error removed in a step
  bool split_water = true;
  double max_step = std::numeric_limits<double>::infinity();  ///< s
  /// Unsaturated formulation: factor on the inertia, ≥ 1; and how many times the natural step a step may have while the
  /// ground is at rest, ≥ 1 (soil too stiff for it gets more inertia).
  double mass_scaling = 1, step_stretch = 1;
  std::string step_material;  ///< likewise: whose stiffness sets the natural step; empty: the stiffest one
  unsigned long long seed = 1;
  double jitter = 0;  ///< seeding jitter as a share of the points' spacing
};

struct Model {
  std::string name, title;
  std::string file;  ///< where it was read from
  SpaceKind space = SpaceKind::plane_strain;
  std::array<double, 3> size{0, 0, 0};          ///< m; x, height (2d) or x, y, height (3d)
  std::array<double, 3> cell{0, 0, 0};          ///< m, spacing per axis; the largest where there are finer cells
  std::array<std::vector<FineRange>, 3> finer;  ///< per axis, ascending
  double gravity = 9.81;                        ///< m/s²
  double tilt = 0;                              ///< rad, of gravity from the vertical towards +x
  bool periodic = false;                        ///< what leaves on the right comes in on the left, and the other way
  int points_per_axis = 2;                      ///< soil and water points per cell and axis at the start
  WaterProperties water;
  std::vector<MaterialInput> materials;
  std::vector<SoilBody> soils;
  std::vector<FreeWaterBody> free_water;
  std::vector<Point2> water_table;  ///< polyline (x, height); soil below it starts saturated; empty: all soil dry
  /// Pore water of soil carried by the soil points (single-point) instead of by water points of its own.
  bool single_point = false;
  /// Single-point, and the pores may hold air: water by the retention curves, Bishop's effective stress. The suction
  /// above the water table is hydrostatic, up to `suction_limit` (Pa) at the start.
  bool unsaturated = false;
  double suction_limit = std::numeric_limits<double>::infinity();
  std::vector<MaterialRetention> retentions;  ///< of the unsaturated formulation; a material without one: S = 1
  std::vector<SeepageCondition> pore_water;   ///< likewise, along lines of the outline; else: base and sides closed,
                                              ///< a seepage face on the ground
  bool initial_seepage = false;               ///< pore water at the start: steady seepage under the conditions at t = 0
  std::vector<double>
      start_pressure;  ///< Pa, of that: at the cells' centres, column by column from below; the run's own
  InitialStress initial_stress = InitialStress::k0;
  std::optional<double> k0;  ///< absent: 1 − sin φ' (Jaky) where the law has an angle, else ν/(1 − ν)
  std::vector<Boundary> boundaries;
  std::vector<WallInput> walls;
  std::vector<GroundLoad> loads;
  std::vector<GroundChange> changes;
  std::vector<Well> wells;
  std::vector<Rain> rains;
  std::vector<Stage> stages;
  std::vector<Monitor> monitors;
  Output output;
  Numerics numerics;
};

/// How the model's grid divides an axis.
inline GridAxis grid_axis(const Model& model, std::size_t axis) {
  if (!(model.size[axis] > 0 && model.cell[axis] > 0)) return {};
  return model.finer[axis].empty()
             ? GridAxis(static_cast<int>(std::lround(model.size[axis] / model.cell[axis])), model.cell[axis])
             : GridAxis(model.size[axis], model.cell[axis], model.finer[axis]);
}

/// Width of its smallest cell, m.
inline double smallest_cell(const Model& model) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < (model.space == SpaceKind::solid ? 3 : 2); ++axis)
    least = std::min(least, grid_axis(model, axis).least());
  return least;
}

}  // namespace polder
