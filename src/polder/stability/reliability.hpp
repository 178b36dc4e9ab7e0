#pragma once
// Design values with partial factors, and the probability of failure from scatter of strengths and heads.
#include <functional>
#include <string>
#include <vector>

#include "polder/case/model.hpp"
#include "polder/stability/section.hpp"

namespace polder::stability {

/// The section with its strengths divided and its loads multiplied by the partial factors. The factor of safety of the
/// result, divided by `factors.model`, must be at least 1.
Section design_section(Section section, const PartialFactors& factors);

/// Characteristic strength (5 % of a lognormal population lies below it) from the mean and the coefficient of
/// variation.
double characteristic_value(double mean, double variation);

struct Uncertainty;

/// The section with the strengths of its uncertain soils lowered from their means to their characteristic values.
Section characteristic_section(Section section, const std::vector<Uncertainty>& uncertain);

/// One uncertain quantity, independent of the others: a factor on the strength of a soil (lognormal, mean 1) or a rise
/// of all heads (normal, mean 0).
struct Uncertainty {
  std::string name;
  int soil = -1;         ///< index into the section's soils; −1: heads
  double deviation = 0;  ///< coefficient of variation, or m
};

/// Those that the case states (strength.variation, stability.head_deviation).
std::vector<Uncertainty> uncertainties(const Model& model, const Input& input);

/// The section at the standard normal values `u`, one per uncertainty.
Section realisation(const Section& section, const std::vector<Uncertainty>& uncertain, const std::vector<double>& u);

/// Factor of safety of a section.
using FactorOf = std::function<double(const Section&)>;

struct Reliability {
  double index = 0;                  ///< β
  double probability = 0;            ///< of a factor below 1
  std::vector<double> design_point;  ///< standard normal values (FORM)
  std::vector<double> influence;     ///< squares of the direction cosines, sum 1 (FORM)
  double deviation = 0;              ///< standard error of `probability` (Monte Carlo)
  int evaluations = 0;
  bool converged = true;
};

/// First-order reliability: the point of F = 1 nearest to the mean, in standard normal space (Hasofer & Lind 1974,
/// Rackwitz & Fiessler 1978).
Reliability form(const Section& section, const std::vector<Uncertainty>& uncertain, const FactorOf& factor);

/// Crude Monte Carlo with a fixed seed.
Reliability monte_carlo(const Section& section, const std::vector<Uncertainty>& uncertain, const FactorOf& factor,
                        int samples, unsigned long long seed = 1);

/// Φ and its inverse.
double normal_probability(double u);
double normal_quantile(double probability);

}  // namespace polder::stability
