#include "polder/stage/rest.hpp"

#include <cmath>

namespace polder {

template <class Space>
Unrest unrest(const Stepper<Space>& state, double dt) {
  if (state.unsaturated) return {state.unsaturated->calm.energy_over_weight, state.unsaturated->calm.unbalanced_now};
  const auto& setup = state.setup;
  const auto& grid = state.grid;
  const auto& lattice = setup.lattice;
  double energy = 0, force = 0, mass = 0;
  for (int c = 0; c < Space::axes; ++c) {
    const auto add = [&](const Array& m, const Array& now, const Array& before, std::ptrdiff_t f) {
      if (m[f] == 0) return;
      energy += 0.5 * m[f] * now[f] * now[f];
      force += m[f] * std::abs(now[f] - before[f]) / dt;
      if (c == Space::up) mass += m[f];
    };
    for (std::ptrdiff_t f = 0; f < lattice.size; ++f) {
      add(grid.soil_mass[c], grid.soil_velocity[c], grid.soil_before[c], f);
      add(grid.water_mass[c], grid.water_velocity[c], grid.water_before[c], f);
    }
  }
  const double weight = mass * setup.gravity;
  if (!(weight > 0)) return {};
  return {energy / (weight * lattice.spacing[Space::up]), force / weight};
}

template Unrest unrest(const Stepper<PlaneStrain>&, double);
template Unrest unrest(const Stepper<Solid>&, double);

}  // namespace polder
