#pragma once
// The columns of history.csv: what every run records, then the case's own monitors.
#include <vector>

#include "polder/result/history.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {

/// Energies of a state, J (per metre in plane strain).
struct Energies {
  double soil_kinetic = 0, water_kinetic = 0, potential = 0;
};

template <class Space>
Energies energies(const Simulation<Space>& run);

template <class Space>
class Monitors {
 public:
  /// Fixes which points the monitors follow. Before the first step of the event (after the initial stages). A run that
  /// goes on gives what followed() was then, since the ground may have changed.
  explicit Monitors(const Simulation<Space>& run, const std::vector<std::uint64_t>& followed = {});

  /// Ids of the soil points that the monitors' places follow, in their order.
  std::vector<std::uint64_t> followed() const;

  const std::vector<HistoryColumn>& columns() const { return columns_; }
  std::vector<double> sample(const Simulation<Space>& run, double dt) const;

 private:
  struct Follower {
    const Monitor* monitor;
    std::size_t place;      // index into Monitor::at
    std::uint64_t soil_id;  // of the point it follows
    bool follows;
  };
  Model model_;  // owns the monitors that followers point to
  std::vector<HistoryColumn> columns_;
  std::vector<Follower> followers_;
  std::vector<std::vector<std::uint64_t>> members_;  // per integral: ids of the soil of a settlement, sorted
  std::vector<std::vector<double>> before_;          // per integral: heights at the start, for an eroded area
};

}  // namespace polder
