#pragma once
// expected.toml beside a case: [[verify]] entries with the tolerance of a quantity and where it comes from.
#include <filesystem>
#include <string>
#include <vector>

namespace polder::verify {

struct Expected {
  std::string quantity;
  double tolerance = 0;  ///< of the error
  std::string source;
};

/// Throws std::runtime_error with file and line where an entry is not complete.
std::vector<Expected> expected_tolerances(const std::filesystem::path& file);

}  // namespace polder::verify
