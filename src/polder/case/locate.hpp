#pragma once
// Where cases live: a shipped case is a folder `cases/<name>/` with a `case.toml`, found by its name from anywhere.
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace polder {

struct ShippedCase {
  std::string name;            ///< of its folder
  std::filesystem::path file;  ///< its case.toml
};

/// The folders that may hold shipped cases and exist here, nearest first: beside the build that this program came from
/// (`<checkout>/build/<preset>/polder`), where `cmake --install` puts them, in the source tree it was compiled from.
std::vector<std::filesystem::path> case_folders();

/// The case file that the user means by CASE: a file, a folder with a `case.toml`, or the name of a shipped case (or of
/// one that `polder verify` runs, under `verify/`), in this order. Nothing if there is none.
std::optional<std::filesystem::path> find_case(std::string_view name_or_path);
std::optional<std::filesystem::path> find_case(std::string_view name_or_path,
                                               std::span<const std::filesystem::path> folders);

/// All shipped cases, sorted by name; where two folders hold the same name, the nearer one counts.
std::vector<ShippedCase> shipped_cases();
std::vector<ShippedCase> shipped_cases(std::span<const std::filesystem::path> folders);

}  // namespace polder
