#pragma once
// What the report's player moves: the points of one phase over the whole run, as plain columns.
//
// Points appear and vanish (water splits, flows in and out), so an entry is one point in one frame and the id says
// which. Entries are stored frame after frame; a field has one value per entry.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace polder {

/// How a field is meant to be looked at.
enum class FieldScale {
  sequential,  ///< from little to much
  diverging,   ///< zero is special
  category     ///< small whole numbers with names
};

struct PlayerField {
  std::string key;     ///< name in the files, e.g. "pore_pressure"
  std::string label;   ///< in words, e.g. "pore pressure"
  std::string symbol;  ///< as in the theory, e.g. "p"
  std::string unit;    ///< SI; empty: dimensionless
  std::string note{};  ///< sign convention or definition, where one is needed
  FieldScale scale = FieldScale::sequential;
  bool shown = true;  ///< false: used by the player (coordinates, velocities), not offered as a colour
  std::vector<std::string> categories{};  ///< names of 0, 1, 2… of a category
  std::vector<std::string> colours{};     ///< theirs, as #rrggbb
};

struct SeriesField {
  PlayerField info;
  std::vector<float> values;  ///< one per entry; NaN where there is none
};

struct PointSeries {
  std::string name;  ///< "soil" or "water"
  /// Entries of frame f are [frame_start[f], frame_start[f + 1]).
  std::vector<std::size_t> frame_start{0};
  std::vector<std::uint64_t> id;
  std::vector<SeriesField> fields;  ///< the first two are the coordinates x and y (up), m

  std::size_t frames() const { return frame_start.size() - 1; }
  std::size_t entries() const { return id.size(); }
};

}  // namespace polder
