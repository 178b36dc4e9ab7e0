#pragma once
// Reading the members of a zip archive.
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>

namespace polder::stability {

/// Contents of every member by its name, '/' between folders. Throws std::invalid_argument where the file is missing,
/// is no zip archive, is damaged, or its members hold more than `most` bytes together: no model of a section comes
/// near.
std::map<std::string, std::string> read_zip(const std::filesystem::path& file, std::size_t most = 1u << 28);

}  // namespace polder::stability
