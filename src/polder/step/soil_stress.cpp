#include "polder/step/soil_stress.hpp"

#include <cmath>

namespace polder {

namespace {

constexpr double least_porosity = 0.2, most_porosity = 0.98;

/// Strain increment, in the storage order of stress, with its trace replaced by `volumetric`.
template <class Space>
std::array<double, Space::stress> strain_increment(const VelocityGradients<Space>& gradients, int l, double dt,
                                                   double volumetric) {
  std::array<double, Space::stress> e{};
  double trace = 0;
  for (int a = 0; a < Space::axes; ++a) {
    e[a] = gradients.at[a][a][l] * dt;
    trace += e[a];
  }
  for (int a = 0; a < Space::axes; ++a) {
    e[a] += (volumetric - trace) / Space::axes;
    for (int b = a + 1; b < Space::axes; ++b)
      e[stress_index<Space>(a, b)] = 0.5 * dt * (gradients.at[a][b][l] + gradients.at[b][a][l]);
  }
  return e;
}

/// Jaumann's rotation over the step: σ + (Wσ − σW), W = ½(L − Lᵀ) Δt.
template <class Space>
std::array<double, Space::stress> rotated(const SoilPoints<Space>& soil, std::size_t p,
                                          const VelocityGradients<Space>& gradients, int l, double dt) {
  if constexpr (Space::axes == 2) {
    const double w = 0.5 * dt * (gradients.at[0][1][l] - gradients.at[1][0][l]);
    const double xx = soil.stress[0][p], yy = soil.stress[1][p], xy = soil.stress[3][p];
    return {xx + 2 * w * xy, yy - 2 * w * xy, soil.stress[2][p], xy + w * (yy - xx)};
  } else {
    double s[3][3], w[3][3];
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        s[a][b] = soil.stress[stress_index<Space>(a, b)][p];
        w[a][b] = 0.5 * dt * (gradients.at[a][b][l] - gradients.at[b][a][l]);
      }
    std::array<double, Space::stress> out{};
    for (int a = 0; a < 3; ++a)
      for (int b = a; b < 3; ++b) {
        double sum = s[a][b];
        for (int k = 0; k < 3; ++k) sum += w[a][k] * s[k][b] - s[a][k] * w[k][b];
        out[stress_index<Space>(a, b)] = sum;
      }
    return out;
  }
}

/// √(2/3 e:e) of the deviator of e.
template <class Space>
double equivalent_strain(const std::array<double, Space::stress>& e) {
  const double mean = (e[0] + e[1] + e[2] * (Space::axes == 3)) / 3;
  double square = 0;
  for (int a = 0; a < 3; ++a) {
    const double d = (a < Space::axes ? e[a] : 0) - mean;
    square += d * d;
  }
  for (int s = 3; s < Space::stress; ++s) square += 2 * e[s] * e[s];
  return std::sqrt(2.0 / 3.0 * square);
}

}  // namespace

template <class Space>
void update_soil(const Setup<Space>& setup, double dt, std::size_t first, int count,
                 const VelocityGradients<Space>& gradients, const double* dilation, SoilPoints<Space>& soil) {
  constexpr int N = Space::stress;
  StressBatch<N> batch;
  int member[chunk_size];
  for (std::size_t m = 0; m < setup.materials.size(); ++m) {
    const SoilMaterial& material = setup.materials[m];
    batch.count = 0;
    for (int l = 0; l < count; ++l) {
      const std::size_t p = first + l;
      if (soil.material[p] != m || material.fixed) continue;
      const double volumetric = dilation[l] * dt;
      const double n = 1 - (1 - soil.porosity[p]) * std::exp(-volumetric);
      soil.porosity[p] = n < least_porosity ? least_porosity : n > most_porosity ? most_porosity : n;
      const auto strain = strain_increment<Space>(gradients, l, dt, volumetric);
      soil.deviatoric_strain[p] += equivalent_strain<Space>(strain);

      const bool was_fluid = soil.fluid[p];
      soil.fluid[p] = soil.porosity[p] > material.max_porosity;
      if (soil.fluid[p]) {  // grains out of contact: a viscous mixture
        const double viscosity = mixture_viscosity_beenakker(setup.water.viscosity, 1 - soil.porosity[p]);
        const double mean = volumetric / Space::axes;
        for (int s = 0; s < N; ++s)
          soil.stress[s][p] = s >= Space::axes && s < 3 ? 0 : 2 * viscosity * (strain[s] - (s < 3 ? mean : 0)) / dt;
        continue;
      }
      if (was_fluid) {  // contact regained: nothing is remembered of the old stress
        for (int s = 0; s < N; ++s) soil.stress[s][p] = 0;
        continue;
      }
      const int b = batch.count++;
      member[b] = l;
      const auto trial = rotated<Space>(soil, p, gradients, l, dt);
      for (int s = 0; s < N; ++s) {
        batch.stress[s][b] = trial[s];
        batch.strain[s][b] = strain[s];
      }
      batch.porosity[b] = soil.porosity[p];
      for (int s = 0; s < StressBatch<N>::max_state; ++s) batch.state[s][b] = soil.state[s][p];
    }
    if (batch.count == 0) continue;
    material.law->update(batch);
    for (int b = 0; b < batch.count; ++b) {
      const std::size_t p = first + member[b];
      for (int s = 0; s < N; ++s) soil.stress[s][p] = batch.stress[s][b];
      for (int s = 0; s < StressBatch<N>::max_state; ++s) soil.state[s][p] = batch.state[s][b];
    }
  }
}

template void update_soil(const Setup<PlaneStrain>&, double, std::size_t, int, const VelocityGradients<PlaneStrain>&,
                          const double*, SoilPoints<PlaneStrain>&);
template void update_soil(const Setup<Solid>&, double, std::size_t, int, const VelocityGradients<Solid>&, const double*,
                          SoilPoints<Solid>&);

}  // namespace polder
