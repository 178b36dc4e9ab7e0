#pragma once
// The results of the verification as pages: HTML with one figure per problem, and Markdown for the documentation.
#include <string>
#include <vector>

#include "polder/verify/suite.hpp"

namespace polder::verify {

/// One self-contained HTML page. `outcomes` in the order of `problems`.
std::string report_page(const std::vector<const Problem*>& problems, const std::vector<Outcome>& outcomes);

/// docs/verification.md.
std::string verification_page(const std::vector<const Problem*>& problems, const std::vector<Outcome>& outcomes);

}  // namespace polder::verify
