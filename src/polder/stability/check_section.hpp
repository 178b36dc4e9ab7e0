#pragma once
// What is wrong with a section, in words that say what, where, and what to do.
#include <string>
#include <vector>

#include "polder/stability/columns.hpp"

namespace polder::stability {

/// Mistakes visible in the data alone: no soil, unknown soils, broken polygons, impossible numbers.
std::vector<std::string> check_data(const Section& section);

/// Mistakes of the geometry once it is cut into columns: gaps, overlaps, columns without soil.
std::vector<std::string> check_columns(const Section& section, const std::vector<Column>& columns);

/// Things that are allowed but deserve a look: free water on the ground, uplift of a layer, lines outside the section.
std::vector<std::string> notes(const PreparedSection& prepared);

}  // namespace polder::stability
