#include "polder/stability/reliability.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>

namespace polder::stability {
namespace {

void scale(Strength& strength, double cohesion, double tan_friction, double undrained) {
  strength.cohesion *= cohesion;
  strength.friction_angle = std::atan(std::tan(strength.friction_angle) * tan_friction);
  strength.undrained_strength *= undrained;
  strength.strength_gradient *= undrained;
  strength.ratio *= undrained;
  for (auto& row : strength.stress_table) row[1] *= undrained;
}

void raise(WaterNet& water, double rise) {
  const auto lift = [&](Line& line) {
    for (Point& p : line) p[1] += rise;
  };
  lift(water.phreatic);
  for (ReferenceLine& reference : water.references) {
    lift(reference.head_above);
    lift(reference.head_below);
  }
}

// Standard normal numbers as a function of (seed, sample, variable): SplitMix64, then Box and Muller.
double standard_normal(std::uint64_t seed, std::uint64_t sample, std::uint64_t variable) {
  const auto uniform = [&](std::uint64_t stream) {
    std::uint64_t z = seed * 0x9e3779b97f4a7c15ULL + sample * 0xd1342543de82ef95ULL + (2 * variable + stream + 1);
    for (int k = 0; k < 2; ++k) {
      z += 0x9e3779b97f4a7c15ULL;
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
      z ^= z >> 31;
    }
    return (static_cast<double>(z >> 11) + 0.5) * 0x1.0p-53;
  };
  return std::sqrt(-2 * std::log(uniform(0))) * std::cos(2 * std::numbers::pi * uniform(1));
}

}  // namespace

double normal_probability(double u) { return 0.5 * std::erfc(-u / std::numbers::sqrt2); }

double normal_quantile(double probability) {
  double low = -40, high = 40;
  for (int k = 0; k < 200; ++k) {
    const double middle = (low + high) / 2;
    (normal_probability(middle) < probability ? low : high) = middle;
  }
  return (low + high) / 2;
}

double characteristic_value(double mean, double variation) {
  const double sigma = std::sqrt(std::log(1 + variation * variation));
  return mean * std::exp(-sigma * sigma / 2 - 1.6448536269514722 * sigma);
}

Section design_section(Section section, const PartialFactors& factors) {
  for (Soil& soil : section.soils)
    for (Strength* strength : {&soil.above, &soil.below})
      scale(*strength, 1 / factors.cohesion, 1 / factors.tan_friction, 1 / factors.undrained);
  for (StripLoad& load : section.strip_loads) load.pressure *= factors.load;
  for (LineLoad& load : section.line_loads) load.force *= factors.load;
  return section;
}

Section characteristic_section(Section section, const std::vector<Uncertainty>& uncertain) {
  for (const Uncertainty& what : uncertain) {
    if (what.soil < 0) continue;
    const double factor = characteristic_value(1, what.deviation);
    Soil& soil = section.soils[static_cast<std::size_t>(what.soil)];
    scale(soil.above, factor, factor, factor);
    scale(soil.below, factor, factor, factor);
  }
  return section;
}

std::vector<Uncertainty> uncertainties(const Model& model, const Input& input) {
  std::vector<Uncertainty> list;
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    double variation = 0;
    for (const MaterialStrength& strength : input.strengths)
      if (strength.material == model.materials[i].name) variation = std::max(variation, strength.variation);
    if (variation > 0) list.push_back({"strength of " + model.materials[i].name, static_cast<int>(i), variation});
  }
  if (input.head_deviation > 0) list.push_back({"heads", -1, input.head_deviation});
  return list;
}

Section realisation(const Section& section, const std::vector<Uncertainty>& uncertain, const std::vector<double>& u) {
  Section changed = section;
  for (std::size_t i = 0; i < uncertain.size(); ++i) {
    const Uncertainty& what = uncertain[i];
    if (what.soil < 0) {
      raise(changed.water, what.deviation * u[i]);
      continue;
    }
    const double sigma = std::sqrt(std::log(1 + what.deviation * what.deviation));
    const double factor = std::exp(-sigma * sigma / 2 + sigma * u[i]);
    Soil& soil = changed.soils[static_cast<std::size_t>(what.soil)];
    scale(soil.above, factor, factor, factor);
    scale(soil.below, factor, factor, factor);
  }
  return changed;
}

Reliability form(const Section& section, const std::vector<Uncertainty>& uncertain, const FactorOf& factor) {
  const std::size_t n = uncertain.size();
  Reliability result;
  std::vector<double> u(n, 0.0), gradient(n);
  const auto limit = [&](const std::vector<double>& at) {
    ++result.evaluations;
    return factor(realisation(section, uncertain, at)) - 1;
  };
  const bool safe = limit(u) > 0;  // at the mean
  result.converged = false;
  for (int step = 0; step < 50 && !result.converged; ++step) {
    const double at = limit(u);
    double norm = 0;
    for (std::size_t i = 0; i < n; ++i) {
      constexpr double difference = 0.05;
      std::vector<double> forward = u, back = u;
      forward[i] += difference, back[i] -= difference;
      gradient[i] = (limit(forward) - limit(back)) / (2 * difference);
      norm += gradient[i] * gradient[i];
    }
    if (!(norm > 0) || !std::isfinite(norm)) break;  // nothing that is uncertain matters
    const double along = std::inner_product(gradient.begin(), gradient.end(), u.begin(), 0.0);
    double change = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double next = gradient[i] * (along - at) / norm;
      change = std::max(change, std::abs(next - u[i]));
      u[i] = next;
    }
    result.converged = change < 1e-3;
  }
  const double squared = std::inner_product(u.begin(), u.end(), u.begin(), 0.0);
  result.index = (safe ? 1 : -1) * std::sqrt(squared);
  result.probability = normal_probability(-result.index);
  result.design_point = u;
  for (const double value : u) result.influence.push_back(squared > 0 ? value * value / squared : 0);
  return result;
}

Reliability monte_carlo(const Section& section, const std::vector<Uncertainty>& uncertain, const FactorOf& factor,
                        int samples, unsigned long long seed) {
  Reliability result;
  int failures = 0;
  std::vector<double> u(uncertain.size());
  for (int k = 0; k < samples; ++k) {
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = standard_normal(seed, static_cast<std::uint64_t>(k), i);
    if (factor(realisation(section, uncertain, u)) < 1) ++failures;
  }
  result.evaluations = samples;
  result.probability = static_cast<double>(failures) / samples;
  result.index = -normal_quantile(result.probability);
  result.deviation = std::sqrt(result.probability * (1 - result.probability) / samples);
  return result;
}

}  // namespace polder::stability
