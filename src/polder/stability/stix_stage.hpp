#pragma once
// One stage of a D-Stability model as a section.
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "polder/stability/section.hpp"

namespace polder::stability {

using Json = nlohmann::json;

/// The JSON files of the archive that carry an "Id", by it, in their folders; and soils.json.
struct StixFiles {
  std::map<std::string, std::map<std::string, Json>> by_folder;  ///< "geometries" → "32" → its JSON
  Json soils;
  const Json& get(const std::string& folder, const std::string& id) const;
};

/// With `design`, soils and states that have scatter take their characteristic values.
Section read_stage(const StixFiles& files, const Json& stage, bool design, std::vector<std::string>& notes);

/// The states (preconsolidation) of a stage, for a section that may have another geometry.
void read_states(const StixFiles& files, const Json& stage, bool design, Section& section);
bool has_states(const StixFiles& files, const Json& stage);

Point stix_point(const Json& json);
Line stix_points(const Json& json);

/// JSON of these files writes infinities and absent numbers as texts.
double stix_number(const Json& json, const char* key, double otherwise = 0);

}  // namespace polder::stability
