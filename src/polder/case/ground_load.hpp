#pragma once
// Where a load on the ground presses, and how much.
#include <algorithm>

#include "polder/case/model.hpp"

namespace polder {

/// m, the part of x that the load may reach while it is there.
inline std::array<double, 2> reach_of(const GroundLoad& load, const Model& model) {
  double end = 0;
  for (std::size_t s = 0; s < model.stages.size(); ++s)
    if (!model.stages[s].initial && (load.until_stage < 0 || s < static_cast<std::size_t>(load.until_stage)))
      end += model.stages[s].duration;
  return {std::min(load.span[0], load.span[0] + load.speed * end),
          std::max(load.span[1], load.span[1] + load.speed * end)};
}

/// Pa at `time` on ground that is at x now and was at `x_start` at the start (m), mean over `width` of a travelling
/// load.
inline double pressure_on(const GroundLoad& load, double time, double x, double x_start, double width) {
  const double moved = load.speed * std::max(0.0, time), from = load.span[0] + moved, to = load.span[1] + moved;
  double share = 1;
  if (load.speed != 0) share = std::max(0.0, std::min(x + 0.5 * width, to) - std::max(x - 0.5 * width, from)) / width;
  const double begin = load.pressure(time);
  if (!load.pressure_at_end) return share * begin;
  const double place = std::clamp(((load.speed != 0 ? x : x_start) - from) / (to - from), 0.0, 1.0);
  return share * (begin + place * ((*load.pressure_at_end)(time)-begin));
}

}  // namespace polder
