#include "polder/report/tracks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace polder {
namespace {

struct Sighting {
  std::uint64_t id;
  std::uint32_t frame;
  std::size_t entry;
};

std::vector<Sighting> sightings_by_id(const PointSeries& series) {
  std::vector<Sighting> all;
  all.reserve(series.entries());
  for (std::size_t frame = 0; frame < series.frames(); ++frame)
    for (std::size_t e = series.frame_start[frame]; e < series.frame_start[frame + 1]; ++e)
      all.push_back({series.id[e], static_cast<std::uint32_t>(frame), e});
  std::sort(all.begin(), all.end(),
            [](const Sighting& a, const Sighting& b) { return a.id != b.id ? a.id < b.id : a.frame < b.frame; });
  return all;
}

}  // namespace

TrackedOrder order_by_track(const PointSeries& series) {
  TrackedOrder order;
  std::vector<std::uint32_t> track_of(series.entries());
  for (const Sighting& s : sightings_by_id(series)) {
    const bool same_id = !order.tracks.empty() && order.tracks.back().id == s.id;
    if (same_id && order.tracks.back().last == s.frame)
      throw std::invalid_argument(
          fmt::format("{} point {} occurs twice in frame {}: ids must be unique", series.name, s.id, s.frame));
    if (same_id && order.tracks.back().last + 1 == s.frame)
      order.tracks.back().last = s.frame;
    else
      order.tracks.push_back({s.id, s.frame, s.frame});
    track_of[s.entry] = static_cast<std::uint32_t>(order.tracks.size() - 1);
  }

  order.frame_start = series.frame_start;
  order.entry.resize(series.entries());
  order.track.resize(series.entries());
  for (std::size_t e = 0; e < series.entries(); ++e) order.entry[e] = e;
  for (std::size_t frame = 0; frame < series.frames(); ++frame)
    std::sort(order.entry.begin() + static_cast<std::ptrdiff_t>(series.frame_start[frame]),
              order.entry.begin() + static_cast<std::ptrdiff_t>(series.frame_start[frame + 1]),
              [&](std::size_t a, std::size_t b) { return track_of[a] < track_of[b]; });
  for (std::size_t place = 0; place < order.entry.size(); ++place) order.track[place] = track_of[order.entry[place]];
  return order;
}

}  // namespace polder
