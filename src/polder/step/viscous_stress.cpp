#include "polder/step/viscous_stress.hpp"

#include <algorithm>

#include "polder/step/face_loop.hpp"
#include "polder/step/face_predictor.hpp"

namespace polder {

namespace {

/// 1 over what a face of component c stands for along an axis (its own: `along`) times the way to the next one.
double inverse_square(const GridAxis& axis, bool along, int place, int way) {
  if (!axis.graded()) return 1 / (axis.least() * axis.least());
  const double own = along ? axis.gap(place) : axis.width(place);
  return 1 / (own * (along ? axis.width(way < 0 ? place - 1 : place) : axis.gap(way < 0 ? place : place + 1)));
}

}  // namespace

template <class Space>
void add_viscous_stress(const Setup<Space>& setup, double dt, GridFields<Space>& grid, Team& team) {
  const auto& lattice = setup.lattice;
  const double nu = setup.water.viscosity / setup.water.density;
  const double least = water_present * setup.water.density * lattice.cell_volume();
  for (int c = 0; c < Space::axes; ++c) {
    Array& velocity = grid.water_before[c];
    const double* mass = grid.water_mass[c].data();
    double* momentum = grid.water_velocity[c].data();
    over_face_rows(lattice, grid.rows, c, team, [&](std::ptrdiff_t first, int count, const std::array<int, 3>& at) {
      for (int i = 0; i < count; ++i) {
        const std::ptrdiff_t f = first + i;
        const int place = c == 0 ? at[0] + i : at[c];
        velocity[f] = mass[f] > least ? momentum[f] / mass[f] : 0;
        for (int end = 0; end < 2; ++end)
          if (!setup.water_box.periodic(c) && place == (end == 0 ? 0 : lattice.cells[c]) && !setup.open_side(c, end))
            velocity[f] = setup.wall_velocity(c, end);
      }
    });
    reflect(velocity, c, true, setup.water_box, lattice, true);
    Array inside = grid.water_mass[c];  // where there is water, beyond the walls as well
    reflect(inside, c, false, setup.water_box, lattice);
    over_face_rows(lattice, grid.rows, c, team, [&](std::ptrdiff_t first, int count, const std::array<int, 3>& at) {
      for (std::ptrdiff_t f = first; f < first + count; ++f) {
        if (!(inside[f] > least)) continue;
        double sum = 0;
        for (int a = 0; a < Space::axes; ++a) {
          const std::ptrdiff_t s = lattice.stride[a];
          const int place = a == 0 ? at[0] + static_cast<int>(f - first) : at[a];
          for (const int way : {-1, 1})
            if (inside[f + way * s] > least)
              sum += inverse_square(lattice.axis[a], a == c, place, way) * (velocity[f + way * s] - velocity[f]);
        }
        momentum[f] += mass[f] * nu * dt * sum;
      }
    });
    if (setup.water_box.periodic(c))
      detail::over_joined(c, setup.water_box, lattice, {},
                          [&](std::ptrdiff_t low, std::ptrdiff_t high) { momentum[high] = momentum[low]; });
  }
}

template void add_viscous_stress(const Setup<PlaneStrain>&, double, GridFields<PlaneStrain>&, Team&);
template void add_viscous_stress(const Setup<Solid>&, double, GridFields<Solid>&, Team&);

}  // namespace polder
