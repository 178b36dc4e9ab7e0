#include "polder/step/body_contact.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "polder/step/face_loop.hpp"

namespace polder {

namespace {

/// A face at a body's surface and the velocity that it has after meeting the body.
struct Met {
  int axis;
  std::ptrdiff_t face;
  double velocity;
  std::size_t section;
};

/// Of a velocity field: the faces in bodies that would go further in. `rubs`: friction takes of the motion along the
/// surface what the part that was stopped allows.
template <class Space>
std::vector<Met> met_faces(const Setup<Space>& setup, const FaceField<Space>& velocity, bool rubs,
                           const std::function<bool(int, std::ptrdiff_t)>& only) {
  constexpr int up = Space::up;
  const auto& lattice = setup.lattice;
  std::vector<Met> met;
  for (const int c : {0, up}) {
    const int other = c == 0 ? up : 0;
    const std::ptrdiff_t s = lattice.stride[c], t = lattice.stride[other];
    for (int k = 0; k < (Space::axes == 3 ? lattice.cells[1] : 1); ++k)
      for (int level = 0; level < lattice.cells[up]; ++level)
        for (int i = 0; i < lattice.cells[0]; ++i) {
          const std::ptrdiff_t f = Space::axes == 3 ? lattice.index(i, k, level) : lattice.index(i, level);
          if (!setup.bodies.inside(c, f) || (only && !only(c, f))) continue;
          const BodyContact at =
              setup.bodies.contact({c == 0 ? lattice.axis[0].edge(i) : lattice.axis[0].centre(i),
                                    c == 0 ? lattice.axis[up].centre(level) : lattice.axis[up].edge(level)});
          double v[2];  // x, height; relative to the body
          v[c != 0] = velocity[c][f] - at.velocity[c != 0];
          v[c == 0] = -at.velocity[c == 0];
          for (const std::ptrdiff_t n : {f - s, f, f - s + t, f + t}) v[c == 0] += 0.25 * velocity[other][n];
          const double into = v[0] * at.normal[0] + v[1] * at.normal[1];
          if (into >= 0) continue;
          const double along[2] = {v[0] - into * at.normal[0], v[1] - into * at.normal[1]};
          const double speed = std::hypot(along[0], along[1]);
          const double kept = !rubs ? 1 : speed > 0 ? std::max(0.0, 1 + at.friction * into / speed) : 0;
          met.push_back({c, f, kept * along[c != 0] + at.velocity[c != 0], at.section});
        }
  }
  return met;
}

}  // namespace

template <class Space>
void meet_bodies(const Setup<Space>& setup, GridFields<Space>& grid,
                 const std::function<bool(int, std::ptrdiff_t)>& only) {
  for (const Met& m : met_faces(setup, grid.soil_velocity, true, only)) {
    double& v = grid.soil_velocity[m.axis][m.face];
    if (m.section < grid.body_impulse.size())
      grid.body_impulse[m.section][m.axis != 0] += grid.soil_mass[m.axis][m.face] * (v - m.velocity);
    v = m.velocity;
    grid.soil_response[m.axis][m.face] = 0;
  }
}

template <class Space>
void water_meets_bodies(const Setup<Space>& setup, GridFields<Space>& grid) {
  for (const Met& m : met_faces(setup, grid.water_velocity, false, {}))
    grid.water_velocity[m.axis][m.face] = m.velocity;
}

template void meet_bodies(const Setup<PlaneStrain>&, GridFields<PlaneStrain>&,
                          const std::function<bool(int, std::ptrdiff_t)>&);
template void meet_bodies(const Setup<Solid>&, GridFields<Solid>&, const std::function<bool(int, std::ptrdiff_t)>&);
template void water_meets_bodies(const Setup<PlaneStrain>&, GridFields<PlaneStrain>&);
template void water_meets_bodies(const Setup<Solid>&, GridFields<Solid>&);

}  // namespace polder
