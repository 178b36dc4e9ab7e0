#pragma once
// A run: the stages of a case, one step at a time. Time is 0 where the first stage that is not `initial` begins;
// initial stages run before it, at negative times.
#include <functional>
#include <string>
#include <vector>

#include "polder/stage/guards.hpp"

namespace polder {

/// How a stage ended.
struct StageEnd {
  std::string name;
  double seconds;   ///< that it lasted
  double restless;  ///< it should have come to rest and did not: its out-of-balance force over the weight; else 0
};

template <class Space>
class Simulation {
 public:
  Simulation(const Model& model, int threads);

  const Model& model() const { return model_; }
  double time() const { return time_; }  ///< s
  double end_time() const { return end_time_; }
  bool finished() const { return stage_ >= model_.stages.size(); }
  std::uint64_t stage_number() const { return stage_; }
  const Stage* stage() const { return finished() ? nullptr : &model_.stages[stage_]; }

  /// One step of the current stage; at its end, the next one begins. Throws RunFailure.
  StepReport advance();

  /// Of the stages that are over.
  std::vector<StageEnd> stage_ends() const;

  /// Water pressure, Pa, at a position: that of its cell, which is 0 where it is dry.
  double pressure_at(const std::array<double, 3>& x) const;

  /// Everything that the rest of the run depends on, by name: archive(name, value or array).
  template <class Archive>
  void each_state(Archive&& archive) {
    stepper_.each_state(archive);
    audit_.each_state(archive);
    guards_.each_state(archive);
    archive("stage", stage_);
    archive("time", time_);
    archive("time_in_stage", time_in_stage_);
    archive("calm_steps", calm_steps_);
    archive("stage_ends", stage_ends_);
    archive("restless", restless_);
  }
  /// After each_state() has filled in values from a file: what would lead the next steps astray; empty: nothing.
  std::string flaw();
  /// After each_state() has restored the values.
  void restored() {
    stepper_.restored();
    set_numerics();
    raise_walls();
  }

  /// After the state was changed from outside: what audit and guards compare with is the state now.
  void begin_anew() {
    audit_ = Audit<Space>(model_, stepper_);
    guards_.begin_event(stepper_);
  }
  /// m/s² on the soil beside gravity, of component, place and time; empty: none. For manufactured solutions.
  std::function<double(int, const std::array<double, 3>&, double)> body_force{};

  Stepper<Space>& state() { return stepper_; }
  const Stepper<Space>& state() const { return stepper_; }
  const Audit<Space>& audit() const { return audit_; }
  const Guards<Space>& guards() const { return guards_; }

 private:
  void end_stage();
  void begin_event();
  void begin_stage();
  void set_numerics();
  void raise_walls();
  double to_next_gate() const;
  double step_of_bodies(double dt) const;

  Model model_;
  Stepper<Space> stepper_;
  Audit<Space> audit_;
  Guards<Space> guards_;
  bool bodies_move_ = false;
  std::vector<bool> standing_;  ///< of the model's walls, in the stepper's set-up
  std::uint64_t stage_ = 0, calm_steps_ = 0;
  Array stage_ends_;  ///< s in each stage when it ended; −1: it has not
  Array restless_;    ///< of stages that should have come to rest and did not: Unrest::force at their end; else 0
  double time_ = 0, end_time_ = 0, time_in_stage_ = 0;
};

}  // namespace polder
