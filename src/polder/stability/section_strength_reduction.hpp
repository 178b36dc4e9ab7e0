#pragma once
// Strength reduction on the section that the methods of slices use: same layers, strengths and water.
#include <string>

#include "polder/stability/columns.hpp"
#include "polder/stability/fem_strength_reduction.hpp"

namespace polder::stability {

struct SectionReductionOptions {
  std::string mesh_file;                            ///< of Gmsh, instead of our own mesh; empty: none
  double triangles = 3000;                          ///< about so many
  double young_modulus = 1e8, poisson_ratio = 0.3;  ///< Pa; they hardly change the factor (Griffiths & Lane 1999)
  std::vector<std::array<double, 2>> stiffness;     ///< Pa, –: E and ν of each soil where they are known
  std::vector<Line> fixed;                          ///< parts of the outline that do not move
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
