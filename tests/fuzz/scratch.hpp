#pragma once
// A folder of this process for readers that take a path, in memory where there is such a file system (a disk would take
// most of the time of a run); it goes when the process ends. What a reader refuses is counted and said at the end.
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

namespace polder::fuzz {

class Scratch {
 public:
  Scratch() : path_(root() / ("polder-fuzz-" + std::to_string(::getpid()))) {
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
  static std::filesystem::path root() {
    const std::filesystem::path memory = "/dev/shm";
    return ::access(memory.c_str(), W_OK | X_OK) == 0 ? memory : std::filesystem::temp_directory_path();
  }

  std::filesystem::path path_;
};

/// The folder that lives as long as the process.
inline const Scratch& scratch() {
  static const Scratch folder;
  return folder;
}

/// Inputs refused with a message; the number is printed when the process ends.
class Refusals {
 public:
  ~Refusals() { std::fprintf(stderr, "refused: %llu\n", static_cast<unsigned long long>(count_)); }
  void add() { ++count_; }

 private:
  std::uint64_t count_ = 0;
};

inline Refusals& refusals() {
  static Refusals all;
  return all;
}

/// What must hold, in every build.
inline void require(bool holds) {
  if (!holds) __builtin_trap();
}

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace polder::fuzz
