#include "polder/result/vtk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <system_error>

#include "polder/result/atomic_file.hpp"

namespace polder {
namespace {

static_assert(std::endian::native == std::endian::little, "the header of a .vtp says LittleEndian");

int padded(int components) { return components == 2 ? 3 : components == 4 ? 6 : components; }

// Collects the descriptions of the arrays, with the offset at which each will lie, while the header is put together.
class Appended {
 public:
  std::string describe(std::string_view name, std::string_view type, int components, std::size_t bytes,
                       std::string_view more = "") {
    std::string text =
        fmt::format(R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="appended" offset="{}"{}/>)", type,
                    name, components, offset_, more);
    offset_ += sizeof(std::uint64_t) + bytes;
    return text + "\n";
  }

 private:
  std::size_t offset_ = 0;
};

template <class Number, class Value>
void append(AtomicFile& file, std::size_t count, Value&& value_at) {
  const std::uint64_t bytes = count * sizeof(Number);
  file.write(&bytes, sizeof bytes);
  std::vector<Number> chunk;
  constexpr std::size_t chunk_size = 1u << 15;
  for (std::size_t begin = 0; begin < count; begin += chunk_size) {
    const std::size_t end = std::min(count, begin + chunk_size);
    chunk.clear();
    for (std::size_t i = begin; i < end; ++i) chunk.push_back(static_cast<Number>(value_at(i)));
    file.write(chunk.data(), chunk.size() * sizeof(Number));
  }
}

template <class Real>
void append_field(AtomicFile& file, const PointField& field, std::size_t points) {
  const std::size_t from = static_cast<std::size_t>(field.components);
  const std::size_t to = static_cast<std::size_t>(padded(field.components));
  append<Real>(file, points * to, [&](std::size_t i) {
    const std::size_t component = i % to;
    return component < from ? field.values[i / to * from + component] : 0.0;
  });
}

template <class Real>
void write_points(const std::filesystem::path& path, const PointSet& points, double time) {
  const std::string_view real = sizeof(Real) == 8 ? "Float64" : "Float32";
  const std::size_t n = points.size();
  Appended appended;
  std::string header = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n"
      "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n"
      "</FieldData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"0\">\n<Points>\n",
      time, n, n);
  header += appended.describe("Points", real, 3, n * 3 * sizeof(Real));
  header += "</Points>\n<PointData>\n";
  header += appended.describe("id", "Int64", 1, n * sizeof(std::int64_t));
  header += appended.describe("volume", real, 1, n * sizeof(Real));
  for (const PointField& field : points.fields) {
    const int components = padded(field.components);
    header +=
        appended.describe(field.info.name, real, components, n * static_cast<std::size_t>(components) * sizeof(Real));
  }
  header += "</PointData>\n<Verts>\n";
  header += appended.describe("connectivity", "Int32", 1, n * sizeof(std::int32_t));
  header += appended.describe("offsets", "Int32", 1, n * sizeof(std::int32_t));
  header += "</Verts>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";

  AtomicFile file(path);
  file.write(header);
  append<Real>(file, 3 * n, [&](std::size_t i) { return points.position[i / 3][i % 3]; });
  append<std::int64_t>(file, n, [&](std::size_t i) { return points.id[i]; });
  append<Real>(file, n, [&](std::size_t i) { return points.volume[i]; });
  for (const PointField& field : points.fields) append_field<Real>(file, field, n);
  append<std::int32_t>(file, n, [](std::size_t i) { return i; });
  append<std::int32_t>(file, n, [](std::size_t i) { return i + 1; });
  file.write("\n</AppendedData>\n</VTKFile>\n");
  file.commit();
}

std::string attribute(const std::string& line, const std::string& name) {
  const std::size_t key = line.find(" " + name + "=\"");
  if (key == std::string::npos) return "";
  const std::size_t begin = key + name.size() + 3;
  return line.substr(begin, line.find('"', begin) - begin);
}

}  // namespace

void write_vtp(const std::filesystem::path& path, const PointSet& points, double time, VtkPrecision precision) {
  if (precision == VtkPrecision::float64)
    write_points<double>(path, points, time);
  else
    write_points<float>(path, points, time);
}

void write_pvd(const std::filesystem::path& path, const VtkSeries& series) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
      "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const VtkEntry& entry : series)
    text += fmt::format("<DataSet timestep=\"{}\" group=\"\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n", entry.time,
                        entry.part == "soil" ? 0 : 1, entry.part, entry.file);
  text += "</Collection>\n</VTKFile>\n";
  write_atomically(path, text);
}

VtkSeries read_pvd(const std::filesystem::path& path) {
  VtkSeries series;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
    if (line.rfind("<DataSet ", 0) == 0)
      series.push_back({std::strtod(attribute(line, "timestep").c_str(), nullptr), attribute(line, "name"),
                        attribute(line, "file")});
  return series;
}

void add_snapshot(const std::filesystem::path& folder, VtkSeries& series, const Frame& frame, VtkPrecision precision) {
  check_frame(frame);
  make_folder(folder / "points");
  const std::size_t number = series.size() / 2;
  const auto add = [&](const char* part, const PointSet& points) {
    const std::string file = fmt::format("points/{}_{:05d}.vtp", part, number);
    write_vtp(folder / file, points, frame.time, precision);
    series.push_back({frame.time, part, file});
  };
  add("soil", frame.soil);
  add("water", frame.water);
  write_pvd(folder / "points.pvd", series);
}

VtkSeries resume_series(const std::filesystem::path& folder, double time) {
  const VtkSeries old = read_pvd(folder / "points.pvd");
  VtkSeries kept;
  for (const VtkEntry& entry : old)
    if (entry.time <= time) kept.push_back(entry);
  if (kept.size() == old.size()) return kept;
  write_pvd(folder / "points.pvd", kept);
  std::error_code ignored;
  for (const VtkEntry& entry : old)
    if (entry.time > time) std::filesystem::remove(folder / entry.file, ignored);
  return kept;
}

}  // namespace polder
