#pragma once
// The page of a study: a table of its members, curves and profiles over each other, and whether its demands are met.
#include <filesystem>
#include <string>
#include <vector>

#include "polder/study/results.hpp"

namespace polder::study {

/// One self-contained HTML page; it links to the members' own pages, relative to `folder`. Throws std::runtime_error
/// where a curve names a column that a history does not have.
std::string study_page(const Study& study, const std::vector<MemberResult>& results,
                       const std::filesystem::path& folder);

}  // namespace polder::study
