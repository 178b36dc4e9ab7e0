#pragma once
// Strength reduction on the section that the methods of slices use: same layers, strengths and water.
#include <string>

#include "polder/stability/columns.hpp"
#include "polder/stability/fem_strength_reduction.hpp"

namespace polder::stability {

struct SectionReductionOptions {
  double triangles = 2000;                          ///< about so many
  double young_modulus = 1e8, poisson_ratio = 0.3;  ///< Pa; they do not change the factor (Griffiths & Lane 1999)
  StrengthReductionOptions reduction{};
};

struct SectionReduction {
  std::string problem;  ///< why there is no factor; empty: there is one
  Mesh mesh;
  StrengthReductionResult result;
};

/// Base fixed, sides held horizontally, weight and water as given, no dilation, no strength from suction. Drained and
/// constant undrained strengths, the same above and below the phreatic line; what it cannot take is named in `problem`.
SectionReduction reduce_strength(const PreparedSection& prepared, const SectionReductionOptions& options = {});

}  // namespace polder::stability
