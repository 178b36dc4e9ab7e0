#pragma once
// The interface of a soil law. A law is one file that implements SoilLaw and one line in laws.cpp that registers it.
//
// Signs and units: stress in Pa, positive in tension; strain increments dimensionless, tensor shear components
// (not engineering); angles in radians inside, parameters in SI. The caller has rotated the stress objectively and
// updated the porosity; the law returns the stress at the end of the step and its own state.
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace polder {

/// What one number of a law (or of the material) is: the case file, its checks, its documentation and the JSON schema
/// are all made from tables of these.
struct Parameter {
  std::string_view key;     ///< name in the case file, e.g. "friction_angle"
  std::string_view symbol;  ///< symbol in theory.md and in reports, e.g. "φ'"
  /// Kind of quantity, which fixes the units taken: "pressure", "angle", "ratio", "length"…; "choice:a|b" is a word in
  /// the case file and its place in that list (0, 1, …) as a value.
  std::string_view quantity;
  bool required;
  double standard;   ///< value where the key is left out (SI); NaN: "not given", the law works it out
  double low, high;  ///< allowed range (SI), inclusive
  std::string_view doc;
};

/// Points that share one material, gathered so that a law can run over them without indirection.
/// N is the size of the stress (4: xx yy zz xy; 6: xx yy zz xy yz zx).
template <int N>
struct alignas(64) StressBatch {
  static constexpr int capacity = 64;
  static constexpr int max_state = 4;
  int count = 0;
  double stress[N][capacity];         ///< Pa; in: rotated stress of the last step; out: stress of this step
  double strain[N][capacity];         ///< increment over the step
  double porosity[capacity];          ///< after the step
  double state[max_state][capacity];  ///< the law's own; row 0 is always the plastic shear strain
};

/// What a law may use of the numerical model around a point.
struct LawContext {
  double cell_size = 0;  ///< m, smallest spacing of the grid; a law that is regularised by a length compares with it
  double initial_porosity = 0;
  double max_porosity = 1;
};

class SoilLaw {
 public:
  virtual ~SoilLaw() = default;
  virtual void update(StressBatch<4>& batch) const = 0;
  virtual void update(StressBatch<6>& batch) const = 0;
  /// Oedometric (P-wave) modulus in Pa, an upper bound over the states the law can reach from `mean_pressure` (Pa,
  /// compression positive); sets the time step.
  virtual double constrained_modulus(double mean_pressure) const = 0;
  /// Whether the law follows stretches and turns of any size, so that it wants a step's strain (log V) and the rotation
  /// before it to second order; others are content with the first.
  virtual bool follows_large_strains() const { return false; }
  /// State variables used beyond the plastic shear strain (row 0), by name; at most StressBatch::max_state − 1.
  virtual std::vector<std::string> state_names() const { return {}; }
  /// Initial values of those rows for a point under `mean_pressure` (Pa, compression positive).
  virtual void initial_state(double /*mean_pressure*/, double /*porosity*/, std::span<double> /*state*/) const {}
};

/// A value that is in its own range and yet cannot be used together with the others.
struct Complaint {
  std::string_view key;  ///< of the parameter to change
  std::string message;   ///< what is wrong and what to do, for the user
};

struct LawDescription {
  std::string_view name;  ///< value of `law` in the case file, e.g. "mohr-coulomb"
  std::string_view doc;
  std::span<const Parameter> parameters;
  /// `values` in the order of `parameters`.
  std::unique_ptr<SoilLaw> (*make)(std::span<const double> values, const LawContext& context);
  /// Checks between parameters, to be asked before `make`; empty where there are none or all is well.
  std::vector<Complaint> (*check)(std::span<const double> values, const LawContext& context) = nullptr;
};

/// All laws that the program knows.
std::span<const LawDescription> soil_laws();
/// nullptr where there is none of that name.
const LawDescription* find_soil_law(std::string_view name);

}  // namespace polder
