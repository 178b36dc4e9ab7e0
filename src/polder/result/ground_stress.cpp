#include "polder/result/ground_stress.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "polder/step/soil_volume.hpp"

namespace polder {

namespace {

constexpr double lifted_below = 2e3;  // Pa

}  // namespace

template <class Space>
double point_saturation(const Simulation<Space>& run, std::size_t p) {
  const auto& setup = run.state().setup;
  if (!setup.unsaturated) return run.state().soil.saturated[p] ? 1 : 0;
  return saturation(setup.pores[run.state().soil.material[p]].retention,
                    -run.pressure_at(position_of(run.state().soil, p)));
}

template <class Space>
double total_vertical_stress(const Simulation<Space>& run, const std::array<double, 3>& place) {
  constexpr int up = Space::up;
  const auto& state = run.state();
  const auto& soil = state.soil;
  const auto& lattice = state.setup.lattice;
  const auto here = cell_of(lattice, place);
  const double gravity = -state.setup.pull(up);
  std::array<double, 3> h{1, 1, 1};
  for (int a = 0; a < Space::axes; ++a) h[a] = lattice.axis[a].width(here[a]);
  // of the cell, which is what acts on its soil; between the cells' centres heads bend where the soil changes
  const auto cell_pressure = [&](const std::array<double, 3>& x) {
    const auto cell = cell_of(lattice, x);
    return state.grid.pressure[lattice.index(cell[0], cell[1], cell[2])] +
           state.setup.water.density * gravity * (lattice.axis[up].centre(cell[up]) - x[up]);
  };
  double volume = 0, stress = 0;
  for (std::size_t p = 0; p < soil.size(); ++p) {
    const auto x = position_of(run.state().soil, p);
    const double above = x[up] - place[up];
    bool near = above > 0 && above < h[up];
    for (int a = 0; a < Space::axes; ++a) near = near && (a == up || std::abs(x[a] - place[a]) < 1.5 * h[a]);
    if (!near) continue;
    const double v = bulk_volume(state.setup, soil, p), pressure = cell_pressure(x);
    const double wet =
        state.setup.unsaturated ? saturation(state.setup.pores[soil.material[p]].retention, -pressure) : 1;
    const double density = (soil.mass[p] + state.setup.water.density * soil.water[p]) / v;
    volume += v;
    stress += v * (wet * pressure - soil.stress[up][p] + density * gravity * above);
  }
  return volume > 0 ? stress / volume : 0;
}

template <class Space>
double uplift_length(const Simulation<Space>& run, const Point3& from, const Point3& to) {
  constexpr int up = Space::up;
  const auto& soil = run.state().soil;
  const auto& lattice = run.state().setup.lattice;
  const double low = std::min(from[0], to[0]), high = std::max(from[0], to[0]), level = 0.5 * (from[up] + to[up]);
  std::vector<double> volume(static_cast<std::size_t>(lattice.cells[0]), 0.0), stress = volume;
  for (std::size_t p = 0; p < soil.size(); ++p) {
    const double above = soil.reference[up][p] - level;  // the row that lay on the line at the start
    if (above <= 0 || above >= lattice.axis[up].width(lattice.axis[up].nearest_edge(level))) continue;
    const auto column = static_cast<std::size_t>(cell_of(lattice, position_of(soil, p))[0]);
    const double v = bulk_volume(run.state().setup, soil, p);
    volume[column] += v;
    stress[column] -= v * soil.stress[up][p];
  }
  double length = 0;
  for (std::size_t i = 0; i < volume.size(); ++i) {
    const double x = lattice.axis[0].centre(static_cast<int>(i));
    if (x > low && x < high && volume[i] > 0 && stress[i] < lifted_below * volume[i])
      length += lattice.axis[0].width(static_cast<int>(i));
  }
  return length;
}

#define POLDER_GROUND_STRESS(Space)                                                              \
  template double total_vertical_stress(const Simulation<Space>&, const std::array<double, 3>&); \
  template double point_saturation(const Simulation<Space>&, std::size_t);                       \
  template double uplift_length(const Simulation<Space>&, const Point3&, const Point3&);
POLDER_GROUND_STRESS(PlaneStrain)
POLDER_GROUND_STRESS(Solid)
#undef POLDER_GROUND_STRESS

}  // namespace polder
