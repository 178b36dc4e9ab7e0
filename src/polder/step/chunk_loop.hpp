#pragma once
// Loops over points, tile by tile and there chunk by chunk.
#include "polder/points/tiles.hpp"
#include "polder/step/chunk.hpp"

namespace polder {

/// Runs body(first point, count) over chunks of every tile, colour after colour.
template <class Space, class Body>
void over_chunks(const Tiling<Space>& tiling, Team& team, Body&& body) {
  for (const auto& tiles : tiling.by_colour)
    team.each(static_cast<std::ptrdiff_t>(tiles.size()), [&](std::ptrdiff_t t) {
      const TileRange range = tiles[t];
      for (std::uint32_t done = 0; done < range.count; done += chunk_size)
        body(std::size_t{range.first} + done, std::min(chunk_size, static_cast<int>(range.count - done)));
    });
}

}  // namespace polder
