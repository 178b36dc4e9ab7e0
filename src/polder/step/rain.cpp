#include "polder/step/rain.hpp"

#include <algorithm>
#include <map>

#include "polder/math/random.hpp"
#include "polder/points/tiles.hpp"

namespace polder {

namespace {

/// m/s on a column whose middle is at x, mean over its width.
double rate_on(const Rain& rain, double time, double x, double width) {
  if (!rain.span) return rain.rate(time);
  const double covered = std::min(x + 0.5 * width, (*rain.span)[1]) - std::max(x - 0.5 * width, (*rain.span)[0]);
  return rain.rate(time) * std::max(0.0, covered) / width;
}

constexpr double parcel = 0.125;  // × a nominal point
constexpr double a_little = 0.1;  // of a cell, of soil or water: rain falls on it and not through it
constexpr double least = 1e-3;    // × a nominal point: what is smaller evaporates whole

/// Columns of cells from which water is due, by their lowest cell, and the water points in them.
using Dues = std::map<std::ptrdiff_t, std::vector<std::size_t>>;

/// Whether the water of a column is open to the air: free, or in soil up to the soil's uppermost cell.
template <class Space>
bool open_to_air(const Setup<Space>& setup, const GridFields<Space>& grid, std::ptrdiff_t base) {
  const auto& lattice = setup.lattice;
  for (int level = lattice.cells[Space::up] - 1; level >= 0; --level) {
    const std::ptrdiff_t cell = base + level * lattice.stride[Space::up];
    if (grid.wet[cell]) return true;
    if (grid.solid_volume[cell] > 0.5 * (1 - grid.cell_porosity[cell]) * lattice.cell_volume(cell)) return false;
  }
  return false;
}

/// Takes what is due out of each column, the uppermost points first. What finds no open water is forgotten: the air is
/// as dry as it was.
template <class Space>
void evaporate(const Setup<Space>& setup, Dues& dues, GridFields<Space>& grid, WaterPoints<Space>& water,
               std::vector<Exchange>& exchanged) {
  constexpr int up = Space::up;
  const auto& lattice = setup.lattice;
  const auto cell_at = [&](std::size_t p) { return cell_of(lattice, position_of(water, p)); };
  for (std::size_t p = 0; p < water.size(); ++p) {
    const auto cell = cell_at(p);
    const auto due = dues.find(Space::axes == 3 ? lattice.index(cell[0], cell[1], 0) : lattice.index(cell[0], 0));
    if (due != dues.end()) due->second.push_back(p);
  }
  std::vector<std::uint8_t> leaves(water.size(), 0);
  for (auto& [base, points] : dues) {
    double left = -grid.rain[base];
    grid.rain[base] = 0;
    if (!open_to_air(setup, grid, base)) continue;
    std::sort(points.begin(), points.end(), [&](std::size_t a, std::size_t b) {
      return std::pair{water.position[up][b], water.id[b]} < std::pair{water.position[up][a], water.id[a]};
    });
    for (const std::size_t p : points) {
      const auto cell = cell_at(p);
      const bool whole = left > water.volume[p] - least * setup.nominal_point_volume(cell);
      const double taken = whole ? water.volume[p] : left;
      exchanged.push_back({lattice.index(cell[0], cell[1], cell[2]), -taken});
      water.volume[p] -= taken;
      leaves[p] = whole;
      left -= taken;
      if (left <= 0) break;
    }
    grid.rain[base] = std::max(0.0, -left);  // the last point may have been more than was due
  }
  if (std::find(leaves.begin(), leaves.end(), 1) != leaves.end()) remove_points(water, leaves);
}

}  // namespace

template <class Space>
double rain_on(const Setup<Space>& setup, double time, int i) {
  const auto& x = setup.lattice.axis[0];
  double rate = 0;
  for (const Rain& rain : setup.rains) rate += rate_on(rain, time, x.centre(i), x.width(i));
  return rate;
}

template <class Space>
std::vector<Exchange> let_it_rain(const Setup<Space>& setup, double time, double dt, GridFields<Space>& grid,
                                  std::uint64_t& next_id, WaterPoints<Space>& water) {
  constexpr int up = Space::up;
  const auto& lattice = setup.lattice;
  std::vector<Exchange> exchanged;
  Dues dues;
  for (int k = 0; k < (Space::axes == 3 ? lattice.cells[1] : 1); ++k)
    for (int i = 0; i < lattice.cells[0]; ++i) {
      const std::ptrdiff_t base = Space::axes == 3 ? lattice.index(i, k, 0) : lattice.index(i, 0);
      const double rate = rain_on(setup, time, i);
      double& fallen = grid.rain[base];
      fallen += rate * dt * lattice.face_area(up, base);
      const double size = parcel * setup.nominal_point_volume(base);
      if (fallen <= -size) dues.try_emplace(base);
      if (fallen < size) continue;
      int top = -1;  // the uppermost cell with something in it
      for (int level = lattice.cells[up] - 1; level >= 0 && top < 0; --level) {
        const std::ptrdiff_t cell = base + level * lattice.stride[up];
        const double volume = lattice.cell_volume(cell);
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
        water.position[a][p] = lattice.axis[a].at_place(place[a] + share);
      }
      exchanged.push_back({cell, fallen});
      fallen = 0;
    }
  if (!dues.empty()) evaporate(setup, dues, grid, water, exchanged);
  return exchanged;
}

template double rain_on(const Setup<PlaneStrain>&, double, int);
template double rain_on(const Setup<Solid>&, double, int);
template std::vector<Exchange> let_it_rain(const Setup<PlaneStrain>&, double, double, GridFields<PlaneStrain>&,
                                           std::uint64_t&, WaterPoints<PlaneStrain>&);
template std::vector<Exchange> let_it_rain(const Setup<Solid>&, double, double, GridFields<Solid>&, std::uint64_t&,
                                           WaterPoints<Solid>&);

}  // namespace polder
