#pragma once
// The case file's sections that only the factor of safety reads: [stability], [[strength]], [[head_line]],
// [[dike_check]], [[load]].
#include <vector>

#include "polder/case/sections.hpp"
#include "polder/case/stability_input.hpp"

namespace polder::case_file {

/// Their part of the one schema table.
std::vector<Key> stability_keys();

/// What the sections say; the model's materials and soils must have been read.
stability::Input read_stability(const Sections& sections, const Model& model, Diagnostics& diagnostics);

}  // namespace polder::case_file
