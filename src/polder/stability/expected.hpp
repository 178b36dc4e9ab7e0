#pragma once
// The factors that a case's expected.toml says it should have.
#include <filesystem>
#include <string>
#include <vector>

namespace polder::stability {

/// One `[[stability]]` of expected.toml.
struct ExpectedFactor {
  std::string method;
  double reference = 0;
  double tolerance = 0;  ///< relative
  std::string source;
};

/// Empty where the file does not exist. Throws std::invalid_argument, with file and line, where it cannot be read.
std::vector<ExpectedFactor> expected_factors(const std::filesystem::path& file);

}  // namespace polder::stability
