#include "polder/report/run_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "polder/report/player_fields.hpp"
#include "polder/result/vtk.hpp"
#include "polder/result/vtk_reader.hpp"

namespace polder {
namespace {

namespace fs = std::filesystem;

/// Points of a .vtp from its header, without reading the data.
double count_points(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(4096, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  const std::string key = "NumberOfPoints=\"";
  const std::size_t at = head.find(key);
  return at == std::string::npos ? 0 : std::strtod(head.c_str() + at + key.size(), nullptr);
}

/// A number in [0, 1) that depends on the id alone (the finaliser of splitmix64).
double lot(std::uint64_t id) {
  id += 0x9e3779b97f4a7c15ull;
  id = (id ^ (id >> 30)) * 0xbf58476d1ce4e5b9ull;
  id = (id ^ (id >> 27)) * 0x94d049bb133111ebull;
  return static_cast<double>((id ^ (id >> 31)) >> 11) * 0x1p-53;
}

double median_volume(const PointSet& points) {
  std::vector<double> volume = points.volume;
  if (volume.empty()) return 0;
  const auto middle = volume.begin() + static_cast<std::ptrdiff_t>(volume.size() / 2);
  std::nth_element(volume.begin(), middle, volume.end());
  return *middle;
}

/// Which points of a frame are shown.
struct Choice {
  double share = 1;
  bool slice = false;
  double middle = 0, half_width = 0;  ///< m, across

  bool takes(const PointSet& points, std::size_t p) const {
    if (slice && std::abs(points.position[p][1] - middle) > half_width) return false;
    return share >= 1 || lot(points.id[p]) < share;
  }
  /// Side of the square in the section that a shown point stands for. The layers of a slice lie behind each other, so
  /// each of its points is as wide as it is.
  double spacing(double volume) const {
    const double shown = std::min(1.0, share);
    return slice ? std::cbrt(volume) / std::sqrt(shown) : std::sqrt(volume / shown);
  }
};

class Collector {
 public:
  Collector(PointSeries& series, const char* name) : series_(series) { series.name = name; }

  void add(const PointSet& points, const Choice& choice, int up, const std::vector<std::string>& material_names) {
    if (columns_.empty() && points.size() > 0) {
      columns_ = player_columns(points, up, material_names);
      for (const PlayerColumn& column : columns_) series_.fields.push_back({column.info, {}});
    }
    std::vector<std::size_t> chosen;
    for (std::size_t p = 0; p < points.size(); ++p)
      if (choice.takes(points, p)) chosen.push_back(p);
    for (const std::size_t p : chosen) series_.id.push_back(points.id[p]);
    for (std::size_t c = 0; c < columns_.size(); ++c)
      append_values(columns_[c], points, chosen, series_.fields[c].values);
    series_.frame_start.push_back(series_.id.size());
  }

 private:
  PointSeries& series_;
  std::vector<PlayerColumn> columns_;
};

/// Every k-th snapshot, and the last.
std::vector<std::size_t> chosen_snapshots(std::size_t count, std::size_t most) {
  const std::size_t every = std::max<std::size_t>(1, (count + most - 1) / most);
  std::vector<std::size_t> numbers;
  for (std::size_t n = 0; n < count; n += every) numbers.push_back(n);
  if (!numbers.empty() && numbers.back() != count - 1) numbers.push_back(count - 1);
  return numbers;
}

Choice choose(const Frame& first, double most_points, std::size_t frames, const PageLimits& limits) {
  Choice choice;
  if (first.dimension == 3) {
    const double volume = std::max(median_volume(first.soil), median_volume(first.water));
    choice.slice = true;
    choice.middle = first.size[1] / 2;
    choice.half_width = std::cbrt(volume);
    most_points *= std::min(1.0, 2 * choice.half_width / first.size[1]);
  }
  const double allowed = std::min(limits.points, limits.entries / static_cast<double>(frames));
  choice.share = std::min(1.0, allowed / std::max(1.0, most_points));
  return choice;
}

void note_choice(RunPoints& run, const Choice& choice, std::size_t snapshots) {
  if (choice.slice)
    run.notes.push_back(
        fmt::format("A run in three dimensions: shown are the points within {:.3g} m of the plane y = {:.3g} m.",
                    choice.half_width, choice.middle));
  if (choice.share < 1)
    run.notes.push_back(fmt::format(
        "Too many points for a page: one in {:.3g} is shown, chosen by its number, the same in every frame. Nothing is "
        "left out of the numbers, the curves and the snapshots in points.pvd.",
        1 / choice.share));
  if (run.times.size() < snapshots)
    run.notes.push_back(fmt::format("Of {} snapshots, {} are shown.", snapshots, run.times.size()));
}

}  // namespace

RunPoints read_run_points(const fs::path& folder, const std::vector<std::string>& material_names,
                          const PageLimits& limits) {
  RunPoints run;
  const VtkSeries series = read_pvd(folder / "points.pvd");
  const std::size_t snapshots = series.size() / 2;
  const std::vector<std::size_t> numbers = chosen_snapshots(snapshots, limits.frames);
  double most_points = 0;
  for (const std::size_t n : numbers)
    most_points = std::max(most_points,
                           count_points(folder / series[2 * n].file) + count_points(folder / series[2 * n + 1].file));

  Collector soil(run.soil, "soil"), water(run.water, "water");
  Choice choice;
  for (const std::size_t n : numbers) {
    const Frame frame = read_snapshot(folder, series, n);
    const int up = frame.dimension == 3 ? 2 : 1;
    if (run.times.empty()) {
      choice = choose(frame, most_points, numbers.size(), limits);
      run.title = frame.title;
      run.dimension = frame.dimension;
      run.size = {frame.size[0], frame.size[static_cast<std::size_t>(up)]};
      run.outlines = frame.outlines;
      run.walls = frame.walls;
      run.first = soil_shape(frame.soil, up);
      run.soil_spacing = choice.spacing(median_volume(frame.soil));
    }
    if (run.water_spacing == 0) run.water_spacing = choice.spacing(median_volume(frame.water));
    run.last = soil_shape(frame.soil, up);
    run.times.push_back(frame.time);
    soil.add(frame.soil, choice, up, material_names);
    water.add(frame.water, choice, up, material_names);
  }
  note_choice(run, choice, snapshots);
  return run;
}

}  // namespace polder
