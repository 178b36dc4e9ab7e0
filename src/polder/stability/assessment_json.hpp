#pragma once
// An assessment for scripts: a list of flat objects, one per factor of safety and per probability; with slices,
// contours and curves as lists inside them where asked for.
#include <nlohmann/json.hpp>

#include "polder/stability/assessment.hpp"

namespace polder::stability {

struct AssessmentDetails {
  bool slices = false, contours = false, curve = false;
};

nlohmann::ordered_json assessment_json(const Assessment& assessment, const AssessmentDetails& details = {});

}  // namespace polder::stability
