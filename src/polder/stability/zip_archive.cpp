#include "polder/stability/zip_archive.hpp"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <stdexcept>

namespace polder::stability {

namespace {

/// What a member holds. It grows with what comes out of the archive, not with what the archive says of it; at most
/// `room` bytes. Empty: it is damaged.
std::optional<std::string> contents(zip_t* archive, zip_uint64_t index, std::size_t room) {
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> member(zip_fopen_index(archive, index, 0), zip_fclose);
  if (!member) return std::nullopt;
  zip_stat_t said;
  if (zip_stat_index(archive, index, 0, &said) != 0) return std::nullopt;
  std::string text;
  for (std::array<char, 1 << 16> piece;;) {
    const zip_int64_t count = zip_fread(member.get(), piece.data(), piece.size());
    if (count < 0 || static_cast<std::size_t>(count) > room - text.size()) return std::nullopt;
    if (count == 0) return text.size() == said.size ? std::optional(std::move(text)) : std::nullopt;
    text.append(piece.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace

std::map<std::string, std::string> read_zip(const std::filesystem::path& file, std::size_t most) {
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
  std::size_t room = most;
  for (zip_int64_t i = 0; i < count; ++i) {
    const auto index = static_cast<zip_uint64_t>(i);
    const char* said = zip_get_name(archive.get(), index, 0);
    auto text = contents(archive.get(), index, room);
    if (!said || !text)
      throw std::invalid_argument(fmt::format("{}: '{}' is damaged, or the archive holds more than {} bytes",
                                              file.string(), said ? said : "a member", most));
    room -= text->size();
    std::string name = said;
    std::replace(name.begin(), name.end(), '\\', '/');
    members.emplace(std::move(name), std::move(*text));
  }
  return members;
}

}  // namespace polder::stability
