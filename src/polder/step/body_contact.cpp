#include "polder/step/body_contact.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "polder/step/face_loop.hpp"

namespace polder {

namespace {

/// Of a body's surface, some cells wide: section, place.
using Patch = std::pair<std::size_t, std::array<int, 3>>;

/// A face at a body's surface and how it meets the body.
struct Met {
  int axis;
  std::ptrdiff_t face;
  double velocity;      ///< m/s, then
  BodyContact at;       ///< x, height
  double into;          ///< m/s relative to the body, along its normal: below 0
  double along, speed;  ///< along its surface, m/s: by component and size
  Patch patch;
  double by_water = 0;  ///< what of `into` the pore water pressed
};

constexpr int patch_cells = 4;
constexpr double sticks = 1e6;  // friction from which on soil sticks to a body

/// Of a velocity field: the faces in bodies that would go further in. Along the surface they slide; soil that `sticks`
/// to a body stays. `by_water`, where given: what of the velocity the pore water's pressure is to.
template <class Space>
std::vector<Met> met_faces(const Setup<Space>& setup, const FaceField<Space>& velocity, bool of_soil,
                           const std::function<bool(int, std::ptrdiff_t)>& only,
                           const std::function<double(int, std::ptrdiff_t)>& by_water) {
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
          const auto there = [&](auto&& along) {  // x, height: of what along(axis, face) has on the faces
            std::array<double, 2> v{};
            v[c != 0] = along(c, f);
            for (const std::ptrdiff_t n : {f - s, f, f - s + t, f + t}) v[c == 0] += 0.25 * along(other, n);
            return v;
          };
          std::array<double, 2> v = there([&](int a, std::ptrdiff_t n) { return velocity[a][n]; });
          for (int a = 0; a < 2; ++a) v[a] -= at.velocity[a];
          const double into = v[0] * at.normal[0] + v[1] * at.normal[1];
          if (into >= 0) continue;
          for (int a = 0; a < 2; ++a) v[a] -= into * at.normal[a];
          const double along = of_soil && at.friction > sticks ? 0 : v[c != 0];
          const Patch patch{at.section, {i / patch_cells, k / patch_cells, level / patch_cells}};
          Met m{c, f, along + at.velocity[c != 0], at, into, along, std::hypot(v[0], v[1]), patch};
          if (by_water) {
            const std::array<double, 2> pushed = there(by_water);
            m.by_water = pushed[0] * at.normal[0] + pushed[1] * at.normal[1];
          }
          met.push_back(m);
        }
  }
  return met;
}

/// What friction may take at each face, N s: tan δ times the momentum across the surface that the body took from the
/// soil there; with `by_water` without the pore water's part of what pressed on the face's patch: face by face, water
/// and grains press by other splines.
template <class Space>
std::vector<double> friction_impulses(const std::vector<Met>& met, const FaceField<Space>& mass, bool by_water) {
  const auto weight = [&](const Met& m) {
    const double n = m.at.normal[m.axis != 0];
    return mass[m.axis][m.face] * n * n;
  };
  std::map<Patch, std::array<double, 2>> patches;  // all, water
  for (const Met& m : met) {
    auto& patch = patches[m.patch];
    patch[0] += weight(m) * m.into;
    patch[1] += weight(m) * m.by_water;
  }
  std::vector<double> impulses;
  for (const Met& m : met) {
    const auto& [all, water] = patches[m.patch];
    const double grains = by_water && all < 0 ? std::clamp(1 - water / all, 0.0, 1.0) : 1;
    impulses.push_back(m.at.friction > sticks ? 0 : -m.at.friction * weight(m) * m.into * grains);
  }
  return impulses;
}

/// Takes from the faces that were met as much of their motion along the surface as their own friction stops, or what
/// `impulses` have for the patch; these are left with the rest.
template <class Space>
void rub_inside(const FaceField<Space>& mass, std::vector<Met>& met, std::vector<double>& impulses) {
  std::map<Patch, std::array<double, 2>> patches;  // there is, wanted
  const auto wanted = [&](const Met& m) {
    const double stopped = m.speed > 0 ? std::min(m.speed, -m.at.friction * m.into) : 0;
    return m.speed > 0 ? mass[m.axis][m.face] * stopped * m.along * m.along / (m.speed * m.speed) : 0;
  };
  for (std::size_t i = 0; i < met.size(); ++i) {
    auto& patch = patches[met[i].patch];
    patch[0] += impulses[i];
    if (met[i].at.friction <= sticks) patch[1] += wanted(met[i]);
  }
  for (std::size_t i = 0; i < met.size(); ++i) {
    Met& m = met[i];
    if (!(m.speed > 0) || m.at.friction > sticks) continue;
    const auto& [has, wants] = patches[m.patch];
    const double share = wants > has ? has / wants : 1;
    m.velocity -= share * std::min(1.0, -m.at.friction * m.into / m.speed) * m.along;
    impulses[i] *= has > wants ? 1 - wants / has : 0;
  }
}

