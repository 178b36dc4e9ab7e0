#pragma once
// The case file's sections that only seepage reads: [seepage], [[retention]], [[seepage_boundary]].
#include <vector>

#include "polder/case/sections.hpp"
#include "polder/case/seepage_input.hpp"

namespace polder::case_file {

/// Their part of the one schema table.
std::vector<Key> seepage_keys();

/// What the sections say; the model's materials must have been read.
SeepageInput read_seepage(const Sections& sections, const Model& model, Diagnostics& diagnostics);

}  // namespace polder::case_file
