#include "polder/result/excess_pressure.hpp"

#include <algorithm>

namespace polder {

template <class Space>
double excess_pressure(const Simulation<Space>& run, const std::array<double, 3>& x) {
  constexpr int up = Space::up;
  const auto& state = run.state();
  const auto& grid = state.grid;
  const auto& lattice = state.setup.lattice;
  const double weight = state.setup.water.density * state.setup.gravity, h = lattice.spacing[up];
  const auto place = cell_of(lattice, x);
  std::ptrdiff_t cell = lattice.index(place[0], place[1], place[2]);
  const std::ptrdiff_t above = lattice.stride[up];
  int level = place[up];
  const auto climb = [&](auto holds) {
    while (level + 1 < lattice.cells[up] && holds(cell + above)) cell += above, ++level;
  };
  if (state.unsaturated) {
    const auto& pores = state.unsaturated->pores;
    const double pressure = run.pressure_at(x);
    if (pressure <= 0) return 0;
    climb([&](std::ptrdiff_t c) { return pores.active[c] && pores.bulk[c] > 0 && grid.pressure[c] > 0; });
    const double top = (level + 0.5) * h + grid.pressure[cell] / weight;
    return pressure - weight * std::max(0.0, top - x[up]);
  }
  if (!grid.wet[cell]) return run.pressure_at(x);
  climb([&](std::ptrdiff_t c) { return grid.wet[c] != 0; });
  const double over = level + 1 < lattice.cells[up] ? std::min(0.5, grid.fill[cell + above]) : 0;
  const double top = (level + std::min(1.5, std::min(1.0, grid.fill[cell]) + over)) * h;
  // a cell has one pressure, that of its middle
  return run.pressure_at(x) - weight * std::max(0.0, top - (place[up] + 0.5) * h);
}

template double excess_pressure(const Simulation<PlaneStrain>&, const std::array<double, 3>&);
template double excess_pressure(const Simulation<Solid>&, const std::array<double, 3>&);

}  // namespace polder
