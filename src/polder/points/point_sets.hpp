#pragma once
// The material points, one contiguous array per quantity, sorted by cell.
//
// A point's id is stable for its life and unique within its phase. `home` is the cell in which the point was when the
// set was last sorted; consecutive points of one home form a group.
#include <array>
#include <cstdint>
#include <vector>

#include "polder/grid/lattice.hpp"
#include "polder/material/law.hpp"

namespace polder {

namespace detail {
template <std::size_t N, class Body>
void each_of(const char* name, std::array<Array, N>& arrays, Body&& body) {
  for (std::size_t c = 0; c < N; ++c) body(name, static_cast<int>(c), arrays[c]);
}
}  // namespace detail

template <class Space>
struct WaterPoints {
  static constexpr int axes = Space::axes;
  std::array<Array, axes> position;                    ///< m
  std::array<Array, axes> velocity;                    ///< m/s
  std::array<Array, std::size_t{axes} * axes> affine;  ///< 1/s, APIC matrix B·D⁻¹, row = component
  Array volume;                                        ///< m³ (per metre in plane strain), true volume of water
  std::array<Array, axes> elongation;  ///< edge of the point's box over that of one shaped as a cell, minus 1
  AlignedVector<std::uint64_t> id;
  AlignedVector<std::int32_t> home;

  std::size_t size() const { return volume.size(); }
  /// body(name, component, array) for every array.
  template <class Body>
  void each_array(Body&& body) {
    detail::each_of("position", position, body);
    detail::each_of("velocity", velocity, body);
    detail::each_of("affine", affine, body);
    body("volume", 0, volume);
    detail::each_of("elongation", elongation, body);
    body("id", 0, id);
    body("home", 0, home);
  }
};

template <class Space>
struct SoilPoints {
  static constexpr int axes = Space::axes;
  std::array<Array, axes> position;                    ///< m
  std::array<Array, axes> velocity;                    ///< m/s
  std::array<Array, std::size_t{axes} * axes> affine;  ///< 1/s
  std::array<Array, Space::stress> stress;             ///< Pa, effective, tension positive
  std::array<Array, axes> reference;                   ///< m, position from which displacement counts
  Array mass;                                          ///< kg of grains
  Array porosity;
  Array water;              ///< m³ in its pores, as at no pressure (unsaturated formulation)
  Array deviatoric_strain;  ///< ∫ √(2/3 ė:ė) dt
  std::array<Array, StressBatch<4>::max_state> state;  ///< the law's; [0]: plastic shear strain
  AlignedVector<std::uint64_t> id;
  AlignedVector<std::int32_t> home;
  AlignedVector<std::uint8_t> material;
  AlignedVector<std::uint8_t> fluid;      ///< 1: grains out of contact
  AlignedVector<std::uint8_t> saturated;  ///< 1: carries the water of its pores (single-point formulation)
  AlignedVector<std::uint8_t> load;       ///< 1 + number of the load on the ground that it carries; 0: none

  std::size_t size() const { return mass.size(); }
  /// body(name, component, array) for every array.
  template <class Body>
  void each_array(Body&& body) {
    detail::each_of("position", position, body);
    detail::each_of("velocity", velocity, body);
    detail::each_of("affine", affine, body);
    detail::each_of("stress", stress, body);
    detail::each_of("reference", reference, body);
    detail::each_of("state", state, body);
    body("mass", 0, mass);
    body("porosity", 0, porosity);
    body("water", 0, water);
    body("deviatoric_strain", 0, deviatoric_strain);
    body("id", 0, id);
    body("home", 0, home);
    body("material", 0, material);
    body("fluid", 0, fluid);
    body("saturated", 0, saturated);
    body("load", 0, load);
  }
};

/// Takes out the points with `leaves` set; the others keep their order.
template <class Points>
void remove_points(Points& points, const std::vector<std::uint8_t>& leaves) {
  points.each_array([&](const char*, int, auto& array) {
    std::size_t to = 0;
    for (std::size_t p = 0; p < leaves.size(); ++p)
      if (!leaves[p]) array[to++] = array[p];
    array.resize(to);
  });
}

/// Every array gets `count` more entries, zero.
template <class Points>
std::size_t append_points(Points& points, std::size_t count) {
  const std::size_t first = points.size();
  points.each_array([&](const char*, int, auto& array) { array.resize(first + count); });
  return first;
}

/// Where point p is, m; axes that the space has not got are 0.
template <class Points>
std::array<double, 3> position_of(const Points& points, std::size_t p) {
  std::array<double, 3> x{0, 0, 0};
  for (int a = 0; a < Points::axes; ++a) x[a] = points.position[a][p];
  return x;
}

template <class Space>
std::array<double, 3> reference_of(const SoilPoints<Space>& soil, std::size_t p) {
  std::array<double, 3> x{0, 0, 0};
  for (int a = 0; a < Space::axes; ++a) x[a] = soil.reference[a][p];
  return x;
}

/// |v|² of point p, m²/s².
template <class Points>
double speed_squared(const Points& points, std::size_t p) {
  double square = 0;
  for (const auto& v : points.velocity) square += v[p] * v[p];
  return square;
}

}  // namespace polder
