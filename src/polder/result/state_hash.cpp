#include "polder/result/state_hash.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace polder {
namespace {

// Finaliser of splitmix64 (Steele, Lea and Flood 2014, public domain): every bit of the input reaches every bit of
// the output, so that chaining word by word neither loses nor commutes.
constexpr std::uint64_t mix(std::uint64_t word) {
  word += 0x9e3779b97f4a7c15u;
  word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9u;
  word = (word ^ (word >> 27)) * 0x94d049bb133111ebu;
  return word ^ (word >> 31);
}

}  // namespace

std::uint64_t state_hash(std::span<const std::uint64_t> ids, std::span<const HashedArray> arrays, std::uint64_t seed) {
  for (const HashedArray& array : arrays)
    if (array.components < 1 || array.values.size() != ids.size() * static_cast<std::size_t>(array.components))
      throw std::invalid_argument("state_hash: an array does not have `components` values for every id");
  std::vector<std::size_t> order(ids.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
  std::uint64_t hash = mix(seed ^ ids.size());
  for (const std::size_t p : order) {
    hash = mix(hash ^ ids[p]);
    for (const HashedArray& array : arrays) {
      const std::size_t count = static_cast<std::size_t>(array.components);
      for (std::size_t c = 0; c < count; ++c)
        hash = mix(hash ^ std::bit_cast<std::uint64_t>(array.values[p * count + c]));
    }
  }
  return hash;
}

std::string hash_text(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

}  // namespace polder
