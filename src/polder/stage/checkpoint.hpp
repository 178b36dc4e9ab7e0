#pragma once
// The state of a run as the bytes of an HDF5 file, followed by a checksum. The checksum is verified before HDF5 sees
// the bytes; what is restored continues bit for bit.
#include <cstdint>
#include <stdexcept>
#include <string>

#include "polder/stage/simulation.hpp"

namespace polder {

/// Where the writing of results stood.
struct OutputState {
  std::uint64_t history_rows = 0;
  std::uint64_t next_history = 0, next_snapshot = 0, next_picture = 0;  ///< numbers of what is due next
  double wall_seconds = 0;
  double last_dt = 0;                     ///< s
  std::vector<std::uint64_t> followed{};  ///< ids of the soil points that monitors follow
};

/// A checkpoint that cannot be used: what is wrong with it.
struct CheckpointError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// `case_text` identifies the case: a checkpoint is restored only into the same one.
template <class Space>
std::string checkpoint_bytes(Simulation<Space>& run, const OutputState& output, const std::string& case_text);

/// Throws CheckpointError; `run` is then unusable.
template <class Space>
OutputState restore_checkpoint(const std::string& bytes, Simulation<Space>& run, const std::string& case_text);

/// FNV-1a, 64 bits.
std::uint64_t checksum(const char* bytes, std::size_t count);

}  // namespace polder
