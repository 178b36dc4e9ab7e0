#pragma once
// The thin walls of a case that stand at a time; gates among them have vanished by then.
#include <cmath>
#include <limits>
#include <vector>

#include "polder/boundary/in_stage.hpp"
#include "polder/case/model.hpp"
#include "polder/case/wall_line.hpp"
#include "polder/case/wall_motion.hpp"
#include "polder/grid/bodies.hpp"
#include "polder/grid/thin_walls.hpp"

namespace polder {

/// A face of a thin wall along which soil slides with friction.
struct FrictionFace {
  int axis;
  std::ptrdiff_t face;
  double coefficient;  ///< tan δ
};

/// Whether the wall's own time has not come at `time`, to within round-off.
inline bool stands_at(const WallInput& wall, double time) { return wall.until - time > 1e-9 * std::abs(time); }

/// Which walls stand in stage number `stage` at time `time` (s; below 0 in initial stages).
inline std::vector<bool> standing(const Model& model, std::size_t stage, double time) {
  std::vector<bool> stands;
  for (const WallInput& wall : model.walls) stands.push_back(stands_at(wall, time) && in_stage(wall, stage));
  return stands;
}

/// The faces that those walls close; in 3d all across y.
template <class Space>
ThinWalls<Space> make_thin_walls(const Model& model, const Lattice<Space>& lattice, const std::vector<bool>& stands) {
  ThinWalls<Space> walls(lattice);
  for (std::size_t w = 0; w < model.walls.size(); ++w) {
    const WallInput& wall = model.walls[w];
    if (!stands[w] || wall.line.empty()) continue;
    for (const WallFace& face : stepped_wall(wall.line, lattice.axis[0], lattice.axis[Space::up]).faces)
      for (int across = 0; across < (Space::axes == 3 ? lattice.cells[1] : 1); ++across) {
        const std::array<int, 3> cell =
            Space::axes == 3 ? std::array{face.i, across, face.j} : std::array{face.i, face.j, 0};
        walls.close(face.upright ? 0 : Space::up, cell, wall.rough ? WallFaceKind::rough : WallFaceKind::smooth);
      }
  }
  walls.finish();
  return walls;
}

/// Their faces along which soil slides with friction.
template <class Space>
std::vector<FrictionFace> friction_faces(const Model& model, const Lattice<Space>& lattice,
                                         const std::vector<bool>& stands) {
  std::vector<FrictionFace> faces;
  for (std::size_t w = 0; w < model.walls.size(); ++w) {
    const WallInput& wall = model.walls[w];
    if (!stands[w] || wall.line.empty() || wall.rough || wall.friction_angle <= 0) continue;
    for (const WallFace& face : stepped_wall(wall.line, lattice.axis[0], lattice.axis[Space::up]).faces)
      for (int across = 0; across < (Space::axes == 3 ? lattice.cells[1] : 1); ++across) {
        const int axis = face.upright ? 0 : Space::up;
        const int place = face.upright ? face.i : face.j;
        if (place <= 0 || place >= lattice.cells[axis]) continue;  // the model's own walls are there
        faces.push_back({axis, Space::axes == 3 ? lattice.index(face.i, across, face.j) : lattice.index(face.i, face.j),
                         std::tan(wall.friction_angle)});
      }
  }
  return faces;
}

/// The bodies among those that stand, where they are at `time`, with the velocities that take them in a step of `dt` to
/// where they are then (0: at rest).
template <class Space>
Bodies<Space> make_bodies(const Model& model, const Lattice<Space>& lattice, const std::vector<bool>& stands,
                          double time, double dt = 0) {
  std::vector<BodySection> sections;
  for (std::size_t w = 0; w < model.walls.size(); ++w) {
    const WallInput& wall = model.walls[w];
    if (!stands[w] || wall.polygon.empty()) continue;
    BodySection section{outline_at(wall, time),
                        wall.rough ? std::numeric_limits<double>::infinity() : std::tan(wall.friction_angle),
                        {},
                        w};
    const Point2 now = displacement_at(wall, time), then = displacement_at(wall, time + dt);
    for (std::size_t k = 0; dt > 0 && k < 2; ++k) section.velocity[k] = (then[k] - now[k]) / dt;
    sections.push_back(std::move(section));
  }
  return sections.empty() ? Bodies<Space>()
                          : Bodies<Space>(lattice, std::move(sections), model.unsaturated || any_body_moves(model));
}

}  // namespace polder
