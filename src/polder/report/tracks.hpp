#pragma once
// A track is a point's stay in the run: the frames from the one where its id appears to the one where it is last seen.
//
// Storing tracks instead of ids per frame costs four bytes per point and run, and lets every later value of a point be
// predicted from its earlier one. An id that vanishes and returns makes a second track.
#include <cstdint>
#include <vector>

#include "polder/report/series.hpp"

namespace polder {

struct Track {
  std::uint64_t id = 0;
  std::uint32_t first = 0, last = 0;  ///< frames, inclusive
};

struct TrackedOrder {
  std::vector<Track> tracks;  ///< by id, then by first frame
  /// Entry of the series at each place of the new order: frame after frame, tracks ascending within a frame.
  std::vector<std::size_t> entry;
  std::vector<std::uint32_t> track;      ///< track at each place of the new order
  std::vector<std::size_t> frame_start;  ///< places of frame f are [frame_start[f], frame_start[f + 1])
};

/// Throws std::invalid_argument where an id occurs twice in one frame.
TrackedOrder order_by_track(const PointSeries& series);

}  // namespace polder
