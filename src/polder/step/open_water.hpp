#pragma once
// Free water on unsaturated ground.
//
// It moves by the step of free water, in a Stepper of its own, to which the ground is a rigid body: its outline runs
// through the tops of the columns of soil and is drawn anew when they have moved. The balance of the pores sees the
// water's pressure on the ground (GroundCover), and what seeps in or out goes through an account per column, into and
// out of points. Points, pores and accounts together hold the water to round-off. docs/theory.md, "Free water on
// unsaturated ground".
#include <memory>
#include <vector>

#include "polder/points/point_sets.hpp"
#include "polder/step/ground_water.hpp"
#include "polder/step/reservoirs.hpp"

namespace polder {

template <class Space>
class Stepper;

/// The ground that free water sees, as a polygon through the tops of the columns (m, as by ground_heights()) in their
/// middles, with a step at thin walls and where it is upright; empty without any soil.
template <class Space>
std::vector<Point2> ground_outline(const Setup<Space>& setup, const Array& heights);

template <class Space>
class OpenWater {
 public:
  /// Whether a case of the unsaturated formulation has free water, or something that may bring it.
  static bool wanted(const Setup<Space>& setup, const WaterPoints<Space>& water);

  OpenWater(const Setup<Space>& setup, const SoilPoints<Space>& soil, std::size_t water_points, int threads);
  ~OpenWater();

  double natural_step() const;  ///< s

  /// The water's step, and `cover` for the ground's. Adds what rain, sides and reservoirs brought to `exchanged`.
  void advance(const Setup<Space>& setup, const StepControl& control, double dt, WaterPoints<Space>& water,
               std::vector<Exchange>& exchanged);

  /// After the ground's step: books what it gave and took and what has evaporated, and follows its surface.
  void follow(const Setup<Space>& setup, const Array& bulk, std::vector<Exchange>& exchanged);

  /// Adds the free water to what drawings and monitors read of the ground's grid.
  void show(const Setup<Space>& setup, const PoreFields<Space>& pores, GridFields<Space>& grid) const;

  /// Whether a place lies over the ground, and the pressure there, Pa.
  bool covers(const std::array<double, 3>& x) const;
  double pressure_at(const std::array<double, 3>& x) const;

  double booked() const;  ///< m³ in the accounts
  bool unsorted() const;  ///< points have come that no cell has been found for
  void points_changed();
  void walls_changed() { stale_ = true; }
  void restored(WaterPoints<Space>& water);
  bool sound() const;  ///< what a checkpoint brought can be

  template <class Archive>
  void each_state(Archive&& archive) {
    inner_->each_own_state([&](const std::string& name, auto& value) { archive("open/" + name, value); });
    archive("open/account", account_);
    archive("open/ground", ground_);
  }

  GroundCover cover;

 private:
  void rebuild(const Setup<Space>& setup);
  void let_it_rain(const Setup<Space>& setup, double time, double dt, std::vector<Exchange>& exchanged);
  void settle(double dt);
  void pay(const std::vector<std::ptrdiff_t>& cells, int aside, double share);
  double share_paid(double dt) const;
  void emit(std::size_t column);
  double depth_over(std::size_t column, double bottom) const;
  void level_out(const Array& bottom, Array& level) const;
  void set_cover(double gravity);

  std::unique_ptr<Stepper<Space>> inner_;  // its points are those of the run while it steps
  Array account_;                          // m³ that each column owes to its free water; below 0: is owed
  Array ground_;                           // m, tops of the columns as the body has them; −1: no soil
  std::vector<std::ptrdiff_t> surface_;    // lowest cell of each column that the ground leaves open
  Array on_ground_, wanted_by_air_;        // m³ of the step: free water on each column's ground; what may evaporate
  bool stale_ = true;                      // the body is not that of ground_, or the walls are others
};

}  // namespace polder
