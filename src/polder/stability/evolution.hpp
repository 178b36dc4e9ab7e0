#pragma once
// A small global optimiser: differential evolution (Storn & Price 1997, rand-to-best/1/bin) with a fixed seed, so that
// a search gives the same answer every time.
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace polder::stability {

struct EvolutionOptions {
  int population = 40;
  int generations = 80;
  double weight = 0.7;      ///< of the differences
  double crossover = 0.8;   ///< probability per coordinate
  double tolerance = 1e-5;  ///< stops when the population's values span less than this, relative
  std::uint64_t seed = 1;
};

struct Minimum {
  std::vector<double> at;
  double value = 0;  ///< infinity where no trial was admissible
  int evaluations = 0;
};

/// Least value of `objective` in the box; infinity marks points that are not admissible. `starts` join the first
/// population (those beyond its size are dropped), the rest is drawn evenly.
Minimum minimise(const std::function<double(std::span<const double>)>& objective, std::span<const double> low,
                 std::span<const double> high, const std::vector<std::vector<double>>& starts,
                 const EvolutionOptions& options);

}  // namespace polder::stability
