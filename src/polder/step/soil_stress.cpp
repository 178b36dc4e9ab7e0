#include "polder/step/soil_stress.hpp"

#include <algorithm>
#include <cmath>

namespace polder {

namespace {

/// What a step does to a chunk of points, before the law is asked.
template <class Space>
struct alignas(64) Increments {
  static constexpr int axes = Space::axes, components = Space::stress;
  double strain[components][chunk_size];  // its trace is `volumetric`
  double trial[components][chunk_size];  // Jaumann's rotation over the step: σ + (Wσ − σW), W = ½(L − Lᵀ) Δt
  double volumetric[chunk_size];

  void compute_strain(const VelocityGradients<Space>& gradients, const double* dilation, double dt, int count) {
    const auto& L = gradients.at;
    for (int l = 0; l < count; ++l) {
      volumetric[l] = dilation[l] * dt;
      double trace = 0;
      for (int a = 0; a < axes; ++a) trace += L[a][a][l] * dt;
      for (int a = 0; a < axes; ++a) strain[a][l] = L[a][a][l] * dt + (volumetric[l] - trace) / axes;
      if constexpr (axes == 2) strain[2][l] = 0;
      for (int a = 0; a < axes; ++a)
        for (int b = a + 1; b < axes; ++b) strain[stress_index<Space>(a, b)][l] = 0.5 * dt * (L[a][b][l] + L[b][a][l]);
    }
  }

  /// √(2/3 e:e) of the deviator of the strain.
  void compute_shear(int count, double* shear) const {
    for (int l = 0; l < count; ++l) {
      const double mean = (strain[0][l] + strain[1][l] + strain[2][l]) / 3;
      double square = 0;
      for (int a = 0; a < 3; ++a) square += (strain[a][l] - mean) * (strain[a][l] - mean);
      for (int s = 3; s < components; ++s) square += 2 * strain[s][l] * strain[s][l];
      shear[l] = std::sqrt(2.0 / 3.0 * square);
    }
  }

