#pragma once
// The schema table as pages: what docs/case-file.md, docs/case.schema.json and new case files are made of.
#include <string>

#include "polder/case/diagnostic.hpp"

namespace polder {

/// docs/case-file.md
std::string case_file_page();
/// docs/case.schema.json (JSON Schema draft 7), for editors that complete and check TOML.
std::string case_json_schema();

/// A small dike with comments on every key, those left at their defaults commented out.
std::string new_case();
/// The same of the case at `path`, with the files that it is based on merged in; paths of other files are made to count
/// from `folder`. Reports what cannot be read.
std::string new_case_from(const std::string& path, const std::string& folder, Diagnostics& diagnostics);

}  // namespace polder
