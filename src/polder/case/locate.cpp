#include "polder/case/locate.hpp"

#include <map>
#include <system_error>

namespace polder {
namespace fs = std::filesystem;
namespace {

constexpr const char* file_name = "case.toml";
constexpr const char* verification = "verify";  // folder of the cases of `polder verify`
constexpr const char* examples = "examples";    // folder of the small cases of the guide

bool is_file(const fs::path& path) {
  std::error_code unreadable;
  return fs::is_regular_file(path, unreadable);
}

bool is_folder(const fs::path& path) {
  std::error_code unreadable;
  return fs::is_directory(path, unreadable);
}

}  // namespace

std::vector<fs::path> case_folders() {
  std::vector<fs::path> candidates;
  std::error_code unknown;
  const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
  if (!unknown) {
    const fs::path bin = program.parent_path();
    candidates.push_back(bin.parent_path().parent_path() / "cases");
    candidates.push_back(bin.parent_path() / "share/polder/cases");
  }
  candidates.push_back(fs::path(POLDER_SOURCE_DIR) / "cases");
  std::erase_if(candidates, [](const fs::path& folder) { return !is_folder(folder); });
  return candidates;
}

std::optional<fs::path> find_case(std::string_view name_or_path, std::span<const fs::path> folders) {
  const fs::path path(name_or_path);
  if (is_file(path)) return path;
  if (is_file(path / file_name)) return path / file_name;
  const bool is_name = path.has_filename() && path == path.filename() && path != "." && path != "..";
  if (!is_name) return std::nullopt;
  for (const fs::path& folder : folders)
    for (const fs::path& place : {folder / path, folder / verification / path, folder / examples / path})
      if (is_file(place / file_name)) return place / file_name;
  return std::nullopt;
}

std::optional<fs::path> find_case(std::string_view name_or_path) { return find_case(name_or_path, case_folders()); }

std::vector<ShippedCase> shipped_cases(std::span<const fs::path> folders) {
  std::map<std::string, fs::path> found;
  for (const fs::path& folder : folders) {
    std::error_code unreadable;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, unreadable))
      if (is_file(entry.path() / file_name)) found.try_emplace(entry.path().filename(), entry.path() / file_name);
  }
  std::vector<ShippedCase> cases;
  cases.reserve(found.size());
  for (const auto& [name, file] : found) cases.push_back({name, file});
  return cases;
}

std::vector<ShippedCase> shipped_cases() { return shipped_cases(case_folders()); }

}  // namespace polder
