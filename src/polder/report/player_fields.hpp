#pragma once
// From the fields of a snapshot to what the player colours by: tensors become invariants, vectors magnitudes or
// components, numbers of things get names, and each field is told how to be looked at.
#include <nlohmann/json.hpp>
#include <vector>

#include "polder/report/series.hpp"
#include "polder/result/frame.hpp"

namespace polder {

/// A column of the player's and how its value comes from the snapshot.
struct PlayerColumn {
  PlayerField info;
  std::string source;  ///< field of the snapshot; empty: the position
  enum class Take { value, component, magnitude, mean_pressure, deviator } take = Take::value;
  int component = 0;
};

/// Columns for points with such fields: x and y first (y is height), then what is known, in the order of interest.
/// `material_names` name the values of the field `material`; `up` is the axis of height (1, or 2 in 3d).
std::vector<PlayerColumn> player_columns(const PointSet& points, int up,
                                         const std::vector<std::string>& material_names);

/// Values of a column at the points `chosen` (indices); NaN where the snapshot does not have the field.
/// Mean effective stress is compression-positive, −tr σ′/3; the deviator is √(3/2 s:s).
void append_values(const PlayerColumn& column, const PointSet& points, const std::vector<std::size_t>& chosen,
                   std::vector<float>& values);

}  // namespace polder
