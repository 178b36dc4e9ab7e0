#pragma once
// From a case file to a polder::Model, or to everything that is wrong with it.
#include <string>
#include <vector>

#include "polder/case/diagnostic.hpp"
#include "polder/case/model.hpp"
#include "polder/case/seepage_input.hpp"
#include "polder/case/stability_input.hpp"

namespace polder {

struct ReadResult {
  Model model;                 ///< complete where there are no errors; else what could be read
  stability::Input stability;  ///< what the factor of safety needs beyond the model
  SeepageInput seepage;        ///< what seepage needs beyond it
  Diagnostics diagnostics;
  bool ok() const { return !has_errors(diagnostics); }
};

/// Reads the case file at `path` with `overrides` of the form key=value ("model.cell=0.025 m",
/// "material.sand.friction_angle=36 deg", "stage.2.duration=5 s"); every mistake is in the result, in the order of the
/// file. Throws nothing for what a user may have written.
ReadResult read_case(const std::string& path, const std::vector<std::string>& overrides = {});

}  // namespace polder
