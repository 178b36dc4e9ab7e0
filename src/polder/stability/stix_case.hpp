#pragma once
// An imported calculation as a case file.
#include <string>
#include <vector>

#include "polder/stability/stix.hpp"

namespace polder::stability {

/// The text of a case.toml: the section moved so that its lower left corner is the origin, one material per layer with
/// the strengths and weights of the model, its water, loads, limits and slip surface. What the model does not know
/// (stiffness, permeability) is filled in and marked. Appends to `notes` what a case file cannot say.
std::string case_text(const StixCalculation& calculation, const std::string& source, std::vector<std::string>& notes);

}  // namespace polder::stability
