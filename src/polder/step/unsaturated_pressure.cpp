// Pore pressure between the cells' centres.
#include <algorithm>
#include <cmath>
#include <utility>

#include "polder/step/unsaturated_step.hpp"

namespace polder {

template <class Space>
double UnsaturatedStep<Space>::pressure_at(const Setup<Space>& setup, const GridFields<Space>& grid,
                                           const std::array<double, 3>& x) const {
  constexpr int up = Space::up;
  const auto& lattice = setup.lattice;
  const double weight = -setup.water.density * setup.pull(up);
  const auto own = cell_of(lattice, x);
  const std::ptrdiff_t own_cell = lattice.index(own[0], own[1], own[2]);
  const WallStencil<Space>* stencil = setup.walls.beside(own_cell);
  const auto seen = [&](std::ptrdiff_t cell) {  // on the same side of thin walls
    return stencil == nullptr || std::find(stencil->cell.begin(), stencil->cell.end(),
                                           static_cast<std::int32_t>(cell - own_cell)) != stencil->cell.end();
  };
  std::array<int, 3> low{0, 0, 0};
  std::array<double, 3> over{0, 0, 0};  // of the centre of that cell, cells
  for (int a = 0; a < Space::axes; ++a) {
    const GridAxis& axis = lattice.axis[a];
    if (axis.graded()) {
      low[a] = x[a] < axis.centre(own[a]) ? own[a] - 1 : own[a];
      over[a] = (x[a] - axis.centre(low[a])) / axis.gap(low[a] + 1);
      continue;
    }
    const double place = x[a] / lattice.spacing[a] - 0.5;
    low[a] = static_cast<int>(std::floor(place));
    over[a] = place - low[a];
  }
  double sum = 0, shares = 0;
  for (int corner = 0; corner < (1 << up); ++corner) {  // columns of cells around
    std::array<int, 3> cell = low;
    double share = 1;
    for (int a = 0; a < up; ++a) {
      const int high = corner >> a & 1;
      const int n = lattice.cells[a], at = low[a] + high;
      cell[a] = setup.soil_box.periodic(a) ? (at + n) % n : std::clamp(at, 0, n - 1);
      share *= high ? over[a] : 1 - over[a];
    }
    const auto at = [&](int level) {
      std::array<int, 3> place = cell;
      place[up] = std::clamp(level, 0, lattice.cells[up] - 1);
      return lattice.index(place[0], place[1], place[2]);
    };
    const auto head = [&](std::ptrdiff_t c) {
      return grid.pressure[c] + weight * lattice.axis[up].centre(lattice.place(c, up));
    };
    const std::ptrdiff_t lower = at(low[up]), upper = at(low[up] + 1);
    double of_upper = over[up];
    if (pores.active[lower] && pores.active[upper]) {  // the head is lost where it is hard to flow
      const double a = pores.resistance[1][lower], b = pores.resistance[1][upper];
      const double edge = 0.5 * lattice.axis[up].width(low[up]) / lattice.axis[up].gap(low[up] + 1);  // between the two
      if (a + b > 0)
        of_upper = (std::min(of_upper, edge) * a + std::max(of_upper - edge, 0.0) * b) / (edge * a + (1 - edge) * b);
    }
    for (const auto& [c, part] : {std::pair{lower, share * (1 - of_upper)}, std::pair{upper, share * of_upper}}) {
      if (!pores.active[c] || !seen(c)) continue;
      sum += part * (head(c) - weight * x[up]);
      shares += part;
    }
  }
  return shares > 0 ? sum / shares : 0;
}

template double UnsaturatedStep<PlaneStrain>::pressure_at(const Setup<PlaneStrain>&, const GridFields<PlaneStrain>&,
                                                          const std::array<double, 3>&) const;
template double UnsaturatedStep<Solid>::pressure_at(const Setup<Solid>&, const GridFields<Solid>&,
                                                    const std::array<double, 3>&) const;

}  // namespace polder
