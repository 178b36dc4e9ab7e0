#pragma once
// The table of methods that `polder stability` offers. A method is one function and one line in methods.cpp.
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "polder/stability/search.hpp"
#include "polder/stability/section_strength_reduction.hpp"
#include "polder/stability/study.hpp"

namespace polder::stability {

struct Outcome {
  double factor = 0;
  std::string problem;                                ///< why there is no factor; empty: there is one
  std::string remark;                                 ///< one line on what was found
  std::optional<SearchResult> search;                 ///< of the methods of slices
  std::shared_ptr<const SectionReduction> reduction;  ///< of strength reduction
  explicit operator bool() const { return problem.empty(); }
};

struct StabilityMethod {
  std::string_view name;  ///< as on the command line
  std::string_view doc;
  Outcome (*run)(const Study& study, const PreparedSection& prepared);
};

std::span<const StabilityMethod> stability_methods();
const StabilityMethod* find_stability_method(std::string_view name);

/// "bishop, spencer, …".
std::string stability_method_names();

}  // namespace polder::stability
