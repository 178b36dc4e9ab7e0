#pragma once
// The checks on the ground behind a dike, on a case's own section: its layers give the blanket's weight, its water the
// head under it.
#include <optional>
#include <string>
#include <vector>

#include "polder/stability/expected.hpp"
#include "polder/stability/study.hpp"

namespace polder::stability {

struct DikeCheck {
  std::string label;    ///< kind and, in brackets, place: "uplift (toe)"
  std::string kind;     ///< "uplift", "heave" or "piping"
  std::string water;    ///< "seepage" or "water net"
  double factor = 0;    ///< safe from 1 on; infinite where nothing drives
  std::string remark;   ///< the numbers behind it
  std::string problem;  ///< why there is no factor; empty: there is one
  std::optional<ExpectedFactor> expected;
  bool pass() const;
};

/// Uplift and heave, and piping where a d70 is given, at every `[[dike_check]]` of the case, with the water of `on`.
std::vector<DikeCheck> dike_checks(const Study& study, const StudySection& on);

}  // namespace polder::stability
