#pragma once
// A Frame from the state of a run: the fields that snapshots, pictures and the report show.
#include "polder/result/frame.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {

template <class Space>
Frame frame_of(const Simulation<Space>& run);

/// Hash of everything that makes up the state of the points, whatever their order.
template <class Space>
std::uint64_t hash_of(const Simulation<Space>& run);

}  // namespace polder
