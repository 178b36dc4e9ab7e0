#pragma once
// The file of `polder element`: materials as in a case file, and the laboratory tests to run on them.
#include <string>
#include <vector>

#include "polder/case/diagnostic.hpp"
#include "polder/case/schema.hpp"
#include "polder/material/element.hpp"

namespace polder {

struct ElementMaterial {
  std::string name;
  const LawDescription* law = nullptr;
  std::vector<double> law_parameters;  ///< in the order of the law's table, SI, defaults filled in
  double porosity = 0.4, max_porosity = 0.5;
};

struct ElementRun {
  std::string name;  ///< of the test
  int material = 0;  ///< index into ElementInput::materials
  ElementPath path;
};

struct ElementInput {
  std::vector<ElementMaterial> materials;
  std::vector<ElementRun> runs;
  Diagnostics diagnostics;
  bool ok() const { return !has_errors(diagnostics); }
};

/// The keys of `[[test]]`.
const std::vector<case_file::Key>& element_test_keys();

/// Reads `[[material]]` and `[[test]]`; the other sections of a case file are passed over. A test without a material is
/// run on all. A file without a test gets the standard ones: an oedometer, triaxial tests drained and undrained, and
/// simple shear at 100 kPa.
ElementInput read_element_file(const std::string& path, const std::vector<std::string>& overrides = {});

}  // namespace polder
