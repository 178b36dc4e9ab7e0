#pragma once
// The case as tables for readers: materials with symbols and units, boundaries, stages. They are made from the key
// `case` of summary.json and explained by the case file's own schema.
#include <nlohmann/json.hpp>
#include <vector>

#include "polder/report/page.hpp"

namespace polder {

/// Names of the materials in their order.
std::vector<std::string> material_names(const nlohmann::ordered_json& inputs);

/// Tables for those parts that the inputs have.
std::vector<PageTable> case_tables(const nlohmann::ordered_json& inputs);

/// Where monitors are, in the section; `up` is the axis of height.
std::vector<PageMonitor> page_monitors(const nlohmann::ordered_json& inputs, std::size_t up);

/// Where water stands on the ground at a given level, without water points (unsaturated formulation).
std::vector<PageLevel> page_levels(const nlohmann::ordered_json& inputs);

}  // namespace polder
