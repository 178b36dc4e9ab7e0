#pragma once
// Random numbers as a function of (seed, id, step): the same whatever the order of the points or the number of threads.
#include <cstdint>

namespace polder {

/// A well-mixed 64-bit word from three others (SplitMix64's finaliser applied in turn; Steele et al., OOPSLA 2014).
inline std::uint64_t mix(std::uint64_t seed, std::uint64_t id, std::uint64_t step) {
  const auto scramble = [](std::uint64_t z) {
    z += 0x9E3779B97F4A7C15ULL;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  };
  return scramble(scramble(scramble(seed) ^ id) ^ step);
}

/// Uniform in [0, 1).
inline double uniform(std::uint64_t seed, std::uint64_t id, std::uint64_t step) {
  return static_cast<double>(mix(seed, id, step) >> 11) * 0x1.0p-53;
}

}  // namespace polder
