#pragma once
// The progress line: time, step, speed, time left, water balance.
#include <chrono>
#include <cstdint>
#include <string>

namespace polder {

struct ProgressState {
  double time = 0, begin = 0, end = 0;  ///< s, of the run
  std::uint64_t step = 0;
  double dt = 0;             ///< s
  double point_steps = 0;    ///< since the start
  double water_balance = 0;  ///< relative
};

/// "t 3.25 s of 23 s (18 %)   step 2 074   Δt 1.57 ms   3.1 M point-steps/s   34 s left   water balance 1e-16".
std::string progress_line(const ProgressState& state, double wall_seconds);

/// Prints the line to standard error: in place on a terminal, every ten seconds elsewhere.
class Progress {
 public:
  explicit Progress(bool quiet);
  /// `state()` is called only when a line is due.
  template <class State>
  void show(State&& state) {
    const auto now = std::chrono::steady_clock::now();
    if (quiet_ || std::chrono::duration<double>(now - last_).count() < interval_) return;
    last_ = now;
    print(progress_line(state(), std::chrono::duration<double>(now - start_).count()));
  }
  /// Ends the line, if one is open.
  void finish();
  double wall_seconds() const;

 private:
  void print(const std::string& line);
  bool quiet_, terminal_, open_ = false;
  double interval_;
  std::chrono::steady_clock::time_point start_, last_;
};

}  // namespace polder
