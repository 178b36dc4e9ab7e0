#include "polder/stability/evolution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polder::stability {
namespace {

// SplitMix64 (Steele, Lea & Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
  int below(int n) { return static_cast<int>(uniform() * n); }

 private:
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

// A coordinate that left the box comes back inside, halfway between its old place and the wall.
double kept(double value, double old, double low, double high) {
  if (value < low) return (old + low) / 2;
  if (value > high) return (old + high) / 2;
  return value;
}

}  // namespace

Minimum minimise(const std::function<double(std::span<const double>)>& objective, std::span<const double> low,
                 std::span<const double> high, const std::vector<std::vector<double>>& starts,
                 const EvolutionOptions& options) {
  const std::size_t axes = low.size();
  const auto size = static_cast<std::size_t>(options.population);
  Random random(options.seed);
  Minimum minimum;
  std::vector<std::vector<double>> members(size, std::vector<double>(axes));
  std::vector<double> values(size);
  for (std::size_t m = 0; m < size; ++m) {
    for (std::size_t i = 0; i < axes; ++i)
      members[m][i] = m < starts.size() ? std::clamp(starts[m][i], low[i], high[i])
                                        : low[i] + random.uniform() * (high[i] - low[i]);
    values[m] = objective(members[m]);
    ++minimum.evaluations;
  }

  std::vector<double> trial(axes);
  for (int g = 0; g < options.generations; ++g) {
    const auto best = static_cast<std::size_t>(std::min_element(values.begin(), values.end()) - values.begin());
    for (std::size_t m = 0; m < size; ++m) {
      const auto other = [&] { return static_cast<std::size_t>(random.below(options.population)); };
      const std::size_t a = other(), b = other(), c = other();
      const bool greedy = random.uniform() < 0.5;
      const auto forced = static_cast<std::size_t>(random.below(static_cast<int>(axes)));
      for (std::size_t i = 0; i < axes; ++i) {
        const double from =
            greedy ? members[m][i] + options.weight * (members[best][i] - members[m][i]) : members[c][i];
        const double moved = from + options.weight * (members[a][i] - members[b][i]);
        const bool take = i == forced || random.uniform() < options.crossover;
        trial[i] = take ? kept(moved, members[m][i], low[i], high[i]) : members[m][i];
      }
      const double value = objective(trial);
      ++minimum.evaluations;
      if (value <= values[m]) {
        values[m] = value;
        members[m] = trial;
      }
    }
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    if (std::isfinite(*most) && *most - *least < options.tolerance * std::abs(*least)) break;
  }
  const auto best = static_cast<std::size_t>(std::min_element(values.begin(), values.end()) - values.begin());
  minimum.at = members[best];
  minimum.value = values[best];
  return minimum;
}

}  // namespace polder::stability
