#pragma once
// The snapshots of a run's folder as the player's point series, thinned where they are too many for a page.
#include <filesystem>
#include <string>
#include <vector>

#include "polder/report/series.hpp"
#include "polder/report/soil_shape.hpp"
#include "polder/result/frame.hpp"

namespace polder {

struct PageLimits {
  double points = 60000;     ///< soil and water points shown per frame, at most
  double entries = 4.2e6;    ///< points × frames, at most
  std::size_t frames = 400;  ///< at most
};

struct RunPoints {
  std::string title;
  int dimension = 2;
  Point2 size{1, 1};  ///< m, the section
  std::vector<Line2> outlines, walls;
  std::vector<double> times;  ///< s
  PointSeries soil, water;
  double soil_spacing = 0, water_spacing = 0;  ///< m, side of the square that a shown point stands for
  SoilShape first, last;
  std::vector<std::string> notes;  ///< what was left out, as sentences
};

/// Reads points.pvd and its files. Thinning keeps a point by a hash of its id, so it is kept in all frames or in none.
/// Of a run in 3d, the points in a slice around the middle plane across are taken. No frames where there is no
/// points.pvd. Throws std::runtime_error where a file is missing or damaged.
RunPoints read_run_points(const std::filesystem::path& folder, const std::vector<std::string>& material_names,
                          const PageLimits& limits = {});

}  // namespace polder
