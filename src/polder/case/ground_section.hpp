#pragma once
// The sections [[change]], [[load]], [[well]] and [[rain]]: what is done to the ground as stages begin, what presses on
// it, and what is taken out of it or falls on it.
#include <vector>

#include "polder/case/sections.hpp"

namespace polder::case_file {

std::vector<Key> ground_keys();
std::vector<Key> state_keys();

/// Index into Model::stages of the stage that the section names under `key`; −1 where it names none. A name that no
/// stage has is reported.
int stage_named(const Fields& fields, std::string_view key, const Model& model, Diagnostics& diagnostics);

GroundLoad read_load(const Fields& fields, const Model& model, Diagnostics& diagnostics);
/// Without its region.
GroundChange read_change(const Fields& fields, const Model& model, Diagnostics& diagnostics);

Well read_well(const Fields& fields, const Model& model, Diagnostics& diagnostics);
Rain read_rain(const Fields& fields, Diagnostics& diagnostics);

/// Changes that lack a material or come too early; loads on top of each other; wells outside
/// the model, or of which it is not said what they do.
void check_ground(const Sections& sections, const Model& model, Diagnostics& diagnostics);

}  // namespace polder::case_file
