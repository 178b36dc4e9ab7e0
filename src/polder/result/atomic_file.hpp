#pragma once
// A file that appears complete or not at all: written beside its place, synced to the disk, then renamed over it.
// A kill or a power cut at any moment leaves either the old file or the new one.
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

namespace polder {

/// Bytes go to `<folder>/.<name>.partial`; `commit` moves them into place. Without `commit` the destructor removes
/// them and the old file stays. All members but the destructor throw OutputError.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(const void* bytes, std::size_t count);
  void write(std::string_view text) { write(text.data(), text.size()); }
  void commit();

 private:
  [[noreturn]] void fail(int error) const;
  std::filesystem::path path_, partial_;
  std::FILE* file_ = nullptr;
};

/// The whole file at once, atomically. Throws OutputError.
void write_atomically(const std::filesystem::path& path, std::string_view bytes);

/// Creates `folder` and its parents where they do not exist. Throws OutputError.
void make_folder(const std::filesystem::path& folder);

}  // namespace polder
