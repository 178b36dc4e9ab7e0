#pragma once
// One time step of the unsaturated formulation: soil points carry effective stress, porosity and the water of their
// pores; cells have one pressure, positive or suction, of which saturation and conductivity are functions.
// docs/theory.md, "Unsaturated soil".
#include <algorithm>

#include "polder/step/ground_water.hpp"
#include "polder/step/reservoirs.hpp"
#include "polder/step/unsaturated_transfer.hpp"

namespace polder {

inline constexpr double difference_cfl = 0.5;  ///< of the drained P-wave: cell differences are stiffer than splines
inline constexpr double thin_cell = 0.25;      ///< of a cell's volume: with less soil its host keeps its books
inline constexpr int dilation_passes = 2;

/// Inertia, kg, that V m³ of soil of modulus M need in a cell for a step: V M (Δt/(cfl h))².
template <class Space>
class NeededInertia {
 public:
  NeededInertia(const Lattice<Space>& lattice, double step)
      : lattice_(lattice), step_(step), in_smallest_(stretched(lattice.smallest_spacing())) {}

  double operator()(const std::array<int, 3>& cell, double volume, double modulus) const {
    const double s = lattice_.graded ? stretched(least_width(cell)) : in_smallest_;
    return volume * modulus * s * s;
  }

 private:
  double stretched(double h) const { return step_ / (difference_cfl * h); }
  double least_width(const std::array<int, 3>& cell) const {
    double h = lattice_.axis[0].width(cell[0]);
    for (int a = 1; a < Space::axes; ++a) h = std::min(h, lattice_.axis[a].width(cell[a]));
    return h;
  }

  const Lattice<Space>& lattice_;
  double step_, in_smallest_;
};

/// How fast the ground moves, and whether what steps longer than natural do to it still is at rest.
struct Calm {
  double unbalanced_now = 0;      ///< Σ|f| of the faces over the weight, of this step
  double energy_over_weight = 0;  ///< kinetic energy of the mass itself over the weight times a cell's height, likewise
  double unbalanced = 0;          ///< Σ|f| of the faces over the weight, smoothed over some ten steps
  double stretch = 1;             ///< of the step, now
  double inertial_number = 0;     ///< largest γ̇ h √(ρ*/p'), ρ* the density with the raised inertia, of this step
  double energy_ratio = 0;        ///< kinetic energy, with it, over the elastic one, Σ V σ':σ'/(2M)
  double worst_inertial_number = 0, worst_energy_ratio = 0;  ///< while inertia was raised, since the start
};

/// Pore pressure (Pa; suction negative) at x and a height, m, at the start: still water, suction up to its limit.
template <class Space>
double pressure_at_start(const Setup<Space>& setup, double x, double height);

template <class Space>
class UnsaturatedStep {
 public:
  UnsaturatedStep(const Setup<Space>& setup, SoilPoints<Space>& soil, GridFields<Space>& grid);

  /// The step that the ground's motion allows now, s.
  double natural_step(const Setup<Space>& setup) const;

  /// After soil was placed or excavated: which conditions of the pore water hold for the ground as it is now (a column
  /// that none is near keeps the one it had), and its weight.
  void ground_changed(const Setup<Space>& setup, const SoilPoints<Space>& soil);

  /// Whether all of these are conditions of the case.
  bool knows_conditions(const Setup<Space>& setup) const {
    const auto count = static_cast<std::int32_t>(setup.pore_water.size());
    return std::all_of(ground_.begin(), ground_.end(), [&](std::int32_t i) { return i >= -1 && i < count; });
  }

  /// Water over the pores, –, that the cells' pressures give a point if its soil were of this material.
  double filled_by(const Setup<Space>& setup, const SoilPoints<Space>& soil, std::size_t p, std::size_t material,
                   const GridFields<Space>& grid) const;

  /// Adaptive steps begin anew: a stage begins, loads may jump.
  void begin_stage() { calm.stretch = 1; }

  /// `cover`: free water on the ground, or nullptr. What has seeped out of the ground is added to its `gained`.
  SolveResult advance(const Setup<Space>& setup, const StepControl& control, double dt, const Tiling<Space>& tiling,
                      SoilPoints<Space>& soil, GridFields<Space>& grid, PressureSolver<Space>& solver, Team& team,
                      Motion& motion, std::vector<Exchange>& exchanged, GroundCover* cover = nullptr);

  /// Water pressure, Pa, at a place: heads linear between the cells' centres, upwards with a kink where the soil
  /// changes, so that what flows is the same on both sides; still water where one of them has no soil.
  double pressure_at(const Setup<Space>& setup, const GridFields<Space>& grid, const std::array<double, 3>& x) const;

  template <class Archive>
  void each_state(Archive&& archive) {
    archive("pores/active", pores.active);
    archive("pores/unbalanced", calm.unbalanced);
    archive("pores/stretch", calm.stretch);
    archive("pores/worst_inertial_number", calm.worst_inertial_number);
    archive("pores/worst_energy_ratio", calm.worst_energy_ratio);
    archive("pores/weight", weight_);
    archive("pores/ground", ground_);
  }

  PoreFields<Space> pores;
  Calm calm;

 private:
  double predict(const Setup<Space>& setup, const StepControl& control, double dt, bool standing_water,
                 GridFields<Space>& grid, Team& team);
  void settle_books(const Setup<Space>& setup, double dt, const std::vector<PoreExit>& exits, bool held,
                    GridFields<Space>& grid, Team& team, std::vector<Exchange>& exchanged, GroundCover* cover);
  void set_way(const Setup<Space>& setup, double dt, const GridFields<Space>& grid, Team& team);
  double water_on_body(const Setup<Space>& setup, const StepControl& control, const GridFields<Space>& grid, int axis,
                       std::ptrdiff_t face) const;
  void judge(const Setup<Space>& setup, const SoilPoints<Space>& soil, Team& team);
  void show_water(const Setup<Space>& setup, GridFields<Space>& grid, Team& team) const;

  std::vector<std::int32_t> ground_;  // number of the condition of each column's ground; −1: none is given
  double weight_ = 0;                 // N, of all soil at the start
};

}  // namespace polder
