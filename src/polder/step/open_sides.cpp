#include "polder/step/open_sides.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "polder/math/units.hpp"
#include "polder/points/tiles.hpp"
#include "polder/step/soil_exchange.hpp"

namespace polder {

namespace {

/// A layer of points along the inside of a side: ppa^(axes − 1) of them in one cell.
template <class Space>
void add_layer(const Setup<Space>& setup, const GridFields<Space>& grid, const OpenSide& side, std::ptrdiff_t face,
               const std::array<int, 3>& cell, double each, std::uint64_t& next_id, WaterPoints<Space>& water) {
  const auto& lattice = setup.lattice;
  const int ppa = setup.points_per_axis;
  std::array<int, 3> count{1, 1, 1};
  for (int a = 0; a < Space::axes; ++a) count[a] = a == side.axis ? 1 : ppa;
  for (int k = 0; k < count[2]; ++k)
    for (int j = 0; j < count[1]; ++j)
      for (int i = 0; i < count[0]; ++i) {
        const int at[3] = {i, j, k};
        const std::size_t p = append_points(water, 1);
        water.id[p] = next_id++;
        water.volume[p] = each;
        for (int a = 0; a < Space::axes; ++a) {
          const double share = a != side.axis ? (at[a] + 0.5) / ppa : side.end == 0 ? 0.5 / ppa : 1 - 0.5 / ppa;
          water.position[a][p] = lattice.axis[a].at_place(cell[a] + share);
        }
        water.velocity[side.axis][p] = grid.water_velocity[side.axis][face];
      }
}

/// Where a given discharge is to leave and fewer points have crossed the side than that, the outermost in its cells go,
/// too: what is left owed is less than a point.
template <class Space>
void take_what_is_owed(const Setup<Space>& setup, GridFields<Space>& grid, const OpenSide& side,
                       WaterPoints<Space>& water, std::vector<Exchange>& exchanged) {
  const auto& lattice = setup.lattice;
  std::map<std::ptrdiff_t, std::vector<std::size_t>> due;  // points by the cell inside
  over_side(lattice, side,
            [&](std::ptrdiff_t, std::ptrdiff_t inside, std::ptrdiff_t outside, const std::array<int, 3>& cell) {
              if (grid.owed[outside] < -setup.nominal_point_volume(cell)) due.try_emplace(inside);
            });
  if (due.empty()) return;
  for (std::size_t p = 0; p < water.size(); ++p) {
    const auto found = due.find(cell_at(lattice, position_of(water, p)));
    if (found != due.end()) found->second.push_back(p);
  }
  std::vector<std::uint8_t> leaves(water.size(), 0);
  for (auto& [inside, points] : due) {
    double& owed = grid.owed[inside + (side.end == 0 ? -1 : 1) * lattice.stride[side.axis]];
    std::sort(points.begin(), points.end(), [&](std::size_t a, std::size_t b) {
      const Array& x = water.position[side.axis];
      return std::pair{side.outward() * x[b], water.id[b]} < std::pair{side.outward() * x[a], water.id[a]};
    });
    for (const std::size_t p : points) {
      if (owed > -water.volume[p]) break;
      owed += water.volume[p];
      exchanged.push_back({inside, -water.volume[p]});
      leaves[p] = 1;
    }
  }
  if (std::find(leaves.begin(), leaves.end(), 1) != leaves.end()) remove_points(water, leaves);
}

}  // namespace

template <class Space>
void prepare_open_sides(const Setup<Space>& setup, double time, GridFields<Space>& grid) {
  const auto& lattice = setup.lattice;
  const double gamma = setup.water.density * (setup.gravity > 0 ? setup.gravity : standard_gravity);
  for (const OpenSide& side : setup.open_sides) {
    if (!side.prescribes_head) continue;
    const double head = side.value(time);
    over_side(lattice, side,
              [&](std::ptrdiff_t face, std::ptrdiff_t inside, std::ptrdiff_t outside, const std::array<int, 3>& cell) {
                const double height = side.axis == Space::up ? (side.end == 0 ? 0 : lattice.length(Space::up))
                                                             : lattice.axis[Space::up].centre(cell[Space::up]);
                // the head is that of the water before it has gained speed
                const double mass = grid.water_mass[side.axis][face];
                const double in =
                    mass > 0 ? std::max(0.0, -side.outward() * grid.water_velocity[side.axis][face] / mass) : 0;
                grid.pressure[outside] = std::max(0.0, gamma * (head - height) - 0.5 * setup.water.density * in * in);
                if (head > height) grid.wet[inside] = 1;
                grid.fill[outside] = 1 - grid.fill[inside];  // puts the surface on the side, half a cell away
              });
  }
}

template <class Space>
void close_seepage_faces(const Setup<Space>& setup, GridFields<Space>& grid) {
  for (const OpenSide& side : setup.open_sides) {
    if (!side.prescribes_head) continue;
    over_side(setup.lattice, side,
              [&](std::ptrdiff_t face, std::ptrdiff_t inside, std::ptrdiff_t outside, const std::array<int, 3>&) {
                if (grid.pressure[outside] > 0 || grid.pressure[inside] > 0) return;
                if (side.outward() * grid.water_velocity[side.axis][face] > 0) return;  // it is on its way out
                grid.mobility[side.axis][face] = grid.water_response[side.axis][face] = 0;
                grid.water_velocity[side.axis][face] = 0;
              });
  }
}

template <class Space>
std::vector<Exchange> exchange_through_sides(const Setup<Space>& setup, double dt, GridFields<Space>& grid,
                                             std::uint64_t& next_id, WaterPoints<Space>& water) {
  std::vector<Exchange> exchanged;
  const auto& lattice = setup.lattice;
  std::vector<std::uint8_t> leaves(water.size(), 0);
  bool any = false;
  for (std::size_t p = 0; p < water.size(); ++p)
    for (const OpenSide& side : setup.open_sides) {
      const double x = water.position[side.axis][p];
      if (leaves[p] || (side.end == 0 ? x >= 0 : x <= lattice.length(side.axis))) continue;
      std::array<double, 3> at{0, 0, 0};
      for (int a = 0; a < Space::axes; ++a) at[a] = water.position[a][p];
      const auto cell = cell_of(lattice, at);
      const std::ptrdiff_t inside = lattice.index(cell[0], cell[1], cell[2]);
      if (!side.only_out) grid.owed[inside + (side.end == 0 ? -1 : 1) * lattice.stride[side.axis]] += water.volume[p];
      exchanged.push_back({inside, -water.volume[p]});
      leaves[p] = 1;
      any = true;
    }
  if (any) remove_points(water, leaves);
  for (const OpenSide& side : setup.open_sides) {
    over_side(lattice, side,
              [&](std::ptrdiff_t face, std::ptrdiff_t inside, std::ptrdiff_t outside, const std::array<int, 3>& cell) {
                const double entered = -side.outward() * grid.porosity[side.axis][face] *
                                       grid.water_velocity[side.axis][face] * lattice.face_area(side.axis, cell) * dt;
                if (carries_water(setup, grid, inside)) {  // without points
                  grid.spare[inside] += entered;
                  exchanged.push_back({inside, entered});
                  return;
                }
                if (side.only_out) return;
                double& owed = grid.owed[outside];
                owed += entered;
                const double each = grid.cell_porosity[inside] * setup.nominal_point_volume(cell);
                const double layer = each * std::pow(setup.points_per_axis, Space::axes - 1);
                while (owed >= layer) {
                  add_layer(setup, grid, side, face, cell, each, next_id, water);
                  owed -= layer;
                  exchanged.push_back({inside, layer});
                }
              });
    if (!side.prescribes_head && !side.only_out) take_what_is_owed(setup, grid, side, water, exchanged);
  }
  return exchanged;
}

template void prepare_open_sides(const Setup<PlaneStrain>&, double, GridFields<PlaneStrain>&);
template void prepare_open_sides(const Setup<Solid>&, double, GridFields<Solid>&);
template void close_seepage_faces(const Setup<PlaneStrain>&, GridFields<PlaneStrain>&);
template void close_seepage_faces(const Setup<Solid>&, GridFields<Solid>&);
template std::vector<Exchange> exchange_through_sides(const Setup<PlaneStrain>&, double, GridFields<PlaneStrain>&,
                                                      std::uint64_t&, WaterPoints<PlaneStrain>&);
template std::vector<Exchange> exchange_through_sides(const Setup<Solid>&, double, GridFields<Solid>&, std::uint64_t&,
                                                      WaterPoints<Solid>&);

}  // namespace polder
