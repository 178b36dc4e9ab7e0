#pragma once
// Everything that lives on the grid during a step. Names follow docs/theory.md; per phase and per component.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "polder/grid/active_rows.hpp"
#include "polder/grid/walls.hpp"

namespace polder {

/// 0, 1 or another mark on each face.
template <class Space>
using FaceFlags = std::array<AlignedVector<std::uint8_t>, static_cast<std::size_t>(Space::axes)>;

/// The mark of a face on which a film runs, and of those that take its velocity alone.
inline constexpr std::uint8_t film_face = 2;

/// Where a field is known after one layer of extrapolation, and after two.
template <class Space>
using Layers = std::array<FaceFlags<Space>, 2>;

template <class Space>
struct GridFields {
  explicit GridFields(const Lattice<Space>& lattice)
      : rows(lattice, 1),
        soil_mass(make_face_field(lattice)),
        soil_velocity(make_face_field(lattice)),
        soil_force(make_face_field(lattice)),
        soil_before(make_face_field(lattice)),
        water_mass(make_face_field(lattice)),
        water_velocity(make_face_field(lattice)),
        water_before(make_face_field(lattice)),
        carried_mass(make_face_field(lattice)),
        porosity(make_face_field(lattice)),
        relative_flux(make_face_field(lattice)),
        discharge(make_face_field(lattice)),
        soil_response(make_face_field(lattice)),
        water_response(make_face_field(lattice)),
        mobility(make_face_field(lattice)),
        shift(make_face_field(lattice)),
        soil_sums(static_cast<std::size_t>(4 * lattice.size), 0.0),
        solid_volume(lattice.make_array()),
        saturated_solid(lattice.make_array()),
        carried_volume(lattice.make_array()),
        soil_cell_mass(lattice.make_array()),
        linear_drag{lattice.make_array(), lattice.make_array()},
        quadratic_drag{lattice.make_array(), lattice.make_array()},
        water_volume(lattice.make_array()),
        cell_porosity(lattice.make_array()),
        fill(lattice.make_array()),
        pressure(lattice.make_array()),
        pressure_trend(lattice.make_array()),
        potential(lattice.make_array()),
        potential_trend(lattice.make_array()),
        owed(lattice.make_array()),
        wet(static_cast<std::size_t>(lattice.size), 0) {
    for (auto* flags : {&reached, &layers[0], &layers[1], &shift_layers[0], &shift_layers[1], &soil_known})
      flags->fill(wet);
    for (auto& n : porosity) std::fill(n.begin(), n.end(), 1.0);
    std::fill(cell_porosity.begin(), cell_porosity.end(), 1.0);
  }

  /// Makes `now` the active rows. What is active no longer goes back to rest: no points, no motion, no pressure.
  void activate(const Lattice<Space>& lattice, ActiveRows<Space> now);

  ActiveRows<Space> rows;  ///< where the step works; elsewhere everything is at rest

  // on faces
  FaceField<Space> soil_mass;       ///< kg
  FaceField<Space> soil_velocity;   ///< kg m/s while points write to it, m/s afterwards
  FaceField<Space> soil_force;      ///< N, internal forces −Σ V σ'·∇N
  FaceField<Space> soil_before;     ///< m/s, velocity before the step's forces
  FaceField<Space> unresolved;      ///< m/s, find_unresolved(); empty where transfers are by APIC alone
  FaceField<Space> water_mass;      ///< kg
  FaceField<Space> water_velocity;  ///< as soil_velocity
  FaceField<Space> water_before;    ///< m/s, velocity at the start of the step
  FaceField<Space> carried_mass;    ///< kg of water that soil points carry (single-point)
  FaceField<Space> porosity;        ///< n_f = 1 − m_s/(ρs V_f)
  FaceField<Space> relative_flux;   ///< |q| = n|v_w − v_s| of the last step, m/s, lagged in the quadratic drag
  FaceField<Space> discharge;       ///< q = n(v_w − v_s), m/s, for the advection of water points
  FaceField<Space> soil_response, water_response;  ///< dv/d(∇p), m/s per Pa/m
  FaceField<Space> mobility;                       ///< β_f = −(n dv_w + (1−n) dv_s)/d(∇p)
  FaceField<Space> shift;                          ///< m, correction of the water's positions
  FaceFlags<Space> reached;                        ///< 1: a wet cell beside the face; film_face: a film on it

  // in cells
  Array soil_sums;                      ///< the next and the horizontal drag side by side while points write, 4 a cell
  Array solid_volume;                   ///< m³, by overlap of the points' boxes
  Array saturated_solid;                ///< m³, grains of the soil points that carry water (single-point)
  Array carried_volume;                 ///< m³, the water that these carry
  Array soil_cell_mass;                 ///< kg, likewise
  std::array<Array, 2> linear_drag;     ///< Σ V a(n), Pa s m; horizontal and, where it differs, vertical
  std::array<Array, 2> quadratic_drag;  ///< Σ V b(n), kg/m
  Array water_volume;                   ///< m³, by overlap
  Array cell_porosity;
  Array fill;             ///< F = water volume / pore volume
  Array pressure;         ///< Pa, kept from step to step
  Array pressure_trend;   ///< its change by the last solve, Pa
  Array potential;        ///< ψ of the volume correction, m²
  Array potential_trend;  ///< that of the last solve
  Array owed;             ///< m³ that came in through open sides and is not yet in points; by the cell beyond the side
  Array spare;  ///< m³ that soil points have given and that is not yet in points, or < 0; single-point, else empty
  Array rain;   ///< m³ that has fallen and is not yet in points, by column; without rain empty
  /// Of absorbing sides, without them empty: N and Pa that hold their faces at rest.
  FaceField<Space> far_force;
  Array far_pressure;                  ///< in the cells beyond
  std::array<Array, 2> far_impedance;  ///< Pa s/m against motion across the side and along it; likewise
  std::uint64_t far_is_known = 0;      ///< they have been taken
  std::vector<std::array<double, 2>>
      body_impulse;                      ///< N s, of the soil on each body in the step, where it is asked for
  std::vector<std::ptrdiff_t> cavities;  ///< cells that held a void when the step began, keep_cavities()
  AlignedVector<std::uint8_t> wet;
  Layers<Space> layers, shift_layers;  ///< scratch of extrapolations, and of the shift's
  FaceFlags<Space> soil_known;
};

}  // namespace polder
