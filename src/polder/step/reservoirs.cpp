#include "polder/step/reservoirs.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "polder/math/random.hpp"
#include "polder/points/tiles.hpp"

namespace polder {

namespace {

constexpr double parcel = 0.125;  // × a nominal point: what is added at once, small so that the surface stays calm

/// The cells of a reservoir that stand above each other.
struct Column {
  std::vector<std::array<int, 3>> cells;  // from below
  std::vector<std::size_t> points;
  double target = 0;  // m³ of water below the level
  double stored = 0;  // m³ of water
  double missing() const { return target - stored; }
};

/// In plan.
template <class Space>
std::pair<int, int> place_of(const std::array<int, 3>& cell) {
  return {cell[0], Space::axes == 3 ? cell[1] : 0};
}

/// Of a reservoir, in the order of their places.
template <class Space>
std::vector<Column> columns_of(const Setup<Space>& setup, const Reservoir<Space>& reservoir, double head,
                               const GridFields<Space>& grid) {
  constexpr int up = Space::up;
  const auto& lattice = setup.lattice;
  std::map<std::pair<int, int>, Column> columns;
  for (const auto& cell : reservoir.cells) {
    Column& column = columns[place_of<Space>(cell)];
    column.cells.push_back(cell);
    const double below = std::clamp(lattice.axis[up].place(head) - cell[up], 0.0, 1.0);
    const std::ptrdiff_t index = lattice.index(cell[0], cell[1], cell[2]);
    column.target += below * grid.cell_porosity[index] * lattice.cell_volume(cell) * setup.bodies.open_cell(index);
    column.stored +=
        grid.water_volume[index];  // by boxes: points that cross the edge side by side count little by little
  }
  std::vector<Column> list;
  list.reserve(columns.size());
  for (auto& [place, column] : columns) list.push_back(std::move(column));
  return list;
}

/// The points of water in the columns' cells.
template <class Space>
void find_points(const Lattice<Space>& lattice, const WaterPoints<Space>& water, std::vector<Column>& columns) {
  constexpr int up = Space::up;
  std::map<std::pair<int, int>, Column*> at;
  for (Column& column : columns) at[place_of<Space>(column.cells.front())] = &column;
  const double low = lattice.axis[0].edge(at.begin()->first.first),
               high = lattice.axis[0].edge(at.rbegin()->first.first + 1);
  for (std::size_t p = 0; p < water.size(); ++p) {
    if (water.position[0][p] < low || water.position[0][p] > high) continue;
    const auto cell = cell_of(lattice, position_of(water, p));
    const auto found = at.find(place_of<Space>(cell));
    if (found == at.end()) continue;
    const auto& cells = found->second->cells;
    if (std::any_of(cells.begin(), cells.end(), [&](const auto& c) { return c[up] == cell[up]; }))
      found->second->points.push_back(p);
  }
}

/// The cell of the column in which its surface stands, and the height of the surface, m.
template <class Space>
std::pair<std::array<int, 3>, double> surface_of(const Setup<Space>& setup, const Column& column,
                                                 const GridFields<Space>& grid) {
  double left = column.stored;
  for (const auto& cell : column.cells) {
    const std::ptrdiff_t index = setup.lattice.index(cell[0], cell[1], cell[2]);
    const double pores = grid.cell_porosity[index] * setup.lattice.cell_volume(cell) * setup.bodies.open_cell(index);
    if (left < pores)
      return {cell, setup.lattice.axis[Space::up].at_place(cell[Space::up] + std::max(left, 0.0) / pores)};
    left -= pores;
  }
  return {column.cells.back(), setup.lattice.axis[Space::up].edge(column.cells.back()[Space::up] + 1)};
}

}  // namespace

template <class Space>
std::vector<Exchange> exchange_with_reservoirs(const Setup<Space>& setup, double time, const GridFields<Space>& grid,
                                               std::uint64_t& next_id, WaterPoints<Space>& water) {
  constexpr int up = Space::up;
  std::vector<Exchange> exchanged;
  const auto& lattice = setup.lattice;
  std::vector<std::uint8_t> leaves(water.size(), 0);
  for (const auto& reservoir : setup.reservoirs) {
    auto columns = columns_of(setup, reservoir, reservoir.head(time), grid);
    if (columns.empty()) continue;
    double missing = 0;
    for (const Column& column : columns) missing += column.missing();
    const double size = parcel * setup.nominal_point_volume(columns.front().cells.back());
    while (missing >= 0.5 * size) {
      Column& column = *std::max_element(columns.begin(), columns.end(),
                                         [](const Column& a, const Column& b) { return a.missing() < b.missing(); });
      const auto [cell, surface] = surface_of(setup, column, grid);
      const std::ptrdiff_t index = lattice.index(cell[0], cell[1], cell[2]);
      const std::size_t p = append_points(water, 1);
      water.id[p] = next_id++;
      water.volume[p] = size;
      for (int a = 0; a < Space::axes; ++a) {
        // across the column at a place that the id spreads evenly, just under the surface
        const double share = uniform(setup.numerics.seed, water.id[p], static_cast<std::uint64_t>(a));
        water.position[a][p] = a == up
                                   ? std::max(surface - 0.25 * lattice.axis[up].width(cell[up]) / setup.points_per_axis,
                                              1e-3 * lattice.axis[up].width(0))
                                   : lattice.axis[a].at_place(cell[a] + share);
        water.velocity[a][p] =
            0.5 * (grid.water_velocity[a][index] + grid.water_velocity[a][index + lattice.stride[a]]);
      }
      leaves.push_back(0);
      column.stored += size;
      missing -= size;
      exchanged.push_back({index, size});
    }
    if (-missing < 0.5 * size) continue;  // however small a point is, it stays
    find_points(lattice, water, columns);
    while (true) {
      Column& column = *std::min_element(columns.begin(), columns.end(),
                                         [](const Column& a, const Column& b) { return a.missing() < b.missing(); });
      if (column.points.empty()) break;
      const auto top = std::max_element(column.points.begin(), column.points.end(), [&](std::size_t a, std::size_t b) {
        return std::pair{water.position[up][a], water.id[a]} < std::pair{water.position[up][b], water.id[b]};
      });
      const std::size_t p = *top;
      if (-missing < 0.5 * water.volume[p] + 0.5 * size) break;
      leaves[p] = 1;
      column.points.erase(top);
      column.stored -= water.volume[p];
      missing += water.volume[p];
      exchanged.push_back(
          {lattice.index(column.cells[0][0], column.cells[0][1], column.cells[0][2]), -water.volume[p]});
    }
  }
  if (std::find(leaves.begin(), leaves.end(), 1) != leaves.end()) remove_points(water, leaves);
  return exchanged;
}

template std::vector<Exchange> exchange_with_reservoirs(const Setup<PlaneStrain>&, double,
                                                        const GridFields<PlaneStrain>&, std::uint64_t&,
                                                        WaterPoints<PlaneStrain>&);
template std::vector<Exchange> exchange_with_reservoirs(const Setup<Solid>&, double, const GridFields<Solid>&,
                                                        std::uint64_t&, WaterPoints<Solid>&);

}  // namespace polder
