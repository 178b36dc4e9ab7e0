#include "polder/step/films.hpp"

#include <algorithm>

#include "polder/step/face_loop.hpp"
#include "polder/step/row_metric.hpp"

namespace polder {

template <class Space>
void spread_films(const Setup<Space>& setup, const StepControl& control, double dt, GridFields<Space>& grid,
                  Team& team) {
  constexpr int up = Space::up;
  const auto& lattice = setup.lattice;
  const double g = -setup.pull(up) * control.gravity_factor;
  if (g == 0 || control.hold_water) return;
  const std::uint8_t* wet = grid.wet.data();
  const double* fill = grid.fill.data();
  const std::ptrdiff_t over = lattice.stride[up];
  const OpenSide* base = setup.open_side(up, 0);
  // on a floor or on wet soil; what lies on water moves with it
  const auto rests = [&](std::ptrdiff_t cell) {
    if (lattice.place(cell, up) == 0) return !base || !base->part.covers(lattice.place(cell, 0));
    return setup.shut(up, cell) || (wet[cell - over] && grid.solid_volume[cell - over] > 0);
  };
  // share of a cell's height up to the surface of the film or of the water that ends in it
  const auto height = [&](std::ptrdiff_t cell) {
    return wet[cell] ? std::min(1.0, fill[cell]) : rests(cell) ? fill[cell] : 0;
  };
  by_spacing(lattice, [&]<bool graded>() {
    for (int c = 0; c < up; ++c) {
      const std::ptrdiff_t s = lattice.stride[c];
      const double *water_mass = grid.water_mass[c].data(), *soil_mass = grid.soil_mass[c].data();
      std::uint8_t* reached = grid.reached[c].data();
      double *velocity = grid.water_velocity[c].data(), *mobility = grid.mobility[c].data();
      over_face_rows(lattice, grid.rows, c, team, [&](std::ptrdiff_t first, int count, const auto& at) {
        const RowMetric<Space, graded> metric(lattice, at);
        for (int i = 0; i < count; ++i) {
          const std::ptrdiff_t f = first + i;
          if (i + 8 <= count && eight(wet + f) == eight_set && eight(wet + f - s) == eight_set) {
            i += 7;
            continue;
          }
          if (water_mass[f] == 0 || soil_mass[f] > 0 || grid.water_response[c][f] == 0) continue;
          const bool joined = setup.periodic && c == 0;
          const std::ptrdiff_t low = joined && at[0] + i == 0 ? f + lattice.cells[0] - 1 : f - s;
          const std::ptrdiff_t high = joined && at[0] + i == lattice.cells[0] ? f - lattice.cells[0] : f;
          if (wet[low] && wet[high]) continue;
          if (setup.bodies.open_cell(low) < 1 || setup.bodies.open_cell(high) < 1) continue;  // no level floor
          if (!rests(low) && !rests(high)) continue;
          if (wet[high] ? wet[high + over] || !rests(low) : wet[low] && (wet[low + over] || !rests(high))) continue;
          reached[f] = film_face;  // and the pressure of deeper water leaves it alone
          mobility[f] = 0;
          velocity[f] -= dt * g * (height(high) - height(low)) * metric.width(up, i) * metric.inverse_gap(c, i);
        }
      });
    }
  });
}

template <class Space>
void let_drops_slide(const Setup<Space>& setup, GridFields<Space>& grid) {
  const auto& lattice = setup.lattice;
  std::vector<std::ptrdiff_t> drops;
  Team alone(1);
  over_cell_rows(lattice, grid.rows, alone, [&](std::ptrdiff_t first, int count, const auto&) {
    for (std::ptrdiff_t cell = first; cell < first + count; ++cell) {
      if (!grid.wet[cell] || setup.bodies.open_cell(cell) >= 1) continue;
      bool single = true;
      for (int a = 0; a < Space::axes; ++a) {
        const std::ptrdiff_t s = lattice.stride[a];
        single = single && (!grid.wet[cell - s] || setup.shut(a, cell));
        single = single && (!grid.wet[cell + s] || setup.shut(a, cell + s));
      }
      if (single) drops.push_back(cell);
    }
  });
  for (const std::ptrdiff_t cell : drops) grid.wet[cell] = 0;
}

template void let_drops_slide(const Setup<PlaneStrain>&, GridFields<PlaneStrain>&);
template void let_drops_slide(const Setup<Solid>&, GridFields<Solid>&);
template void spread_films(const Setup<PlaneStrain>&, const StepControl&, double, GridFields<PlaneStrain>&, Team&);
template void spread_films(const Setup<Solid>&, const StepControl&, double, GridFields<Solid>&, Team&);

}  // namespace polder
