#pragma once
// The bounds within which a run may be believed. What no physics can cause stops the run (RunFailure); what it can is
// remembered as a warning, with the place and time of the first and the value of the worst.
#include <string>
#include <vector>

#include "polder/stage/audit.hpp"

namespace polder {

/// A run that cannot go on: what, where and when.
struct RunFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The bounds, as shares. docs/reliability.md says what provokes each.
struct GuardLimits {
  static constexpr double water_balance = 1e-6;  ///< of the water at the start
  static constexpr double solid_mass = 1e-6;     ///< of the mass at the start
  static constexpr double flux_balance = 0.05;   ///< of the largest volume that has passed, once that is something:
  static constexpr double flux_counts = 0.01;    ///< of the water at the start
  static constexpr double overfilled = 0.05;     ///< of the wet cells
  static constexpr double porosity = 0.01;       ///< of the soil points, at the ends of the porosity's range
  static constexpr double energy = 0.05;         ///< of the energy at the start and the work since
};

/// A quantity that may pass its bound.
struct Warning {
  double first_time = 0;  ///< s
  double worst = 0;       ///< 0: never beyond the bound
  double x = 0, height = 0;
};

template <class Space>
class Guards {
 public:
  explicit Guards(const Stepper<Space>& state) { begin_event(state); }

  /// The energy from which growth counts: at the start, and where the initial stages end.
  void begin_event(const Stepper<Space>& state);

  /// Before a step, with the state as the last one (or a checkpoint) left it. Throws RunFailure.
  void before_step(const Stepper<Space>& state, double time) const;

  /// After a step. `unsound`: what unsound_point() found. `event`: gravity is not being raised, so that energy can be
  /// compared. Throws RunFailure.
  void take(const Stepper<Space>& state, const Audit<Space>& audit, const StepReport& report,
            const std::string& unsound, double time, bool event);

  /// Sentences for the user.
  std::vector<std::string> warnings() const;

  /// Kinetic and potential energy now over what it may at most be, J (per metre in plane strain).
  double energy_now = 0, energy_allowed = 0;

  template <class Archive>
  void each_state(Archive&& archive) {
    archive("guards/energy_at_start", energy_at_start_);
    archive("guards/strain_energy", strain_energy_);
    archive("guards/work", work_);
    const auto warning = [&](const std::string& name, Warning& w) {
      archive("guards/" + name + "/first_time", w.first_time);
      archive("guards/" + name + "/worst", w.worst);
      archive("guards/" + name + "/x", w.x);
      archive("guards/" + name + "/height", w.height);
    };
    warning("flux", flux_);
    warning("overfilled", overfilled_);
    warning("porosity", porosity_);
  }

 private:
  void check_solve(const Stepper<Space>& state, const StepReport& report, double time) const;
  void check_balances(const Stepper<Space>& state, const Audit<Space>& audit, double time) const;
  void check_energy(const Stepper<Space>& state, double time);
  void note_limits(const Stepper<Space>& state, const Audit<Space>& audit, double time);
  void add_work(const Stepper<Space>& state, double time, double dt);

  double energy_at_start_ = 0;  ///< J
  double strain_energy_ = 0;    ///< J, that the initial stress may give back
  double work_ = 0;             ///< J, at most, by water that enters and by loads on the ground
  Warning flux_, overfilled_, porosity_;
};

}  // namespace polder
