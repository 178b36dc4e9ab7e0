#pragma once
// A folder of this process for readers that take a path; it goes when the process ends.
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace polder::fuzz {

class Scratch {
 public:
  Scratch() : path_(std::filesystem::temp_directory_path() / ("polder-fuzz-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  /// Writes a file of the folder and returns its path.
  std::string write(const std::string& name, const std::string& text) const {
    const std::string path = path_ / name;
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }

 private:
  std::filesystem::path path_;
};

/// The folder that lives as long as the process.
inline const Scratch& scratch() {
  static const Scratch folder;
  return folder;
}

/// What must hold, in every build.
inline void require(bool holds) {
  if (!holds) __builtin_trap();
}

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace polder::fuzz
