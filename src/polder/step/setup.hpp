#pragma once
// What does not change during a run (or changes only from stage to stage): grid, walls, materials, water, choices.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "polder/boundary/open_side.hpp"
#include "polder/boundary/reservoir.hpp"
#include "polder/boundary/standing_walls.hpp"
#include "polder/boundary/well.hpp"
#include "polder/case/model.hpp"
#include "polder/grid/bodies.hpp"
#include "polder/grid/lattice.hpp"
#include "polder/grid/thin_walls.hpp"
#include "polder/grid/walls.hpp"
#include "polder/material/drag.hpp"
#include "polder/material/law.hpp"

namespace polder {

/// Where the porosity of soil is held when its deformation would take it further.
inline constexpr double least_porosity = 0.2, most_porosity = 0.98;

struct SoilMaterial {
  std::shared_ptr<const SoilLaw> law;
  double grain_density = 2650;  ///< kg/m³
  double initial_porosity = 0.4;
  double max_porosity = 0.5;
  Drag drag[2];                 ///< horizontal, vertical
  double shear_share = 0.2857;  ///< G over the modulus of the drained P-wave
  bool fixed = false;           ///< grains do not move
};

/// How the pores of a material hold and conduct water under suction, and how stiff its grains are (unsaturated
/// formulation).
struct PoreSpace {
  Retention retention = LinearRetention{};
  ConductivityCurve curve = ConstantConductivity{};
  double modulus = 0;  ///< Pa, of the drained P-wave
};

/// A side of the model that moves, m/s as functions of time: along itself and into the model.
struct MovingSide {
  int axis, end;  ///< end 0: low, 1: high
  Table slide, push;
};

/// A side that free water rubs along, its boundary layer being thinner than a cell.
struct StickySide {
  int axis, end;  ///< end 0: low, 1: high
};

template <class Space>
struct Setup {
  Lattice<Space> lattice;
  PhaseBox soil_box, water_box;
  ThinWalls<Space> walls;  ///< those that stand now
  Bodies<Space> bodies;    ///< likewise
  std::vector<SoilMaterial> materials;
  WaterProperties water;
  std::vector<Reservoir<Space>> reservoirs;
  std::vector<OpenSide> open_sides;
  std::vector<GroundLoad> loads;
  std::vector<FrictionFace> friction;  ///< of the thin walls that stand now
  std::vector<WellCells> wells;        ///< those that are there now
  std::vector<Rain> rains;
  Numerics numerics;
  std::vector<MovingSide> moving_sides;
  std::vector<StickySide> sticky_sides;
  double gravity = 9.81;                           ///< m/s²
  double tilt = 0;                                 ///< rad, of gravity from the vertical towards +x
  bool weighs_bodies = false;                      ///< forces on bodies are asked for
  bool periodic = false;                           ///< along x
  int points_per_axis = 2;                         ///< of a full cell at the start
  bool single_point = false;                       ///< soil points carry the water of their pores
  bool unsaturated = false;                        ///< likewise, and their pores may hold air
  std::vector<PoreSpace> pores;                    ///< of the materials; unsaturated formulation
  std::vector<SeepageCondition> pore_water;        ///< along lines of the outline; likewise
  std::vector<std::array<double, 2>> water_table;  ///< at the start, (x, height) in m; likewise
  std::vector<double> start_pressure;              ///< Pa, at the start, of cells column by column; empty: still water
  double suction_limit = 1e300;                    ///< Pa, above the water table at the start; likewise
  bool anisotropic = false;                        ///< some material drains differently in the vertical
  double soil_step = 1e300;                        ///< s, CFL limit of the drained P-wave

  /// Whether nothing crosses this face, for a thin wall or a body that covers it.
  bool shut(int axis, std::ptrdiff_t face) const { return walls.blocked(axis, face) || bodies.closed(axis, face); }

  /// Whether boxes of points in free water stretch with the flow (docs/theory.md, "Step 8"): where no soil moves.
  bool stretches_water() const {
    return std::all_of(materials.begin(), materials.end(), [](const SoilMaterial& m) { return m.fixed; });
  }

  /// Whether strain and rotation are wanted to second order in the step: where a law follows them to any size.
  bool follows_large_strains() const {
    return std::any_of(materials.begin(), materials.end(),
                       [](const SoilMaterial& m) { return m.law && m.law->follows_large_strains(); });
  }

  /// Component of gravity, m/s².
  double pull(int axis) const {
    return axis == Space::up ? -gravity * std::cos(tilt) : axis == 0 && tilt != 0 ? gravity * std::sin(tilt) : 0;
  }

  /// Whether more than gravity downwards, loads and open sides does work on what is in the model.
  bool driven() const { return tilt != 0 || !moving_sides.empty(); }

  /// The walls' velocities at a time.
  void move_sides(double time) {
    for (const MovingSide& side : moving_sides)
      for (PhaseBox* box : {&soil_box, &water_box}) {
        auto& v = box->velocity[static_cast<std::size_t>(side.axis)][static_cast<std::size_t>(side.end)];
        v[side.axis == 0 ? Space::up : 0] = side.slide(time);
        v[static_cast<std::size_t>(side.axis)] = (side.end == 0 ? 1 : -1) * side.push(time);
      }
  }

  /// Velocity across it of the side at this end of an axis, m/s.
  double wall_velocity(int axis, int end) const {
    return water_box
        .velocity[static_cast<std::size_t>(axis)][static_cast<std::size_t>(end)][static_cast<std::size_t>(axis)];
  }

  /// Whether the ground goes on beyond this end of an axis.
  bool absorbs(int axis, int end) const { return soil_box.wall[axis][end] == WallKind::absorbing; }
  bool any_absorbs() const {
    for (int a = 0; a < Space::axes; ++a)
      if (absorbs(a, 0) || absorbs(a, 1)) return true;
    return false;
  }

  /// The open side at this end of an axis, or nullptr.
  const OpenSide* open_side(int axis, int end) const {
    for (const OpenSide& side : open_sides)
      if (side.axis == axis && side.end == end) return &side;
    return nullptr;
  }

  /// Bulk volume of a point at the start, m³: in the cell at this place or with this index; in the smallest cells.
  template <class Cell>
  double nominal_point_volume(const Cell& cell) const {
    return share_of_point(lattice.cell_volume(cell));
  }
  double nominal_point_volume() const { return share_of_point(lattice.cell_volume()); }

 private:
  double share_of_point(double cell_volume) const {
    for (int a = 0; a < Space::axes; ++a) cell_volume /= points_per_axis;
    return cell_volume;
  }
};

/// What a stage sets for each of its steps.
struct StepControl {
  double time = 0;  ///< s, at the end of the step
  double gravity_factor = 1;
  double damping = 0;        ///< 1/s on the soil's velocity
  double water_damping = 0;  ///< 1/s on the water's velocity
  double local_damping = 0;  ///< Cundall's factor on the soil's out-of-balance force
  bool hold_water = false;   ///< no horizontal flow of water
  /// m/s², on the soil beside gravity: component, place (x, y, z) in m and time in s; empty: none.
  std::function<double(int, const std::array<double, 3>&, double)> body_force{};
  double rest_force = 0;  ///< out-of-balance force over the weight at which the stage is at rest; 0: it does not ask
  bool event = true;      ///< not in an initial stage: absorbing sides let waves out
};

}  // namespace polder
