#include "polder/step/body_forces.hpp"

namespace polder {

template <class Space>
std::vector<BodyForce> body_forces(const Setup<Space>& setup, double dt, const GridFields<Space>& grid,
                                   const PoreFields<Space>* pores) {
  constexpr int up = Space::up;
  const auto& lattice = setup.lattice;
  const auto& sections = setup.bodies.sections();
  std::vector<BodyForce> forces;
  for (std::size_t s = 0; s < sections.size(); ++s) {
    forces.push_back({sections[s].wall});
    if (s < grid.body_impulse.size())
      for (std::size_t k = 0; k < 2; ++k) forces[s].soil[k] = grid.body_impulse[s][k] / dt;
  }
  for (int k = 0; k < (Space::axes == 3 ? lattice.cells[1] : 1); ++k)
    for (int level = 0; level < lattice.cells[up]; ++level)
      for (int i = 0; i < lattice.cells[0]; ++i) {
        const std::ptrdiff_t cell = Space::axes == 3 ? lattice.index(i, k, level) : lattice.index(i, level);
        if (!(pores ? pores->active[cell] && pores->host[cell] < 0 : grid.wet[cell]) || !setup.bodies.near(cell))
          continue;
        const double filled = pores ? pores->saturation[cell] : 1;
        // ∫ n dA of the bodies' surfaces in the cell, out of them, is that of its open faces, out of the cell
        Point2 area{};
        for (const int a : {0, up})
          area[a != 0] = lattice.face_area(a, cell) *
                         (setup.bodies.open_face(a, cell + lattice.stride[a]) - setup.bodies.open_face(a, cell));
        if (area[0] == 0 && area[1] == 0 && setup.bodies.open_cell(cell) == 1) continue;
        const BodyContact at = setup.bodies.contact({lattice.axis[0].centre(i), lattice.axis[up].centre(level)});
        // ∫ (y − y_c) n_y dA of them by the divergence theorem: p = p_c − γ (y − y_c); likewise along x where gravity
        // leans
        for (const int a : {0, up}) {
          if (setup.pull(a) == 0) continue;
          const double rises =
              0.5 * lattice.cell_volume(cell) *
                  (setup.bodies.open_face(a, cell + lattice.stride[a]) + setup.bodies.open_face(a, cell)) -
              lattice.cell_volume(cell) * setup.bodies.open_cell(cell);
          forces[at.section].water[a != 0] -= filled * setup.water.density * setup.pull(a) * rises;
        }
        for (std::size_t a = 0; a < 2; ++a) {
          forces[at.section].water[a] -= filled * grid.pressure[cell] * area[a];
          forces[at.section].displaced += at.velocity[a] * area[a];
        }
      }
  for (BodyForce& force : forces)
    for (std::size_t k = 0; pores && k < 2; ++k) force.soil[k] -= force.water[k];
  for (std::size_t s = 0; s < forces.size(); ++s)
    for (std::size_t k = 0; k < 2; ++k)
      forces[s].power -= (forces[s].soil[k] + forces[s].water[k]) * sections[s].velocity[k];
  return forces;
}

template std::vector<BodyForce> body_forces(const Setup<PlaneStrain>&, double, const GridFields<PlaneStrain>&,
                                            const PoreFields<PlaneStrain>*);
template std::vector<BodyForce> body_forces(const Setup<Solid>&, double, const GridFields<Solid>&,
                                            const PoreFields<Solid>*);

}  // namespace polder
