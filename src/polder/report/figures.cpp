#include "polder/report/figures.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "polder/result/atomic_file.hpp"
#include "polder/result/paint.hpp"
#include "polder/result/picture.hpp"
#include "polder/result/summary.hpp"
#include "polder/result/vtk_reader.hpp"

namespace polder {
namespace {

namespace fs = std::filesystem;

std::vector<double> times_of_case(const fs::path& folder) {
  if (!fs::exists(folder / "summary.json")) return {};
  const nlohmann::ordered_json summary = read_json(folder / "summary.json");
  std::vector<double> times;
  if (const auto found = summary.find("case"); found != summary.end() && found->contains("output"))
    for (const auto& time : (*found)["output"].value("pictures", nlohmann::ordered_json::array()))
      times.push_back(time.get<double>());
  return times;
}

/// Snapshots to draw by number, each with the time that names its files: the one asked for where the snapshot was
/// meant for it (a step ends a little later), otherwise the snapshot's own.
std::map<std::size_t, double> chosen_snapshots(const fs::path& folder, const VtkSeries& series,
                                               const FigureOptions& options) {
  const std::size_t count = series.size() / 2;
  const auto time_of = [&](std::size_t n) { return series[2 * n].time; };
  const double interval = (time_of(count - 1) - time_of(0)) / std::max(1.0, static_cast<double>(count - 1));
  const std::vector<double> times = options.times.empty() ? times_of_case(folder) : options.times;
  std::map<std::size_t, double> chosen;
  if (options.all_times)
    for (std::size_t n = 0; n < count; ++n) chosen.emplace(n, time_of(n));
  else if (times.empty())
    for (std::size_t k = 0; k < 5; ++k) chosen.emplace(k * (count - 1) / 4, time_of(k * (count - 1) / 4));
  else
    for (const double time : times) {
      std::size_t nearest = 0;
      for (std::size_t n = 1; n < count; ++n)
        if (std::abs(time_of(n) - time) < std::abs(time_of(nearest) - time)) nearest = n;
      const bool meant = std::abs(time_of(nearest) - time) < 0.05 * interval;
      chosen.emplace(nearest, meant ? time : time_of(nearest));
    }
  return chosen;
}

std::vector<PictureField> chosen_fields(const Frame& frame, const std::vector<std::string>& names) {
  if (names.empty()) return standard_pictures(frame);
  std::vector<PictureField> fields;
  for (const std::string& name : names) {
    fields.push_back(picture_field(name));
    if (frame.soil.find(fields.back().name) || frame.water.find(fields.back().water)) continue;
    std::vector<std::string> there;
    for (const PointField& field : frame.soil.fields) there.push_back(field.info.name);
    throw std::invalid_argument(
        fmt::format("--fields: the snapshots have no field '{}'; there are: {}", name, fmt::join(there, ", ")));
  }
  return fields;
}

}  // namespace

std::vector<fs::path> write_figures(const fs::path& folder, const FigureOptions& options) {
  const VtkSeries series = read_pvd(folder / "points.pvd");
  if (series.empty())
    throw std::runtime_error((folder / "points.pvd").string() + ": no snapshots to draw; 'polder run' writes them");
  std::vector<Frame> frames;
  std::vector<double> labels;  // s
  for (const auto& [number, label] : chosen_snapshots(folder, series, options)) {
    frames.push_back(read_snapshot(folder, series, number));
    labels.push_back(label);
  }

  PictureStyle style;
  style.scale_bar = true;
  std::vector<PictureField> fields = chosen_fields(frames.front(), options.fields);
  for (PictureField& field : fields) field.range = common_range(frames, field);

  make_folder(folder / "figures");
  std::vector<fs::path> files;
  const auto write = [&](const std::string& name, const Drawing& drawing) {
    for (const std::string& format : options.formats) {
      files.push_back(folder / "figures" / fmt::format("{}.{}", name, format));
      write_drawing(files.back(), drawing);
    }
  };
  for (const PictureField& field : fields)
    for (std::size_t f = 0; f < frames.size(); ++f)
      write(fmt::format("{}_{:.6g}s", field.name, labels[f]), draw_frame(frames[f], field, style));
  constexpr double margins = 102, column = 380;
  style.width = std::max(960.0, margins + column * static_cast<double>(fields.size()));
  write("sheet", draw_sheet(frames, fields, style));
  return files;
}

}  // namespace polder
