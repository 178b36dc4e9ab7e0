#include "polder/step/far_field.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "polder/points/tiles.hpp"
#include "polder/step/soil_volume.hpp"
#include "polder/step/unsaturated_step.hpp"

namespace polder {

namespace {

/// Sums over the soil points of a cell.
struct Ground {
  double volume = 0, mass = 0, stiffness = 0, shear = 0;  // m³, kg, Σ V M, Σ V G
};

template <class Space>
std::unordered_map<std::ptrdiff_t, Ground> ground_beside(const Setup<Space>& setup, const std::vector<OpenSide>& sides,
                                                         const SoilPoints<Space>& soil) {
  const auto& lattice = setup.lattice;
  std::unordered_map<std::ptrdiff_t, Ground> ground;
  for (const OpenSide& side : sides)
    over_side(lattice, side, [&](std::ptrdiff_t, std::ptrdiff_t inside, std::ptrdiff_t, const std::array<int, 3>&) {
      ground.try_emplace(inside);
    });
  for (std::size_t p = 0; p < soil.size(); ++p) {
    const auto cell = cell_of(lattice, position_of(soil, p));
    const auto found = ground.find(lattice.index(cell[0], cell[1], cell[2]));
    if (found == ground.end()) continue;
    const SoilMaterial& material = setup.materials[soil.material[p]];
    const double mean = -(soil.stress[0][p] + soil.stress[1][p] + soil.stress[2][p]) / 3;
    const double volume = bulk_volume(setup, soil, p);
    const double modulus = material.law->constrained_modulus(std::max(mean, 0.0));
    found->second.volume += volume;
    found->second.mass += soil.mass[p];
    found->second.stiffness += volume * modulus;
    found->second.shear += volume * modulus * material.shear_share;
  }
  return ground;
}

}  // namespace

template <class Space>
std::vector<OpenSide> far_sides(const Setup<Space>& setup) {
  std::vector<OpenSide> sides;
  for (int a = 0; a < Space::axes; ++a)
    for (int end = 0; end < 2; ++end)
      if (setup.absorbs(a, end)) {
        OpenSide side;
        side.axis = a;
        side.end = end;
        sides.push_back(side);
      }
  return sides;
}

template <class Space>
void know_far_field(const Setup<Space>& setup, const SoilPoints<Space>& soil, double gravity, bool first,
                    GridFields<Space>& grid) {
  const auto& lattice = setup.lattice;
  const auto sides = far_sides(setup);
  const bool still = first && !setup.water_table.empty();  // there was no step yet that computed pressures
  const auto ground = ground_beside(setup, sides, soil);
  const double rho = setup.water.density;
  for (const OpenSide& side : sides)
    over_side(lattice, side,
              [&](std::ptrdiff_t face, std::ptrdiff_t inside, std::ptrdiff_t outside, const std::array<int, 3>& cell) {
                const Ground& g = ground.at(inside);
                const double volume = 0.5 * lattice.cell_volume(inside);
                const double n = std::clamp(grid.cell_porosity[inside], least_porosity, most_porosity);
                const double water = grid.wet[inside] ? n * rho * volume : grid.water_mass[side.axis][face];
                grid.far_force[side.axis][face] = -grid.soil_force[side.axis][face];
                if (side.axis == Space::up)
                  grid.far_force[side.axis][face] += gravity * (grid.soil_mass[side.axis][face] + water);
                const std::array<double, 3> middle = lattice.centre(cell);
                grid.far_pressure[outside] = still
                                                 ? std::max(pressure_at_start(setup, middle[0], middle[Space::up]), 0.0)
                                                 : grid.pressure[inside];
                if (g.volume <= 0) return;
                const double density = (g.mass + (grid.wet[inside] ? n * rho * g.volume : 0)) / g.volume;
                const double pores = grid.wet[inside] ? setup.water.bulk_modulus / n : 0;
                grid.far_impedance[0][outside] = std::sqrt(density * (g.stiffness / g.volume + pores));
                grid.far_impedance[1][outside] = std::sqrt(density * g.shear / g.volume);
              });
  grid.far_is_known = 1;
}

template <class Space>
void know_far_ground(const Setup<Space>& setup, const SoilPoints<Space>& soil, const PoreFields<Space>& pores,
                     const std::function<double(int, std::ptrdiff_t)>& at_rest, GridFields<Space>& grid) {
  const auto sides = far_sides(setup);
  const auto ground = ground_beside(setup, sides, soil);
  for (const OpenSide& side : sides)
    over_side(setup.lattice, side,
              [&](std::ptrdiff_t face, std::ptrdiff_t inside, std::ptrdiff_t outside, const std::array<int, 3>&) {
                grid.far_force[side.axis][face] = -at_rest(side.axis, face);
                const Ground& g = ground.at(inside);
                if (g.volume <= 0 || pores.bulk[inside] <= 0) return;
                const double density =
                    g.mass / g.volume + setup.water.density * pores.water[inside] / pores.bulk[inside];
                const double S = pores.saturation[inside];
                const double water = pores.storage[inside] > 0 ? S * S * pores.bulk[inside] / pores.storage[inside] : 0;
                grid.far_impedance[0][outside] = std::sqrt(density * (g.stiffness / g.volume + water));
                grid.far_impedance[1][outside] = std::sqrt(density * g.shear / g.volume);
              });
  grid.far_is_known = 1;
}

template <class Space>
double far_dashpot(const Setup<Space>& setup, const GridFields<Space>& grid, int c, std::array<int, 3> at) {
  const auto& lattice = setup.lattice;
  const bool joined = setup.soil_box.periodic(c);
  if (joined && at[c] == lattice.cells[c]) at[c] = 0;
  const bool high = at[c] == lattice.cells[c], end = !joined && (high || at[c] == 0);
  at[c] -= high;
  const std::ptrdiff_t cell = lattice.index(at[0], at[1], at[2]);
  double sum = 0;
  for (int a = 0; a < Space::axes; ++a)
    for (const int side : {0, 1}) {
      if (!setup.absorbs(a, side) || at[a] != (side == 0 ? 0 : lattice.cells[a] - 1)) continue;
      if (a == c && side != static_cast<int>(high)) continue;
      if (a == c && !end) continue;
      const std::ptrdiff_t outside = side == 0 ? cell - lattice.stride[a] : cell + lattice.stride[a];
      const double half = a != c && end ? 0.5 : 1;  // of the face, where it lies on another side
      sum += half * grid.far_impedance[a != c][outside] * lattice.face_area(a, cell);
    }
  return sum;
}

template <class Space>
void prepare_far_field(const Setup<Space>& setup, GridFields<Space>& grid) {
  for (const OpenSide& side : far_sides(setup))
    over_side(setup.lattice, side,
              [&](std::ptrdiff_t, std::ptrdiff_t inside, std::ptrdiff_t outside, const std::array<int, 3>&) {
                grid.pressure[outside] = grid.wet[inside] ? grid.far_pressure[outside] : 0;
                grid.fill[outside] = 1 - grid.fill[inside];  // puts what lies beyond on the side, half a cell away
              });
}

template <class Space>
void close_far_field(const Setup<Space>& setup, GridFields<Space>& grid) {
  for (const OpenSide& side : far_sides(setup))
    over_side(setup.lattice, side,
              [&](std::ptrdiff_t face, std::ptrdiff_t, std::ptrdiff_t outside, const std::array<int, 3>&) {
                grid.water_response[side.axis][face] = 0;
                grid.pressure[outside] = 0;
                grid.fill[outside] = 0;
              });
}

template <class Space>
double far_work(const Setup<Space>& setup, const GridFields<Space>& grid, double dt) {
  double work = 0;
  for (const OpenSide& side : far_sides(setup))
    over_side(setup.lattice, side,
              [&](std::ptrdiff_t face, std::ptrdiff_t, std::ptrdiff_t outside, const std::array<int, 3>& cell) {
                const double force = std::abs(grid.far_force[side.axis][face]) +
                                     std::abs(grid.far_pressure[outside]) * setup.lattice.face_area(side.axis, cell);
                work += dt * force * std::abs(grid.soil_velocity[side.axis][face]);
              });
  return work;
}

#define POLDER_FAR_FIELD(Space)                                                                                  \
  template std::vector<OpenSide> far_sides(const Setup<Space>&);                                                 \
  template void know_far_field(const Setup<Space>&, const SoilPoints<Space>&, double, bool, GridFields<Space>&); \
  template void know_far_ground(const Setup<Space>&, const SoilPoints<Space>&, const PoreFields<Space>&,         \
                                const std::function<double(int, std::ptrdiff_t)>&, GridFields<Space>&);          \
  template double far_dashpot(const Setup<Space>&, const GridFields<Space>&, int, std::array<int, 3>);           \
  template void prepare_far_field(const Setup<Space>&, GridFields<Space>&);                                      \
  template void close_far_field(const Setup<Space>&, GridFields<Space>&);                                        \
  template double far_work(const Setup<Space>&, const GridFields<Space>&, double);
POLDER_FAR_FIELD(PlaneStrain)
POLDER_FAR_FIELD(Solid)
#undef POLDER_FAR_FIELD

}  // namespace polder
