#pragma once
// What the unsaturated formulation keeps on the grid beside GridFields: water, pores and weights of the cells, which
// face takes over from which. docs/theory.md, "Unsaturated soil".
#include <cstdint>
#include <vector>

#include "polder/grid/lattice.hpp"
#include "polder/step/point_cells.hpp"
#include "polder/step/setup.hpp"

namespace polder {

/// Of a face without soil on either side of it along its own axis: who moves it.
enum class Leader : std::int8_t { itself, below, above, none };

template <class Space>
struct PoreFields {
  PoreFields(const Lattice<Space>& lattice, std::size_t materials)
      : sums(static_cast<std::size_t>(4 * lattice.size), 0.0),
        bulk(lattice.make_array()),
        yielding(bulk),
        water(bulk),
        resistance{bulk, bulk},
        composition(materials, bulk),
        ratio(materials, bulk),
        ratio_before(materials, bulk),
        pores(bulk),
        weight(make_face_field(lattice)),
        saturation(bulk),
        relative(bulk),
        content(bulk),
        storage(bulk),
        content_before(bulk),
        volume_change(bulk),
        points_change(bulk),
        correction(bulk),
        surplus(bulk),
        deviation(bulk),
        way(bulk),
        mixing(bulk),
        over_ground(bulk),
        over_side(bulk),
        over_face(bulk),
        flooded(bulk),
        face_bulk(bulk),
        flow(make_face_field(lattice)),
        held_mass(make_face_field(lattice)),
        host(static_cast<std::size_t>(lattice.size), -1),
        active(static_cast<std::size_t>(lattice.size), 0) {
    for (auto& l : leader) l.assign(static_cast<std::size_t>(lattice.size), 0);
  }

  /// What there is of water that stands on the ground.
  std::array<Array*, 4> standing_water() { return {&over_ground, &over_side, &over_face, &flooded}; }

  // in cells; volumes in m³, per metre in plane strain
  Array sums;                       ///< the next three and the horizontal resistance side by side while points write
  Array bulk;                       ///< of the soil, by overlap of the points' boxes
  Array yielding;                   ///< the part of it that deforms
  Array water;                      ///< in its pores, as at no pressure
  std::array<Array, 2> resistance;  ///< μ/κ, Pa s/m², horizontal and vertical, mean over the cell
  std::vector<Array> composition;   ///< pore volume by material
  std::vector<Array> ratio;         ///< water over pore volume, Θ/(n V), by material, where there is some of it
  std::vector<Array> ratio_before;  ///< the same at the start of the step
  Array pores;                      ///< of all materials
  FaceField<Space> weight;          ///< by axis: volume over which the cell's pressure acts, and its strain is
                                    ///< counted; where cells differ, that of the smallest width along the axis
  Array saturation;                 ///< S at the start of the step, mean over the pores
  Array relative;                   ///< k_r
  Array content, storage;           ///< Θ(p), m³, and dΘ/dp, m³/Pa
  Array content_before;             ///< Θ(p), m³, at the start of the step
  Array volume_change;              ///< D, m³/s, by the faces' velocities
  Array points_change;              ///< the same by the points' own strains
  Array correction;                 ///< 1/s, of the points' rates of dilation
  Array surplus;                    ///< water that a cell gained beyond the change of Θ in the step, over the pores
  Array deviation;                  ///< what a cell holds beyond Θ after the step, over the pores
  Array way;                        ///< that the cell's faces move in the step, cells
  Array mixing;                     ///< share of their differences that a cell's points lose in the step
  Array over_ground;                ///< Pa, pressure of still water that stands on the ground, at the cell's centre
  Array over_side;                  ///< the same, mean over what the ground leaves of the cell's height
  Array over_face;             ///< the same at the lower of its two upward faces, of the ground's uppermost cell at
                               ///< both, less than 0 if that is over the water
  Array flooded;               ///< 0 to 1: whether water stands on the ground of this column
  Array face_bulk;             ///< m³ of yielding soil by splines on the upward faces, where water stands
  FaceField<Space> flow;       ///< m³/s of water through a face, along the axis, relative to the grains
  FaceField<Space> held_mass;  ///< kg of soil that never moves
  AlignedVector<std::int32_t> host;    ///< cell that stands for one without soil of its own; −1: itself
  AlignedVector<std::uint8_t> active;  ///< has a pressure
  std::array<AlignedVector<std::int8_t>, Space::axes> leader;

  // of points, in their order
  PointBoxes<Space> box;                                  ///< the cells that a point counts for, until it moves
  std::array<Array, Space::axes * Space::axes> gradient;  ///< 1/s
  Array dilation;                                         ///< 1/s
  Array inertia;                                          ///< kg
  Array volume;                                           ///< m³, of grains and pores, with the porosity as it is
  Array pore_volume;                                      ///< m³, at the start of the step
};

}  // namespace polder
