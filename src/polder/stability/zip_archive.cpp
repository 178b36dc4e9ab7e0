#include "polder/stability/zip_archive.hpp"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace polder::stability {

std::map<std::string, std::string> read_zip(const std::filesystem::path& file) {
  constexpr zip_uint64_t largest = 1u << 30;  // bytes; no model of a section comes near
  int code = 0;
  const std::unique_ptr<zip_t, void (*)(zip_t*)> archive(zip_open(file.c_str(), ZIP_RDONLY, &code), zip_discard);
  if (!archive) {
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    const std::string reason = zip_error_strerror(&error);
    zip_error_fini(&error);
    throw std::invalid_argument(fmt::format("{}: cannot be read as a zip archive: {}", file.string(), reason));
  }
  std::map<std::string, std::string> members;
  const zip_int64_t count = zip_get_num_entries(archive.get(), 0);
  for (zip_int64_t i = 0; i < count; ++i) {
    zip_stat_t about;
    if (zip_stat_index(archive.get(), static_cast<zip_uint64_t>(i), 0, &about) != 0 || about.size > largest)
      throw std::invalid_argument(fmt::format("{}: member {} is damaged or too large", file.string(), i + 1));
    const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> member(
        zip_fopen_index(archive.get(), static_cast<zip_uint64_t>(i), 0), zip_fclose);
    std::string text(about.size, '\0');
    if (!member || zip_fread(member.get(), text.data(), about.size) != static_cast<zip_int64_t>(about.size))
      throw std::invalid_argument(fmt::format("{}: '{}' is damaged", file.string(), about.name));
    std::string name = about.name;
    std::replace(name.begin(), name.end(), '\\', '/');
    members.emplace(std::move(name), std::move(text));
  }
  return members;
}

}  // namespace polder::stability
