#pragma once
// Strain to stress at a chunk of soil points: volume change, contact between the grains, objective rotation, soil law.
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

}  // namespace polder
