#pragma once
// What the members of a study came to, read from their folders.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "polder/report/expected.hpp"
#include "polder/study/study_file.hpp"

namespace polder::study {

struct MemberResult {
  std::string status;  ///< as in summary.json; "not computed" without one
  History history;
  std::vector<Comparison> measures;  ///< in the order of Study::measures; empty where there is no history
  double points = 0, steps = 0, seconds = 0;
};

/// One line per measure with a trend or an agreement: what is asked, and whether it is so.
struct Verdict {
  std::string text;
  bool kept = false;
};

/// `folder` holds one folder per member.
std::vector<MemberResult> read_results(const Study& study, const std::filesystem::path& folder);

/// Where a member has no value the demand is not kept.
std::vector<Verdict> judge(const Study& study, const std::vector<MemberResult>& results);

}  // namespace polder::study
