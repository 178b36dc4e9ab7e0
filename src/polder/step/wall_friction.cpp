#include "polder/step/wall_friction.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "polder/points/tiles.hpp"
#include "polder/step/soil_volume.hpp"

namespace polder {

namespace {

/// Σ V, Σ V σ' on each axis and Σ of the grains' weight (in water less by buoyancy) of the soil points of a cell.
template <class Space>
struct Pressed {
  double volume = 0, weight = 0;
  std::array<double, Space::axes> stress{};
};

}  // namespace

template <class Space>
void rub_along_walls(const Setup<Space>& setup, double dt, const SoilPoints<Space>& soil, GridFields<Space>& grid) {
  const auto& lattice = setup.lattice;
  std::unordered_map<std::ptrdiff_t, Pressed<Space>> beside;
  for (const FrictionFace& f : setup.friction) {
    beside.try_emplace(f.face);
    beside.try_emplace(f.face - lattice.stride[f.axis]);
  }
  for (std::size_t p = 0; p < soil.size(); ++p) {
    const auto place = cell_of(lattice, position_of(soil, p));
    const std::ptrdiff_t cell = lattice.index(place[0], place[1], place[2]);
    if (setup.walls.beside(cell) == nullptr) continue;
    const auto found = beside.find(cell);
    if (found == beside.end()) continue;
    const double volume = bulk_volume(setup, soil, p);
    found->second.volume += volume;
    const double lifted = grid.wet[cell] ? setup.water.density / setup.materials[soil.material[p]].grain_density : 0;
    found->second.weight -= soil.mass[p] * (1 - lifted) * setup.pull(Space::up);
    for (int a = 0; a < Space::axes; ++a) found->second.stress[a] += volume * soil.stress[a][p];
  }
  for (const FrictionFace& f : setup.friction)
    for (const std::ptrdiff_t cell : {f.face - lattice.stride[f.axis], f.face}) {
      const Pressed<Space>& pressed = beside.at(cell);
      if (pressed.volume <= 0) continue;
      double normal = -pressed.stress[f.axis] / pressed.volume;
      if (f.axis == Space::up)  // from the middle of the cell to the wall
        normal += (cell == f.face ? 0.5 : -0.5) * pressed.weight / lattice.face_area(f.axis, f.face);
      normal = std::max(0.0, normal);
      const double impulse =
          0.5 * dt * f.coefficient * normal * lattice.face_area(f.axis, f.face);  // on each of two faces
      for (int t = 0; t < Space::axes; ++t) {
        if (t == f.axis) continue;
        for (const std::ptrdiff_t face : {cell, cell + lattice.stride[t]}) {
          double& v = grid.soil_velocity[t][face];
          if (grid.soil_mass[t][face] > 0)
            v -= std::copysign(std::min(std::abs(v), impulse / grid.soil_mass[t][face]), v);
        }
      }
    }
}

template void rub_along_walls(const Setup<PlaneStrain>&, double, const SoilPoints<PlaneStrain>&,
                              GridFields<PlaneStrain>&);
template void rub_along_walls(const Setup<Solid>&, double, const SoilPoints<Solid>&, GridFields<Solid>&);

}  // namespace polder
