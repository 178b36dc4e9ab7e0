#pragma once
// The phases of a step by name, for whoever reports their times.
#include "polder/step/stepper.hpp"

namespace polder {

struct Kernel {
  const char* key;  ///< in JSON; a reader meets it with spaces for the underscores
  double StepTimes::*seconds;
};

inline constexpr Kernel kernels[] = {{"sort", &StepTimes::sort},        {"points_to_grid", &StepTimes::to_grid},
                                     {"faces", &StepTimes::faces},      {"pressure", &StepTimes::pressure},
                                     {"volume", &StepTimes::volume},    {"grid_to_points", &StepTimes::to_points},
                                     {"resample", &StepTimes::resample}};

}  // namespace polder
