#pragma once
// Reading the members of a zip archive.
#include <filesystem>
#include <map>
#include <string>

namespace polder::stability {

/// Contents of every member by its name, '/' between folders. Throws std::invalid_argument where the file is missing,
/// is no zip archive or is damaged.
std::map<std::string, std::string> read_zip(const std::filesystem::path& file);

}  // namespace polder::stability
