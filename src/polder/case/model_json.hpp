#pragma once
// A model as JSON, in the words of the case file, SI, every default filled in: the key `case` of summary.json.
#include <nlohmann/json_fwd.hpp>

#include "polder/case/model.hpp"

namespace polder {

nlohmann::ordered_json case_json(const Model& model);

}  // namespace polder
