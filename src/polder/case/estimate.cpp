#include "polder/case/estimate.hpp"

#include <algorithm>
#include <cmath>

#include "polder/material/law.hpp"

namespace polder {

std::size_t cell_count(const Model& model) {
  std::size_t count = 1;
  const std::size_t axes = model.space == SpaceKind::solid ? 3 : 2;
  for (std::size_t k = 0; k < axes; ++k) count *= static_cast<std::size_t>(grid_axis(model, k).cells());
  return count;
}

double estimated_step(const Model& model) {
  const std::size_t axes = model.space == SpaceKind::solid ? 3 : 2;
  const double cell = smallest_cell(model);
  const double height = model.size[axes - 1];
  double step = 0.5 * cell / std::sqrt(2 * std::max(model.gravity, 1e-12) * height);
  for (const SoilBody& soil : model.soils) {
    const MaterialInput& material = model.materials[static_cast<std::size_t>(soil.material)];
    if (material.fixed) continue;
    const double bulk_density = (1 - material.porosity) * material.grain_density;
    const auto law =
        find_soil_law(material.law)->make(material.law_parameters, {cell, material.porosity, material.max_porosity});
    const double modulus = law->constrained_modulus(bulk_density * model.gravity * height);
    step = std::min(step, model.numerics.cfl * cell / std::sqrt(modulus / bulk_density));
  }
  return std::min(step, model.numerics.max_step);
}

StepCount estimated_steps(const Model& model) {
  const double step = estimated_step(model);
  StepCount count;
  for (const Stage& stage : model.stages) {
    const double scaling = stage.mass_scaling.value_or(model.numerics.mass_scaling);
    const double stretch = stage.step_stretch.value_or(model.numerics.step_stretch);
    const auto steps = [&](double factor) { return stage.duration / std::min(step * factor, model.numerics.max_step); };
    count.moving += steps(std::sqrt(scaling));
    count.at_rest += steps(std::sqrt(scaling) * stretch);
  }
  return count;
}

}  // namespace polder
