#pragma once
// stability.html: the factors of safety of a case on one page that needs no network: the section with each slip
// surface, one table of factors, slices, the mechanism of strength reduction, and the probability of failure.
#include <string>

#include "polder/stability/assessment.hpp"

namespace polder {

std::string stability_page(const stability::Assessment& assessment, const std::string& version);

}  // namespace polder
