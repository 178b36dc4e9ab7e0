#pragma once
// One number for the state of a run: equal exactly when every bit of every point is, in whatever order the points lie.
#include <cstdint>
#include <span>
#include <string>

namespace polder {

/// An array over the points, `components` values per point side by side.
struct HashedArray {
  std::span<const double> values;
  int components = 1;
};

/// Hash of the points in ascending order of `ids`; arrays count in the order given. `seed` chains several sets:
/// pass the hash of the soil as the seed of the water's. Throws std::invalid_argument where lengths do not match.
std::uint64_t state_hash(std::span<const std::uint64_t> ids, std::span<const HashedArray> arrays,
                         std::uint64_t seed = 0);

/// Sixteen hexadecimal digits, as in summary.json.
std::string hash_text(std::uint64_t hash);

}  // namespace polder
