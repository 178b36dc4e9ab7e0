#pragma once
// CASE on the command line: found, read, its mistakes printed.
#include <string>
#include <vector>

#include "polder/case/reader.hpp"

namespace polder::cli {

/// The path of the case file that the user means. Throws Failure (status_wrong_input) with the nearest shipped name.
std::string find_case_file(const std::string& name_or_path);

/// The model of CASE with the overrides of --set. Prints warnings and errors to stderr as a compiler would; throws
/// Failure (status_wrong_input) where there are errors.
Model read_case_or_fail(const std::string& name_or_path, const std::vector<std::string>& overrides);

}  // namespace polder::cli
