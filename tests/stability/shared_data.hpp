#pragma once
// Where the data are that are too large, or not ours, to be committed: tests on them exist only where the data do.
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace polder::stability::testing {

/// The file below $POLDER_SHARED, or below `shared/` beside the checkout.
inline std::optional<std::filesystem::path> shared_file(const std::string& name) {
  const char* given = std::getenv("POLDER_SHARED");
  const std::filesystem::path root = given != nullptr
                                         ? std::filesystem::path(given)
                                         : std::filesystem::path(POLDER_SOURCE_DIR).parent_path() / "shared";
  if (std::error_code error; std::filesystem::exists(root / name, error)) return root / name;
  return std::nullopt;
}

}  // namespace polder::stability::testing
