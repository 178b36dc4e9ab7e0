#pragma once
// A case as the factor of safety sees it: the model, what it says about strength and water, and its section under each
// of the water pressures that it asks for.
#include <memory>
#include <string>
#include <vector>

#include "polder/case/model.hpp"
#include "polder/case/seepage_input.hpp"
#include "polder/stability/columns.hpp"

namespace polder::stability {

struct Study {
  Model model;
  Input input;
  SeepageInput seepage;
};

/// The section under one assumption about the water.
struct StudySection {
  std::string water;  ///< "seepage" or "water net"
  PreparedSection prepared;
};

/// One section, or two where the case asks for both pressures (stability.pressures). Seepage is steady at
/// `seepage.steady_time`, or transient up to the last of `seepage.times` where there are any. Throws
/// std::invalid_argument where the case has no section, std::runtime_error where no seepage is found.
std::vector<StudySection> study_sections(const Study& study);

}  // namespace polder::stability
