#pragma once
// Snapshots read back: for pictures and reports made after a run. Reads what vtk.hpp writes, not VTK files in general.
#include <filesystem>

#include "polder/result/frame.hpp"
#include "polder/result/vtk.hpp"

namespace polder {

/// The points of a .vtp; vectors have three components and tensors six, as in the file. Throws std::runtime_error
/// naming the file where it is none of ours, or incomplete.
PointSet read_vtp(const std::filesystem::path& path);

/// What all frames of a run share, points/section.json: dimension, size, title, outlines, walls. Throws OutputError.
void write_section(const std::filesystem::path& folder, const Frame& frame);

/// Snapshot number `number` of a series in a run's folder; without free surface lines, which snapshots do not hold.
/// Throws std::runtime_error where a file is missing or damaged.
Frame read_snapshot(const std::filesystem::path& folder, const VtkSeries& series, std::size_t number);

}  // namespace polder
