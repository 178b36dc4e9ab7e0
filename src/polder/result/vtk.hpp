#pragma once
// Snapshots for ParaView: points/soil_<n>.vtp and points/water_<n>.vtp, gathered over time by points.pvd.
//
// Soil and water are two named parts of the collection and not one file with a phase array: they carry different
// fields (water has no stress), each can be hidden, coloured and sized on its own in ParaView's multi-block inspector
// without a threshold filter, and either series opens alone.
#include <filesystem>
#include <string>
#include <vector>

#include "polder/result/frame.hpp"

namespace polder {

enum class VtkPrecision { float32, float64 };

struct VtkEntry {
  double time = 0;   ///< s
  std::string part;  ///< "soil" or "water"
  std::string file;  ///< relative to the .pvd
};

/// The index of a series of snapshots, as in points.pvd.
using VtkSeries = std::vector<VtkEntry>;

/// One set of points as PolyData with a vertex per point, raw-appended, little-endian; the time is in the field data.
/// Vectors are padded to three components and tensors to six (xx, yy, zz, xy, yz, xz), as ParaView names them.
/// Throws OutputError.
void write_vtp(const std::filesystem::path& path, const PointSet& points, double time, VtkPrecision precision);

/// Writes a frame's two files as number `series.size() / 2`, then the index with them added. The index never names a
/// file that is not complete. Throws OutputError.
void add_snapshot(const std::filesystem::path& folder, VtkSeries& series, const Frame& frame,
                  VtkPrecision precision = VtkPrecision::float32);

/// Throws OutputError.
void write_pvd(const std::filesystem::path& path, const VtkSeries& series);

/// The entries of an index that write_pvd wrote; empty where there is no such file.
VtkSeries read_pvd(const std::filesystem::path& path);

/// For a resumed run: drops the snapshots later than `time` from the index and from the disk. Throws OutputError.
VtkSeries resume_series(const std::filesystem::path& folder, double time);

}  // namespace polder
