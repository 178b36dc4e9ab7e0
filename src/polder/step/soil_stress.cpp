#include "polder/step/soil_stress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "polder/step/large_strain.hpp"

namespace polder {

namespace {

/// Strain of a chunk's points over the step, its trace being dilation × Δt.
template <class Space>
void compute_strain(const VelocityGradients<Space>& gradients, const double* dilation, double dt, int count,
                    StressBatch<Space::stress>& batch) {
  constexpr int axes = Space::axes;
  const auto& L = gradients.at;
  auto& strain = batch.strain;
  for (int l = 0; l < count; ++l) {
    double trace = 0;
    for (int a = 0; a < axes; ++a) trace += L[a][a][l];
    const double mean = (dilation[l] - trace) * dt / axes;
    for (int a = 0; a < axes; ++a) strain[a][l] = L[a][a][l] * dt + mean;
    if constexpr (axes == 2) strain[2][l] = 0;
    for (int a = 0; a < axes; ++a)
      for (int b = a + 1; b < axes; ++b) strain[stress_index<Space>(a, b)][l] = 0.5 * dt * (L[a][b][l] + L[b][a][l]);
  }
}

/// √(2/3 e:e) of the deviator of the strain.
template <int N>
void compute_shear(const StressBatch<N>& batch, int count, double* shear) {
  const auto& strain = batch.strain;
  for (int l = 0; l < count; ++l) {
    const double mean = (strain[0][l] + strain[1][l] + strain[2][l]) / 3;
    double square = 0;
    for (int a = 0; a < 3; ++a) square += (strain[a][l] - mean) * (strain[a][l] - mean);
    for (int s = 3; s < N; ++s) square += 2 * strain[s][l] * strain[s][l];
    shear[l] = std::sqrt(2.0 / 3.0 * square);
  }
}

/// Jaumann's rotation over the step: σ + (Wσ − σW), W = ½(L − Lᵀ) Δt.
template <class Space>
void rotate_stress(const VelocityGradients<Space>& gradients, double dt, std::size_t first, int count,
                   const SoilPoints<Space>& soil, StressBatch<Space::stress>& batch) {
  constexpr int components = Space::stress;
  const auto& L = gradients.at;
  std::array<const double*, static_cast<std::size_t>(components)> stress;
  for (int s = 0; s < components; ++s) stress[s] = soil.stress[s].data() + first;
  if constexpr (Space::axes == 2) {
    for (int l = 0; l < count; ++l) {
      const double w = 0.5 * dt * (L[0][1][l] - L[1][0][l]);
      const double xx = stress[0][l], yy = stress[1][l], xy = stress[3][l];
      batch.stress[0][l] = xx + 2 * w * xy;
      batch.stress[1][l] = yy - 2 * w * xy;
      batch.stress[2][l] = stress[2][l];
      batch.stress[3][l] = xy + w * (yy - xx);
    }
  } else {
    for (int l = 0; l < count; ++l) {
      // Wσ − σW = Wσ + (Wσ)ᵀ, W's three numbers being those of a rotation
      const double half = 0.5 * dt;
      const double w_xy = half * (L[0][1][l] - L[1][0][l]), w_yz = half * (L[1][2][l] - L[2][1][l]);
      const double w_zx = half * (L[2][0][l] - L[0][2][l]);
      const double xx = stress[0][l], yy = stress[1][l], zz = stress[2][l];
      const double xy = stress[3][l], yz = stress[4][l], zx = stress[5][l];
      batch.stress[0][l] = xx + 2 * (w_xy * xy - w_zx * zx);
      batch.stress[1][l] = yy + 2 * (w_yz * yz - w_xy * xy);
      batch.stress[2][l] = zz + 2 * (w_zx * zx - w_yz * yz);
      batch.stress[3][l] = xy + w_xy * (yy - xx) - w_zx * yz + w_yz * zx;
      batch.stress[4][l] = yz + w_yz * (zz - yy) - w_xy * zx + w_zx * xy;
      batch.stress[5][l] = zx + w_zx * (xx - zz) - w_yz * xy + w_xy * yz;
    }
  }
}

/// The porosity after a volume change: 1 − n falls as e^−ε_v. Steps are so short that the series is exact to round-off;
/// where they are not, the exponential itself.
void follow_volume(const double* dilation, double dt, int count, double* porosity) {
  const bool short_step = largest_magnitude(dilation, count) * dt < 0.1;
  for (int l = 0; l < count; ++l) {
    const double v = -dilation[l] * dt;
    const double decay =
        1 + v * (1 + v / 2 * (1 + v / 3 * (1 + v / 4 * (1 + v / 5 * (1 + v / 6 * (1 + v / 7 * (1 + v / 8)))))));
    const double n = 1 - (1 - porosity[l]) * (short_step ? decay : std::exp(v));
    porosity[l] = std::min(std::max(n, least_porosity), most_porosity);
  }
}

/// Grains out of contact: a viscous mixture.
template <class Space>
void flow_as_mixture(const Setup<Space>& setup, double dt, double dilation, const StressBatch<Space::stress>& all,
                     int l, std::size_t p, SoilPoints<Space>& soil) {
  const double viscosity = mixture_viscosity_beenakker(setup.water.viscosity, 1 - all.porosity[l]);
  const double mean = dilation * dt / Space::axes;
  for (int s = 0; s < Space::stress; ++s)
    soil.stress[s][p] = Space::axes == 2 && s == 2 ? 0 : 2 * viscosity * (all.strain[s][l] - (s < 3 ? mean : 0)) / dt;
}

/// The points of one material in a chunk of several, or among which some are out of contact: gathered for the law.
template <class Space>
void update_some(const Setup<Space>& setup, double dt, std::size_t first, int count, std::size_t m,
                 const double* dilation, const double* shear, const StressBatch<Space::stress>& all,
                 SoilPoints<Space>& soil, double* plastic_shear) {
  constexpr int N = Space::stress;
  const SoilMaterial& material = setup.materials[m];
  StressBatch<N> batch;
  int member[chunk_size];
  for (int l = 0; l < count; ++l) {
    const std::size_t p = first + static_cast<std::size_t>(l);
    if (soil.material[p] != m) continue;
    soil.porosity[p] = all.porosity[l];
    soil.deviatoric_strain[p] += shear[l];
    const bool was_fluid = soil.fluid[p];
    soil.fluid[p] = all.porosity[l] > material.max_porosity;
    if (soil.fluid[p]) {
      plastic_shear[l] = shear[l];
      flow_as_mixture(setup, dt, dilation[l], all, l, p, soil);
    } else if (was_fluid) {  // contact regained: nothing is remembered of the old stress
      for (int s = 0; s < N; ++s) soil.stress[s][p] = 0;
    } else {
      member[batch.count++] = l;
    }
  }
  if (batch.count == 0) return;
  for (int b = 0; b < batch.count; ++b) {
    const int l = member[b];
    for (int s = 0; s < N; ++s) {
      batch.stress[s][b] = all.stress[s][l];
      batch.strain[s][b] = all.strain[s][l];
    }
    batch.porosity[b] = all.porosity[l];
    for (int s = 0; s < StressBatch<N>::max_state; ++s)
      batch.state[s][b] = soil.state[s][first + static_cast<std::size_t>(l)];
  }
  material.law->update(batch);
  for (int b = 0; b < batch.count; ++b) {
    const std::size_t p = first + static_cast<std::size_t>(member[b]);
    for (int s = 0; s < N; ++s) soil.stress[s][p] = batch.stress[s][b];
    plastic_shear[member[b]] = batch.state[0][b] - soil.state[0][p];
    for (int s = 0; s < StressBatch<N>::max_state; ++s) soil.state[s][p] = batch.state[s][b];
  }
}

/// All points of a chunk, of one material and in contact.
template <class Space>
void update_all(const SoilMaterial& material, std::size_t first, int count, const double* shear,
                StressBatch<Space::stress>& batch, SoilPoints<Space>& soil, double* plastic_shear) {
  const auto copy = [&](const double* from, Array& to) { std::copy_n(from, count, to.data() + first); };
  copy(batch.porosity, soil.porosity);
  double* total = soil.deviatoric_strain.data() + first;
  for (int l = 0; l < count; ++l) total[l] += shear[l];
  for (int s = 0; s < StressBatch<Space::stress>::max_state; ++s)
    std::copy_n(soil.state[s].data() + first, count, batch.state[s]);
  batch.count = count;
  material.law->update(batch);
  const double* before = soil.state[0].data() + first;
  for (int l = 0; l < count; ++l) plastic_shear[l] = batch.state[0][l] - before[l];
  for (int s = 0; s < Space::stress; ++s) copy(batch.stress[s], soil.stress[s]);
  for (int s = 0; s < StressBatch<Space::stress>::max_state; ++s)  // what the law leaves alone need not be written
    if (std::memcmp(batch.state[s], soil.state[s].data() + first, sizeof(double) * static_cast<std::size_t>(count)) !=
        0)
      copy(batch.state[s], soil.state[s]);
}

}  // namespace

template <class Space>
void update_soil(const Setup<Space>& setup, double dt, std::size_t first, int count,
                 const VelocityGradients<Space>& gradients, const double* dilation, SoilPoints<Space>& soil,
                 double* plastic_shear) {
  StressBatch<Space::stress> batch;
  double shear[chunk_size];
  double own_dilation[chunk_size];
  if (setup.follows_large_strains()) {
    std::copy_n(dilation, count, own_dilation);
    stretch_and_turn(gradients, dt, first, count, soil, own_dilation, batch);
    dilation = own_dilation;
  } else {
    compute_strain(gradients, dilation, dt, count, batch);
    rotate_stress(gradients, dt, first, count, soil, batch);
  }
  compute_shear(batch, count, shear);
  std::copy_n(soil.porosity.data() + first, count, batch.porosity);
  follow_volume(dilation, dt, count, batch.porosity);

  const std::uint8_t *own = soil.material.data() + first, *fluid = soil.fluid.data() + first;
  if (std::equal(own + 1, own + count, own)) {
    const SoilMaterial& material = setup.materials[own[0]];
    if (!material.fixed && largest_magnitude(batch.porosity, count) <= material.max_porosity &&
        std::memchr(fluid, 1, static_cast<std::size_t>(count)) == nullptr)
      return update_all<Space>(material, first, count, shear, batch, soil, plastic_shear);
  }
  std::fill_n(plastic_shear, count, 0.0);
  for (std::size_t m = 0; m < setup.materials.size(); ++m)
    if (!setup.materials[m].fixed) update_some(setup, dt, first, count, m, dilation, shear, batch, soil, plastic_shear);
}

template void update_soil(const Setup<PlaneStrain>&, double, std::size_t, int, const VelocityGradients<PlaneStrain>&,
                          const double*, SoilPoints<PlaneStrain>&, double*);
template void update_soil(const Setup<Solid>&, double, std::size_t, int, const VelocityGradients<Solid>&, const double*,
                          SoilPoints<Solid>&, double*);

}  // namespace polder
