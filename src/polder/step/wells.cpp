#include "polder/step/wells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "polder/math/random.hpp"
#include "polder/points/tiles.hpp"
#include "polder/step/soil_exchange.hpp"

namespace polder {

namespace {

constexpr double open_slot = 400;  // how much better a slot conducts than half a cell of its soil
constexpr double least = 1e-9;     // × a nominal point: what is left of one that is taken whole

/// K/γ of the soil in a cell, m³ s/kg: discharge per pressure gradient; 0 where there is no soil.
template <class Space>
double conductivity(const Setup<Space>& setup, const GridFields<Space>& grid, std::ptrdiff_t cell, bool vertical) {
  const double drag = grid.linear_drag[setup.anisotropic && vertical ? 1 : 0][cell];
  return drag > 0 ? setup.lattice.cell_volume(cell) / drag : 0;
}

/// Pa at a cell's centre under the well's head; 0 above it, where the well holds air.
template <class Space>
double level_in(const Setup<Space>& setup, const WellCells& well, double time, std::ptrdiff_t cell) {
  const double height = setup.lattice.axis[Space::up].centre(setup.lattice.place(cell, Space::up));
  return std::max(0.0, setup.water.density * setup.gravity * ((*well.well.head)(time)-height));
}

/// m³/s that a well of a given discharge takes from one of its cells; `length`: of the well in cells with water.
template <class Space>
double discharge_in(const WellCells& well, double time, std::size_t i, double length) {
  return (*well.well.discharge)(time) * (Space::axes == 2 ? well.length[i] / length : well.length[i]);
}

/// m, of a well in the cells that `counts`.
template <class Counts>
double length_in(const WellCells& well, Counts&& counts) {
  double length = 0;
  for (std::size_t i = 0; i < well.cells.size(); ++i)
    if (counts(well.cells[i])) length += well.length[i];
  return length;
}

/// Peaceman (1978, 1983): a well's pressure is that of its cell at r₀ from its axis, with r₀ = 0.14 √(h₁² + h₂²) of the
/// two spacings across it where the soil conducts alike on both.
template <class Space>
double conductance_of(const Lattice<Space>& lattice, double horizontal, double vertical, const WellCells& well,
                      std::size_t i) {
  if (horizontal <= 0) return 0;
  if (Space::axes == 2 && well.line)  // a slot: its cells have its pressure
    return open_slot * horizontal * well.length[i] / lattice.smallest_spacing();
  const std::array<int, 3> place = lattice.places(well.cells[i]);
  double across[2] = {lattice.axis[0].width(place[0]), lattice.axis[1].width(place[1])}, k[2] = {horizontal, vertical};
  if (Space::axes == 3) {
    int number = 0;
    for (int a = 0; a < 3; ++a)
      if (a != (well.along < 0 ? Space::up : well.along) && number < 2) {
        across[number] = lattice.axis[a].width(place[a]);
        k[number++] = a == Space::up ? vertical : horizontal;
      }
  }
  const double r = std::sqrt(k[1] / k[0]), s = std::sqrt(r);
  const double r0 =
      0.28 * std::sqrt(r * across[0] * across[0] + across[1] * across[1] / r) / (s + 1 / s);  // 0.14 √(…) for r = 1
  return 2 * std::numbers::pi * std::sqrt(k[0] * k[1]) * well.length[i] / std::log(r0 / well.well.radius);
}

}  // namespace

template <class Space>
std::vector<WellFlow> well_flows(const Setup<Space>& setup, double time, const GridFields<Space>& grid) {
  const auto& lattice = setup.lattice;
  std::vector<WellFlow> flows;
  for (const WellCells& well : setup.wells) {
    const double length = length_in(well, [&](std::ptrdiff_t cell) { return grid.wet[cell]; });
    for (std::size_t i = 0; i < well.cells.size(); ++i) {
      const std::ptrdiff_t cell = well.cells[i];
      if (!grid.wet[cell]) continue;
      if (well.well.discharge) {
        flows.push_back({cell, 0, 0, discharge_in<Space>(well, time, i, length)});
        continue;
      }
      const double level = level_in(setup, well, time, cell);
      if (well.well.only_takes && grid.pressure[cell] <= level) continue;
      const double conductance = conductance_of(lattice, conductivity(setup, grid, cell, false),
                                                conductivity(setup, grid, cell, true), well, i);
      flows.push_back({cell, conductance, level, 0});
    }
  }
  return flows;
}

template <class Space>
std::vector<PoreExit> well_exits(const Setup<Space>& setup, double time, const GridFields<Space>& grid,
                                 const PoreFields<Space>& pores) {
  constexpr double unbounded = -std::numeric_limits<double>::infinity();
  std::vector<PoreExit> exits;
  const auto saturated = [&](std::ptrdiff_t cell) {
    return pores.active[cell] && pores.host[cell] < 0 && grid.pressure[cell] >= 0;
  };
  const auto conducts = [&](std::ptrdiff_t cell, bool vertical) {
    const double resistance = pores.resistance[vertical ? 1 : 0][cell];
    return resistance > 0 ? pores.relative[cell] / resistance : 0;
  };
  for (const WellCells& well : setup.wells) {
    const double length = length_in(well, saturated);
    for (std::size_t i = 0; i < well.cells.size(); ++i) {
      const std::ptrdiff_t cell = well.cells[i];
      if (well.well.discharge) {
        if (saturated(cell)) exits.push_back(PoreExit::given(cell, discharge_in<Space>(well, time, i, length)));
        continue;
      }
      if (!pores.active[cell] || pores.host[cell] >= 0) continue;
      const double level = level_in(setup, well, time, cell);
      const bool gives = !well.well.only_takes && level > 0;
      const double conductance = conductance_of(setup.lattice, conducts(cell, false), conducts(cell, true), well, i);
      exits.push_back({cell, conductance, level, gives ? unbounded : 0});
    }
  }
  return exits;
}

template <class Space>
std::vector<Exchange> exchange_with_wells(const Setup<Space>& setup, double dt, const std::vector<WellFlow>& flows,
                                          GridFields<Space>& grid, std::uint64_t& next_id, WaterPoints<Space>& water,
                                          bool& sorted) {
  std::vector<Exchange> exchanged;
  if (flows.empty()) return exchanged;
  const auto& lattice = setup.lattice;
  std::map<std::ptrdiff_t, std::vector<std::size_t>> inside;
  for (const WellFlow& flow : flows) inside.try_emplace(flow.cell);
  for (std::size_t p = 0; p < water.size(); ++p) {
    const auto found = inside.find(cell_at(lattice, position_of(water, p)));
    if (found != inside.end()) found->second.push_back(p);
  }
  std::vector<std::uint8_t> leaves(water.size(), 0);
  for (const WellFlow& flow : flows) {
    const double nominal = setup.nominal_point_volume(flow.cell);
    double left = dt * (flow.conductance * (grid.pressure[flow.cell] - flow.level) + flow.rate);
    if (carries_water(setup, grid, flow.cell)) {
      grid.spare[flow.cell] -= left;
      exchanged.push_back({flow.cell, -left});
      continue;
    }
    std::vector<std::size_t>& points = inside.at(flow.cell);
    const auto smaller = [&](std::size_t a, std::size_t b) {
      return std::pair{water.volume[a], water.id[a]} < std::pair{water.volume[b], water.id[b]};
    };
    while (left > 0 && !points.empty()) {
      const auto at = std::min_element(points.begin(), points.end(), smaller);
      const std::size_t p = *at;
      const double taken = left < water.volume[p] - least * nominal ? left : water.volume[p];
      exchanged.push_back({flow.cell, -taken});
      left -= taken;
      water.volume[p] -= taken;
      if (water.volume[p] > 0) break;
      leaves[p] = 1;
      points.erase(at);
    }
    if (left >= 0) continue;
    const double more = -left, pores = grid.cell_porosity[flow.cell];
    const auto at = std::min_element(points.begin(), points.end(), smaller);
    std::size_t p = at == points.end() ? 0 : *at;
    if (at == points.end() || water.volume[p] + more > 1.5 * pores * nominal) {
      p = append_points(water, 1);
      leaves.push_back(0);
      points.push_back(p);
      water.id[p] = next_id++;
      for (int a = 0; a < Space::axes; ++a) {
        const double share = uniform(setup.numerics.seed, water.id[p], static_cast<std::uint64_t>(a));
        water.position[a][p] = lattice.axis[a].at_place(lattice.place(flow.cell, a) + share);
        water.velocity[a][p] =
            0.5 * (grid.water_velocity[a][flow.cell] + grid.water_velocity[a][flow.cell + lattice.stride[a]]);
      }
      sorted = false;
    }
    water.volume[p] += more;
    exchanged.push_back({flow.cell, more});
  }
  if (std::find(leaves.begin(), leaves.end(), 1) != leaves.end()) {
    remove_points(water, leaves);
    sorted = false;
  }
  return exchanged;
}

template std::vector<WellFlow> well_flows(const Setup<PlaneStrain>&, double, const GridFields<PlaneStrain>&);
template std::vector<WellFlow> well_flows(const Setup<Solid>&, double, const GridFields<Solid>&);
template std::vector<PoreExit> well_exits(const Setup<PlaneStrain>&, double, const GridFields<PlaneStrain>&,
                                          const PoreFields<PlaneStrain>&);
template std::vector<PoreExit> well_exits(const Setup<Solid>&, double, const GridFields<Solid>&,
                                          const PoreFields<Solid>&);
template std::vector<Exchange> exchange_with_wells(const Setup<PlaneStrain>&, double, const std::vector<WellFlow>&,
                                                   GridFields<PlaneStrain>&, std::uint64_t&, WaterPoints<PlaneStrain>&,
                                                   bool&);
template std::vector<Exchange> exchange_with_wells(const Setup<Solid>&, double, const std::vector<WellFlow>&,
                                                   GridFields<Solid>&, std::uint64_t&, WaterPoints<Solid>&, bool&);

}  // namespace polder
