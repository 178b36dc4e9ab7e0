#pragma once
// How fast the engine is on this machine: whole steps of a model, by kernel, and the memory that it takes.
#include <cstddef>
#include <string>

#include "polder/case/model.hpp"
#include "polder/step/stepper.hpp"

namespace polder::verify {

struct Timing {
  std::string name;
  SpaceKind space = SpaceKind::plane_strain;
  int threads = 1;
  std::size_t soil_points = 0, water_points = 0;
  std::size_t wet_cells = 0;  ///< unknowns of the pressure solve
  int steps = 0;
  double seconds = 0;     ///< wall time of these steps
  StepTimes kernels;      ///< of which by kernel, s
  double iterations = 0;  ///< of the pressure solve, per step
  double memory = 0;      ///< B, growth of the resident size from before the model to after its steps

  std::size_t points() const { return soil_points + water_points; }
  /// ns per point and step of a part of the wall time.
  double per_point(double part) const { return 1e9 * part / (static_cast<double>(points()) * steps); }
};

/// A saturated block of the soil of `like`, under its own weight between smooth walls, its surface free: square (a cube
/// in 3d), with about so many soil points and as many water points.
Model block(const Model& like, SpaceKind space, double soil_points);

/// Times `steps` steps of the model after a tenth as many (at least two) to warm up. Throws RunFailure.
Timing time_steps(const Model& model, int steps, int threads);

}  // namespace polder::verify