  void compute_trial(const VelocityGradients<Space>& gradients, double dt, std::size_t first, int count,
                     const SoilPoints<Space>& soil) {
    const auto& L = gradients.at;
    std::array<const double*, static_cast<std::size_t>(components)> stress;
    for (int s = 0; s < components; ++s) stress[s] = soil.stress[s].data() + first;
    if constexpr (axes == 2) {
      for (int l = 0; l < count; ++l) {
        const double w = 0.5 * dt * (L[0][1][l] - L[1][0][l]);
        const double xx = stress[0][l], yy = stress[1][l], xy = stress[3][l];
        trial[0][l] = xx + 2 * w * xy;
        trial[1][l] = yy - 2 * w * xy;
        trial[2][l] = stress[2][l];
        trial[3][l] = xy + w * (yy - xx);
      }
    } else {
      for (int l = 0; l < count; ++l) {
        double s[3][3], w[3][3];
        for (int a = 0; a < 3; ++a)
          for (int b = 0; b < 3; ++b) {
            s[a][b] = stress[stress_index<Space>(a, b)][l];
            w[a][b] = 0.5 * dt * (L[a][b][l] - L[b][a][l]);
          }
        for (int a = 0; a < 3; ++a)
          for (int b = a; b < 3; ++b) {
            double sum = s[a][b];
            for (int k = 0; k < 3; ++k) sum += w[a][k] * s[k][b] - s[a][k] * w[k][b];
            trial[stress_index<Space>(a, b)][l] = sum;
          }
      }
    }
  }
};

/// The porosity after a volume change: 1 − n falls as e^−ε_v. Steps are so short that the series is exact to round-off;
/// where they are not, the exponential itself.
void follow_volume(const double* volumetric, int count, double* porosity) {
  double largest = 0;
  for (int l = 0; l < count; ++l) largest = std::max(largest, std::abs(volumetric[l]));
  for (int l = 0; l < count; ++l) {
    const double v = -volumetric[l];
    const double decay =
        1 + v * (1 + v / 2 * (1 + v / 3 * (1 + v / 4 * (1 + v / 5 * (1 + v / 6 * (1 + v / 7 * (1 + v / 8)))))));
    const double n = 1 - (1 - porosity[l]) * (largest < 0.1 ? decay : std::exp(v));
    porosity[l] = std::min(std::max(n, least_porosity), most_porosity);
  }
}

}  // namespace

template <class Space>
void update_soil(const Setup<Space>& setup, double dt, std::size_t first, int count,
                 const VelocityGradients<Space>& gradients, const double* dilation, SoilPoints<Space>& soil,
                 double* plastic_shear) {
  constexpr int N = Space::stress;
  Increments<Space> increments;
  double shear[chunk_size];
  increments.compute_strain(gradients, dilation, dt, count);
  increments.compute_shear(count, shear);
  std::fill_n(plastic_shear, count, 0.0);
  increments.compute_trial(gradients, dt, first, count, soil);
  double porosity[chunk_size];
  std::copy_n(soil.porosity.data() + first, count, porosity);
  follow_volume(increments.volumetric, count, porosity);

  StressBatch<N> batch;
  int member[chunk_size];
  for (std::size_t m = 0; m < setup.materials.size(); ++m) {
    const SoilMaterial& material = setup.materials[m];
    if (material.fixed) continue;
    batch.count = 0;
    for (int l = 0; l < count; ++l) {
      const std::size_t p = first + l;
      if (soil.material[p] != m) continue;
      soil.porosity[p] = porosity[l];
      soil.deviatoric_strain[p] += shear[l];
      const bool was_fluid = soil.fluid[p];
      soil.fluid[p] = porosity[l] > material.max_porosity;
      if (soil.fluid[p]) {  // grains out of contact: a viscous mixture
        plastic_shear[l] = shear[l];
        const double viscosity = mixture_viscosity_beenakker(setup.water.viscosity, 1 - porosity[l]);
        const double mean = increments.volumetric[l] / Space::axes;
        for (int s = 0; s < N; ++s)
          soil.stress[s][p] =
              Space::axes == 2 && s == 2 ? 0 : 2 * viscosity * (increments.strain[s][l] - (s < 3 ? mean : 0)) / dt;
      } else if (was_fluid) {  // contact regained: nothing is remembered of the old stress
        for (int s = 0; s < N; ++s) soil.stress[s][p] = 0;
      } else {
        member[batch.count++] = l;
      }
    }
    if (batch.count == 0) continue;
    if (batch.count == count) {
      for (int s = 0; s < N; ++s) {
        std::copy_n(increments.trial[s], count, batch.stress[s]);
        std::copy_n(increments.strain[s], count, batch.strain[s]);
      }
      std::copy_n(porosity, count, batch.porosity);
      for (int s = 0; s < StressBatch<N>::max_state; ++s)
        std::copy_n(soil.state[s].data() + first, count, batch.state[s]);
    } else {
      for (int b = 0; b < batch.count; ++b) {
        const int l = member[b];
        for (int s = 0; s < N; ++s) {
          batch.stress[s][b] = increments.trial[s][l];
          batch.strain[s][b] = increments.strain[s][l];
        }
        batch.porosity[b] = porosity[l];
        for (int s = 0; s < StressBatch<N>::max_state; ++s) batch.state[s][b] = soil.state[s][first + l];
      }
    }
    material.law->update(batch);
    for (int b = 0; b < batch.count; ++b) {
      const std::size_t p = first + member[b];
      for (int s = 0; s < N; ++s) soil.stress[s][p] = batch.stress[s][b];
      plastic_shear[member[b]] = batch.state[0][b] - soil.state[0][p];
      for (int s = 0; s < StressBatch<N>::max_state; ++s) soil.state[s][p] = batch.state[s][b];
    }
  }
}

template void update_soil(const Setup<PlaneStrain>&, double, std::size_t, int, const VelocityGradients<PlaneStrain>&,
                          const double*, SoilPoints<PlaneStrain>&, double*);
template void update_soil(const Setup<Solid>&, double, std::size_t, int, const VelocityGradients<Solid>&, const double*,
                          SoilPoints<Solid>&, double*);

}  // namespace polder