/// What friction may take from the momentum of a face, and from its velocity at most.
struct Rub {
  int axis;
  std::ptrdiff_t face;
  double impulse, most;  ///< N s, m/s; signed
  std::size_t section;
};

/// Friction on the soil outside the surface: in the cell before a face that was met, against the motion along it, at
/// most to rest.
template <class Space>
void rub_outside(const Setup<Space>& setup, const std::vector<Met>& met, const std::vector<double>& impulses,
                 GridFields<Space>& grid) {
  constexpr int up = Space::up;
  const auto& lattice = setup.lattice;
  std::vector<Rub> rubs;
  for (std::size_t i = 0; i < met.size(); ++i) {
    const Met& m = met[i];
    if (!(impulses[i] > 0)) continue;
    const std::ptrdiff_t out = m.at.normal[m.axis != 0] > 0 ? 0 : -lattice.stride[m.axis];
    const std::ptrdiff_t cell = setup.bodies.open_neighbour(m.face + out);
    constexpr auto axes = static_cast<std::size_t>(Space::axes);
    std::array<double, axes> v{}, mass{}, n{};
    v[0] = -m.at.velocity[0], v[up] = -m.at.velocity[1];
    n[0] = m.at.normal[0], n[up] = m.at.normal[1];
    double across = 0, square = 0;
    for (std::size_t a = 0; a < axes; ++a) {
      for (const std::ptrdiff_t f : {cell, cell + lattice.stride[a]}) {
        mass[a] += grid.soil_mass[a][f];
        v[a] += 0.5 * grid.soil_velocity[a][f];
      }
      across += v[a] * n[a];
    }
    for (std::size_t a = 0; a < axes; ++a) {
      v[a] -= across * n[a];
      square += v[a] * v[a];
    }
    if (!(square > 0)) continue;
    const double speed = std::sqrt(square);
    for (int a = 0; a < Space::axes; ++a)
      for (const std::ptrdiff_t f : {cell, cell + lattice.stride[a]})
        if (grid.soil_mass[a][f] > 0)
          rubs.push_back({a, f, impulses[i] * v[a] / speed * grid.soil_mass[a][f] / mass[a], v[a], m.at.section});
  }
  std::stable_sort(rubs.begin(), rubs.end(), [](const Rub& a, const Rub& b) {
    return std::pair{a.axis, a.face} < std::pair{b.axis, b.face};
  });
  for (std::size_t i = 0; i < rubs.size();) {
    const Rub& first = rubs[i];
    double impulse = 0, least = 0, most = 0;
    for (; i < rubs.size() && rubs[i].axis == first.axis && rubs[i].face == first.face; ++i) {
      impulse += rubs[i].impulse;
      least = std::min(least, rubs[i].most);
      most = std::max(most, rubs[i].most);
    }
    const double mass = grid.soil_mass[first.axis][first.face], taken = std::clamp(impulse / mass, least, most);
    grid.soil_velocity[first.axis][first.face] -= taken;
    if (first.section < grid.body_impulse.size() && (first.axis == 0 || first.axis == up))
      grid.body_impulse[first.section][first.axis != 0] += mass * taken;
  }
}

}  // namespace

template <class Space>
void meet_bodies(const Setup<Space>& setup, GridFields<Space>& grid,
                 const std::function<bool(int, std::ptrdiff_t)>& only,
                 const std::function<double(int, std::ptrdiff_t)>& by_water) {
  std::vector<Met> met = met_faces(setup, grid.soil_velocity, true, only, by_water);
  std::vector<double> friction;
  if (!only) {
    friction = friction_impulses<Space>(met, grid.soil_mass, static_cast<bool>(by_water));
    rub_inside<Space>(grid.soil_mass, met, friction);
  }
  for (const Met& m : met) {
    double& v = grid.soil_velocity[m.axis][m.face];
    if (m.at.section < grid.body_impulse.size())
      grid.body_impulse[m.at.section][m.axis != 0] += grid.soil_mass[m.axis][m.face] * (v - m.velocity);
    v = m.velocity;
    grid.soil_response[m.axis][m.face] = 0;
  }
  if (!only) rub_outside(setup, met, friction, grid);
}

template <class Space>
void water_meets_bodies(const Setup<Space>& setup, GridFields<Space>& grid) {
  for (const Met& m : met_faces(setup, grid.water_velocity, false, {}, {}))
    grid.water_velocity[m.axis][m.face] = m.velocity;
}

template void meet_bodies(const Setup<PlaneStrain>&, GridFields<PlaneStrain>&,
                          const std::function<bool(int, std::ptrdiff_t)>&,
                          const std::function<double(int, std::ptrdiff_t)>&);
template void meet_bodies(const Setup<Solid>&, GridFields<Solid>&, const std::function<bool(int, std::ptrdiff_t)>&,
                          const std::function<double(int, std::ptrdiff_t)>&);
template void water_meets_bodies(const Setup<PlaneStrain>&, GridFields<PlaneStrain>&);
template void water_meets_bodies(const Setup<Solid>&, GridFields<Solid>&);

}  // namespace polder
