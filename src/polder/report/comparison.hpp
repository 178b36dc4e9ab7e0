#pragma once
// The comparison with expected.toml as a page shows it.
#include <optional>
#include <vector>

#include "polder/report/expected.hpp"
#include "polder/report/page.hpp"

namespace polder {

/// Quantity, place and time, computed, reference, tolerance, verdict, source.
PageTable comparison_table(const std::vector<Comparison>& comparisons);

/// "2 of 3 within tolerance"; absent where nothing was judged.
std::optional<PageFact> comparison_fact(const std::vector<Comparison>& comparisons);

}  // namespace polder
