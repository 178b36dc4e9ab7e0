#pragma once
// The factors of safety of a case, method by method, as one table: with mean, characteristic and design strengths,
// under each assumption about the water, beside the references of the case; and the probability of failure.
#include <functional>
#include <string>
#include <vector>

#include "polder/stability/dike_checks.hpp"
#include "polder/stability/expected.hpp"
#include "polder/stability/methods.hpp"
#include "polder/stability/reliability.hpp"

namespace polder::stability {

enum class Strengths { given, characteristic, design };

struct Factor {
  std::string label;  ///< the method, and in brackets what differs from the plain row: "bishop (design)"
  std::string method;
  std::string water;  ///< "seepage" or "water net"
  Strengths strengths = Strengths::given;
  std::size_t section = 0;  ///< index into Assessment::sections
  Outcome outcome;
  double factor = 0;   ///< of design strengths divided by the factor of the model
  double seconds = 0;  ///< wall time
  std::optional<ExpectedFactor> expected;
  bool pass() const;
};

struct Probability {
  std::string method, kind;  ///< kind: "FORM" or "Monte Carlo"
  std::vector<std::string> uncertain;
  Reliability reliability;
  double seconds = 0;
};

struct AssessmentOptions {
  std::vector<const StabilityMethod*> methods;
  bool contours = false;  ///< least factors over a grid of centres around Bishop's critical circle
  bool form = false;
  int samples = 0;  ///< of Monte Carlo; 0: none
  bool dike_checks = true;
};

struct Assessment {
  std::string name, title;
  std::vector<StudySection> sections;
  std::vector<Factor> factors;
  std::vector<DikeCheck> checks;
  std::vector<Probability> probabilities;
  std::vector<std::string> notes;
};

/// Called after every factor.
using Told = std::function<void(const Factor&)>;

/// Everything that the case asks for. Probabilities are by the first method of slices. Throws std::invalid_argument
/// where the case has no section, or nothing in it is uncertain though a probability is asked for.
Assessment assess(const Study& study, const AssessmentOptions& options, const std::vector<ExpectedFactor>& expected,
                  const Told& told = {});

}  // namespace polder::stability
