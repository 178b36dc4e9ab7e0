#include "polder/result/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace polder {

namespace {

std::string duration(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", seconds);
  if (seconds < 6000) return fmt::format("{:.0f} min {:02.0f} s", std::floor(seconds / 60), std::fmod(seconds, 60));
  return fmt::format("{:.0f} h {:02.0f} min", std::floor(seconds / 3600), std::fmod(seconds, 3600) / 60);
}

}  // namespace

std::string progress_line(const ProgressState& s, double wall_seconds) {
  const double done = std::clamp((s.time - s.begin) / std::max(s.end - s.begin, 1e-300), 0.0, 1.0);
  const std::string left = done > 1e-3 ? duration(wall_seconds * (1 - done) / done) + " left" : "";
  return fmt::format(
      "t {:.4g} s of {:g} s ({:.0f} %)   step {}   Δt {:.3g} ms   {:.2f} M point-steps/s   {}   water balance {:.0e}",
      s.time, s.end, 100 * done, s.step, 1e3 * s.dt, 1e-6 * s.point_steps / std::max(wall_seconds, 1e-9), left,
      s.water_balance);
}

Progress::Progress(bool quiet)
    : quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) != 0),
      interval_(terminal_ ? 0.2 : 10),
      start_(std::chrono::steady_clock::now()),
      last_(start_) {}

void Progress::print(const std::string& line) {
  if (terminal_) {
    fmt::print(stderr, "\r\033[K{}", line);
    open_ = true;
  } else {
    fmt::print(stderr, "{}\n", line);
  }
  std::fflush(stderr);
}

void Progress::finish() {
  if (open_) fmt::print(stderr, "\n");
  open_ = false;
}

double Progress::wall_seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

}  // namespace polder
