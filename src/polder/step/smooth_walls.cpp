// The layer whose speed is known is the row of cells beside the side, or the whole depth of a tongue that is thinner.
// The stress at the start of the step acts implicitly on its faces, so that no step is too long for it:
//
//   v ← V + (v − V) / (1 + τ A Δt / (m |v − V|)),  V the side's own velocity,
//
// m the water of the row and, where the next row is past the surface and will have this one's velocity, of both.
#include "polder/step/smooth_walls.hpp"

#include <algorithm>
#include <cmath>

#include "polder/step/face_loop.hpp"
#include "polder/step/face_predictor.hpp"
#include "polder/step/row_metric.hpp"

namespace polder {

double stress_on_smooth_wall(double speed, double layer, const WaterProperties& water) {
  constexpr double a = 8.3, b = 1.0 / 7;
  const double viscous = water.viscosity / (water.density * layer);  // m/s
  if (speed <= 0.5 * viscous * std::pow(a, 2 / (1 - b))) return 2 * water.viscosity * speed / layer;
  return water.density * std::pow(0.5 * (1 - b) * std::pow(a, (1 + b) / (1 - b)) * std::pow(viscous, 1 + b) +
                                      (1 + b) / a * std::pow(viscous, b) * speed,
                                  2 / (1 + b));
}

namespace {

struct FaceAlong {
  std::ptrdiff_t face, low, high;  ///< and the cells on either side of it
  int component;
  double height, volume;  ///< of the row of cells, m; of what the face stands for, m³
};

/// Calls body(FaceAlong) for the faces along a side.
template <class Space, class Body>
void over_faces_along(const Setup<Space>& setup, const StickySide& side, const GridFields<Space>& grid, Team& team,
                      Body&& body) {
  const auto& lattice = setup.lattice;
  const int row = side.end == 0 ? 0 : lattice.cells[side.axis] - 1;
  for (int c = 0; c < Space::axes; ++c) {
    if (c == side.axis) continue;
    by_spacing(lattice, [&]<bool graded>() {
      over_face_rows(lattice, grid.rows, c, team, [&](std::ptrdiff_t first, int count, const std::array<int, 3>& at) {
        if (side.axis != 0 && at[side.axis] != row) return;
        const RowMetric<Space, graded> metric(lattice, at);
        for (int i = 0; i < count; ++i) {
          if (side.axis == 0 && at[0] + i != row) continue;
          const std::ptrdiff_t f = first + i;
          const bool joined = setup.periodic && c == 0;
          const std::ptrdiff_t low = joined && at[0] + i == 0 ? f + lattice.cells[0] - 1 : f - lattice.stride[c];
          const std::ptrdiff_t high = joined && at[0] + i == lattice.cells[0] ? f - lattice.cells[0] : f;
          body(FaceAlong{f, low, high, c, metric.width(side.axis, i), metric.face_volume(c, i)});
        }
      });
    });
  }
}

}  // namespace

template <class Space>
void rub_along_smooth_walls(const Setup<Space>& setup, double dt, GridFields<Space>& grid, Team& team) {
  const auto& lattice = setup.lattice;
  for (const StickySide& side : setup.sticky_sides) {
    const std::ptrdiff_t inwards = (side.end == 0 ? 1 : -1) * lattice.stride[side.axis];
    const auto& wall =
        setup.water_box.velocity[static_cast<std::size_t>(side.axis)][static_cast<std::size_t>(side.end)];
    // of all components before any of them is slowed
    over_faces_along(setup, side, grid, team, [&](const FaceAlong& at) {
      const auto c = static_cast<std::size_t>(at.component);
      const double mass = grid.water_mass[c][at.face];
      const bool flows = mass > water_present * setup.water.density * at.volume;
      grid.water_before[c][at.face] = flows ? grid.water_velocity[c][at.face] / mass - wall[c] : 0;
    });
    over_faces_along(setup, side, grid, team, [&](const FaceAlong& at) {
      const int c = at.component;
      const std::ptrdiff_t f = at.face;
      const double along = grid.water_before[c][f], mass = grid.water_mass[c][f];
      const double fill = 0.5 * (grid.fill[at.low] + grid.fill[at.high]);
      if (along == 0 || fill <= 0 || grid.soil_mass[c][f] > 0) return;
      double square = along * along;
      for (int o = 0; o < Space::axes; ++o) {
        if (o == c || o == side.axis) continue;
        double across = 0;  // mean of the four faces around
        const std::ptrdiff_t s = lattice.stride[c], t = lattice.stride[o];
        for (const std::ptrdiff_t around : {f - s, f, f - s + t, f + t}) across += 0.25 * grid.water_before[o][around];
        square += across * across;
      }
      const bool surface = !grid.wet[at.low + inwards] && !grid.wet[at.high + inwards];
      const double above = surface ? grid.water_mass[c][f + inwards] : 0;
      const double speed = std::sqrt(square);
      const double stress = stress_on_smooth_wall(speed, at.height * std::min(1.0, fill), setup.water);
      const double slowed = along / (1 + stress * at.volume / at.height * dt / ((mass + above) * speed));
      grid.water_velocity[c][f] += mass * (slowed - along);
      grid.water_velocity[c][f + inwards] += above * (slowed - along);
    });
  }
}

template void rub_along_smooth_walls(const Setup<PlaneStrain>&, double, GridFields<PlaneStrain>&, Team&);
template void rub_along_smooth_walls(const Setup<Solid>&, double, GridFields<Solid>&, Team&);

}  // namespace polder
