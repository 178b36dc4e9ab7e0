#include "polder/result/vtk_reader.hpp"

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "polder/result/atomic_file.hpp"
#include "polder/result/summary.hpp"

namespace polder {
namespace {

struct Array {
  std::string name, type;
  std::size_t components = 1, offset = 0;
};

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
  throw std::runtime_error(path.string() + ": " + reason);
}

std::string attribute(const std::string& element, const std::string& name) {
  const std::size_t key = element.find(" " + name + "=\"");
  if (key == std::string::npos) return "";
  const std::size_t begin = key + name.size() + 3;
  return element.substr(begin, element.find('"', begin) - begin);
}

std::size_t whole(const std::string& text) { return std::strtoull(text.c_str(), nullptr, 10); }

// The appended arrays that a header describes, in the order of the file: the points first.
std::vector<Array> arrays_of(const std::string& header) {
  std::vector<Array> arrays;
  for (std::size_t at = header.find("<DataArray "); at != std::string::npos; at = header.find("<DataArray ", at + 1)) {
    const std::string element = header.substr(at, header.find('>', at) - at);
    if (attribute(element, "format") != "appended") continue;
    arrays.push_back({attribute(element, "Name"), attribute(element, "type"),
                      whole(attribute(element, "NumberOfComponents")), whole(attribute(element, "offset"))});
  }
  return arrays;
}

struct File {
  std::filesystem::path path;
  std::string bytes;
  std::size_t data = 0;  ///< where the appended arrays begin
  std::size_t points = 0;

  template <class Stored, class Value>
  std::vector<Value> values(const Array& array) const {
    const std::size_t count = points * array.components, size = count * sizeof(Stored);
    const std::size_t begin = data + array.offset + sizeof(std::uint64_t);
    std::uint64_t stated = 0;
    if (begin + size > bytes.size()) fail(path, "the array '" + array.name + "' is cut off");
    std::memcpy(&stated, bytes.data() + begin - sizeof stated, sizeof stated);
    if (stated != size) fail(path, "the array '" + array.name + "' has another length than its header says");
    std::vector<Stored> stored(count);
    if (count > 0) std::memcpy(stored.data(), bytes.data() + begin, size);
    return {stored.begin(), stored.end()};
  }
  std::vector<double> reals(const Array& array) const {
    if (array.type == "Float64") return values<double, double>(array);
    if (array.type == "Float32") return values<float, double>(array);
    fail(path, "the array '" + array.name + "' has the type " + array.type);
  }
};

File opened(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail(path, "there is no such file");
  File file{path, {std::istreambuf_iterator<char>(stream), {}}};
  const std::string mark = "<AppendedData encoding=\"raw\">\n_";
  file.data = file.bytes.find(mark);
  if (file.data == std::string::npos) fail(path, "this is no snapshot of Polder");
  file.data += mark.size();
  const std::size_t piece = file.bytes.find("<Piece ");
  file.points = whole(attribute(file.bytes.substr(piece, file.bytes.find('>', piece) - piece), "NumberOfPoints"));
  return file;
}

std::filesystem::path section_path(const std::filesystem::path& folder) { return folder / "points" / "section.json"; }

}  // namespace

PointSet read_vtp(const std::filesystem::path& path) {
  const File file = opened(path);
  PointSet points;
  for (const Array& array : arrays_of(file.bytes.substr(0, file.data))) {
    if (array.name == "connectivity" || array.name == "offsets") continue;
    if (array.name == "id") {
      points.id = file.values<std::int64_t, std::uint64_t>(array);
      continue;
    }
    std::vector<double> values = file.reals(array);
    if (array.name == "Points") {
      for (std::size_t i = 0; i < values.size(); i += 3)
        points.position.push_back({values[i], values[i + 1], values[i + 2]});
    } else if (array.name == "volume") {
      points.volume = std::move(values);
    } else {
      points.fields.push_back(make_field(array.name, std::move(values), static_cast<int>(array.components)));
    }
  }
  return points;
}

void write_section(const std::filesystem::path& folder, const Frame& frame) {
  make_folder(folder / "points");
  const nlohmann::ordered_json json{{"title", frame.title},
                                    {"dimension", frame.dimension},
                                    {"size", frame.size},
                                    {"outlines", frame.outlines},
                                    {"walls", frame.walls}};
  write_atomically(section_path(folder), json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

Frame read_snapshot(const std::filesystem::path& folder, const VtkSeries& series, std::size_t number) {
  Frame frame;
  const nlohmann::ordered_json json = read_json(section_path(folder));
  try {
    frame.title = json.at("title");
    frame.dimension = json.at("dimension");
    frame.size = json.at("size").get<std::array<double, 3>>();
    frame.outlines = json.at("outlines").get<std::vector<Line2>>();
    frame.walls = json.at("walls").get<std::vector<Line2>>();
  } catch (const nlohmann::json::exception& error) {
    fail(section_path(folder), error.what());
  }
  frame.time = series.at(2 * number).time;
  frame.soil = read_vtp(folder / series.at(2 * number).file);
  frame.water = read_vtp(folder / series.at(2 * number + 1).file);
  return frame;
}

}  // namespace polder
