#include "polder/step/rain.hpp"

#include <algorithm>
#include <limits>

#include "polder/math/random.hpp"

namespace polder {

namespace {

constexpr double parcel = 0.125;  // × a nominal point
constexpr double a_little = 0.1;  // of a cell, of soil or water: rain falls on it and not through it

/// m/s on a column whose middle is at x, mean over its width.
double rate_on(const Rain& rain, double time, double x, double width) {
  if (!rain.span) return rain.rate(time);
  const double covered = std::min(x + 0.5 * width, (*rain.span)[1]) - std::max(x - 0.5 * width, (*rain.span)[0]);
  return rain.rate(time) * std::max(0.0, covered) / width;
}

}  // namespace

template <class Space>
std::vector<Exchange> let_it_rain(const Setup<Space>& setup, double time, double dt, GridFields<Space>& grid,
                                  std::uint64_t& next_id, WaterPoints<Space>& water) {
  constexpr int up = Space::up;
  const auto& lattice = setup.lattice;
  const double volume = lattice.cell_volume(), size = parcel * setup.nominal_point_volume();
  std::vector<Exchange> exchanged;
  for (int k = 0; k < (Space::axes == 3 ? lattice.cells[1] : 1); ++k)
    for (int i = 0; i < lattice.cells[0]; ++i) {
      const std::ptrdiff_t base = Space::axes == 3 ? lattice.index(i, k, 0) : lattice.index(i, 0);
      double rate = 0;
      for (const Rain& rain : setup.rains)
        rate += rate_on(rain, time, (i + 0.5) * lattice.spacing[0], lattice.spacing[0]);
      double& fallen = grid.rain[base];
      fallen += rate * dt * lattice.face_area(up);
      if (fallen < size) continue;
      int top = -1;  // the uppermost cell with something in it
      for (int level = lattice.cells[up] - 1; level >= 0 && top < 0; --level) {
        const std::ptrdiff_t cell = base + level * lattice.stride[up];
        if (grid.wet[cell] || grid.water_volume[cell] > a_little * volume ||
            grid.solid_volume[cell] > a_little * volume || setup.bodies.open_cell(cell) < 1 - a_little)
          top = level;
      }
      const int level = std::min(top + 1, lattice.cells[up] - 1);
      const std::ptrdiff_t cell = base + level * lattice.stride[up];
      const std::size_t p = append_points(water, 1);
      water.id[p] = next_id++;
      water.volume[p] = fallen;
      const std::array<int, 3> place = Space::axes == 3 ? std::array{i, k, level} : std::array{i, level, 0};
      for (int a = 0; a < Space::axes; ++a) {
        const double share = a == up ? 0.25 : uniform(setup.numerics.seed, water.id[p], static_cast<std::uint64_t>(a));
        water.position[a][p] = (place[a] + share) * lattice.spacing[a];
      }
      exchanged.push_back({cell, fallen});
      fallen = 0;
    }
  return exchanged;
}

template std::vector<Exchange> let_it_rain(const Setup<PlaneStrain>&, double, double, GridFields<PlaneStrain>&,
                                           std::uint64_t&, WaterPoints<PlaneStrain>&);
template std::vector<Exchange> let_it_rain(const Setup<Solid>&, double, double, GridFields<Solid>&, std::uint64_t&,
                                           WaterPoints<Solid>&);

}  // namespace polder
