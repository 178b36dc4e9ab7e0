#pragma once
// Strain to stress at a chunk of soil points: volume change, contact between the grains, objective rotation, soil law.
#include <algorithm>

#include "polder/points/point_sets.hpp"
#include "polder/step/chunk.hpp"
#include "polder/step/setup.hpp"

namespace polder {

/// Velocity gradients of a chunk: gradient[c][a] = ∂v_c/∂x_a, 1/s.
template <class Space>
struct alignas(64) VelocityGradients {
  double at[Space::axes][Space::axes][chunk_room];
};

/// Updates porosity, contact, stress, strains and state of the points [first, first + count). `dilation` is the rate of
/// volume change, 1/s, that each point is to follow (F-bar); `plastic_shear` receives what the step added to the
/// points' plastic shear strain, the whole deviatoric strain √(2/3 e:e) where the grains are out of contact.
template <class Space>
void update_soil(const Setup<Space>& setup, double dt, std::size_t first, int count,
                 const VelocityGradients<Space>& gradients, const double* dilation, SoilPoints<Space>& soil,
                 double* plastic_shear);

/// The porosity after a step of a point whose grains are out of contact, `max_porosity` being where they lose it. What
/// its strain says, that of a fluid, cannot be integrated for long: it goes a little of the way to the porosity of the
/// grid around it. Where grains have settled it comes back to just below `max_porosity` and not, in one go, to a dense
/// packing.
inline double relaxed_porosity(double porosity, double of_grid, double max_porosity) {
  const double share = 0.02, target = std::clamp(of_grid, max_porosity - 0.02, 0.95);
  return porosity + share * (target - porosity);
}

}  // namespace polder
