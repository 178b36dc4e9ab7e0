// Walls against the model and its grid.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "polder/case/geometry.hpp"
#include "polder/case/sections.hpp"
#include "polder/case/wall_line.hpp"
#include "polder/case/wall_motion.hpp"

namespace polder::case_file {
namespace {

/// Whether all corners lie in the model.
bool check_corners(const std::vector<Point2>& corners, const Fields& f, std::string_view key, const Model& model,
                   Diagnostics& diagnostics) {
  const std::size_t up = model.space == SpaceKind::solid ? 2 : 1;
  const double width = model.size[0], height = model.size[up], tolerance = 1e-9 * std::max(width, height);
  for (const Point2& p : corners)
    if (p[0] < -tolerance || p[0] > width + tolerance || p[1] < -tolerance || p[1] > height + tolerance) {
      report(diagnostics, f.place_of(key), f.path_of(key),
             fmt::format("the corner ({:.6g}, {:.6g}) m is outside the model", p[0], p[1]),
             fmt::format("the model reaches from (0, 0) to ({:.6g}, {:.6g}) m", width, height));
      return false;
    }
  return true;
}

void check_thin_wall(const WallInput& wall, const Fields& f, const Model& model, Diagnostics& diagnostics) {
  const std::size_t up = model.space == SpaceKind::solid ? 2 : 1;
  const double tolerance = 1e-9 * std::max(model.size[0], model.size[up]);
  if (!check_corners(wall.line, f, "line", model, diagnostics)) return;
  const SteppedWall stepped = stepped_wall(wall.line, model);
  if (stepped.faces.empty())
    report(diagnostics, f.place_of("line"), f.path_of("line"), "is shorter than half a cell: nothing of it is left",
           fmt::format("the grid has cells of {:.6g} m; make the wall longer or the cell smaller", model.cell[0]));
  else if (stepped.oblique)
    warn(diagnostics, f.place_of("line"), f.path_of("line"),
         fmt::format("is oblique: it is stepped along the grid, up to {:.3g} m away from its line", stepped.distance));
  else if (stepped.distance > tolerance)
    warn(diagnostics, f.place_of("line"), f.path_of("line"),
         fmt::format("is not on the grid: it moves to its faces, by up to {:.3g} m", stepped.distance));
}

void check_body(const WallInput& wall, const Fields& f, const Model& model, Diagnostics& diagnostics) {
  const std::string_view key = f.is_given("box") ? "box" : "polygon";
  if (!check_corners(wall.polygon, f, key, model, diagnostics)) return;
  if (const auto at = self_intersection(wall.polygon))
    report(diagnostics, f.place_of(key), f.path_of(key),
           fmt::format("the outline crosses or touches itself at ({:.6g}, {:.6g}) m", (*at)[0], (*at)[1]),
           "list the corners in the order in which one walks around the body, each once");
  else if (area(wall.polygon) <= 1e-18 * model.size[0] * model.size[0])
    report(diagnostics, f.place_of(key), f.path_of(key), "encloses no area", "give corners that are not on one line");
}

bool stands_then(const WallInput& wall, double time) { return wall.until > time && wall.until_stage < 0; }

/// A body that moves: how it is given, and what it may not meet on its way.
void check_motion(std::size_t number, const Sections& sections, const Model& model, Diagnostics& diagnostics) {
  const WallInput& wall = model.walls[number];
  const Fields& f = sections.walls[number];
  static constexpr std::pair<const char*, const char*> pairs[] = {{"velocity_x", "displacement_x"},
                                                                  {"velocity_upward", "displacement_upward"}};
  std::string_view key;
  for (std::size_t k = 0; k < 2; ++k) {
    const auto [velocity, displacement] = pairs[k];
    if (f.is_given(velocity)) key = velocity;
    if (f.is_given(displacement)) key = displacement;
    if (f.is_given(velocity) && f.is_given(displacement))
      report(diagnostics, f.place_of(displacement), f.path_of(displacement), "is given besides a velocity",
             fmt::format("keep one of {} and {}", velocity, displacement));
    if (!wall.displacement[k].y.empty() && wall.displacement[k](0) != 0)
      report(diagnostics, f.place_of(displacement), f.path_of(displacement),
             fmt::format("is {:.6g} m at t = 0", wall.displacement[k](0)),
             "begin with [\"0 s\", \"0 m\"], or draw the body where it begins");
  }
  if (key.empty()) return;
  if (wall.polygon.empty()) {
    report(diagnostics, f.place_of(key), f.path_of(key), "is for bodies: a thin wall stays on the faces of the grid",
           "give the wall as a polygon or a box, at least a cell thick");
    return;
  }
  if (!moves(wall)) return;
  if (model.periodic) return;  // has no walls, which has been reported
  const std::size_t up = model.space == SpaceKind::solid ? 2 : 1;
  const Bounds extent = bounds(wall.polygon);
  for (std::size_t k = 0; k < 2; ++k) {
    const double cell = model.cell[k == 0 ? 0 : up], thick = extent.high[k] - extent.low[k];
    if (cell > 0 && thick < cell * (1 - 1e-9))
      report(diagnostics, f.place_of(key), f.path_of(key),
             fmt::format("moves a body that is {:.3g} m thin: the cells are {:.3g} m, and water would pass it", thick,
                         cell),
             "make the body thicker or the cell smaller");
  }
  double end = 0;
  for (const Stage& stage : model.stages)
    if (!stage.initial) end += stage.duration;
  constexpr int samples = 200;
  for (std::size_t other = 0; other < model.walls.size(); ++other) {
    if (other == number || model.walls[other].polygon.size() < 3 || (moves(model.walls[other]) && other > number))
      continue;
    for (int i = 0; i <= samples; ++i) {
      const double t = end * i / samples;
      if (!stands_then(wall, t) || !stands_then(model.walls[other], t)) continue;
      const Overlap common = overlap(outline_at(wall, t), outline_at(model.walls[other], t));
      if (common.area <= 1e-9 * area(wall.polygon)) continue;
      report(diagnostics, f.place_of(key), f.path_of(key),
             fmt::format("takes the body into {} at t = {:.4g} s", sections.walls[other].path, t),
             "let it stop before, or take another way");
      break;
    }
  }
}

}  // namespace

void check_walls(const Sections& sections, const Model& model, Diagnostics& diagnostics) {
  const std::size_t up = model.space == SpaceKind::solid ? 2 : 1;
  const auto fits = [&](std::size_t axis) {  // an unsound grid has been reported
    return model.size[axis] > 0 && model.cell[axis] > 0 && model.size[axis] >= 0.5 * model.cell[axis];
  };
  for (std::size_t i = 0; i < model.walls.size(); ++i) {
    const Fields& f = sections.walls[i];
    if (f.is_given("until") && f.is_given("until_stage"))
      report(diagnostics, f.place_of("until_stage"), f.path_of("until_stage"), "is given besides a time",
             "a wall vanishes once: keep one of until and until_stage");
    const WallInput& w = model.walls[i];
    if (w.from_stage >= 0 && !w.polygon.empty())
      report(diagnostics, f.place_of("from_stage"), f.path_of("from_stage"),
             "is for thin walls: a body cannot appear in soil or water", "give the wall as a line, or leave it out");
    if (w.from_stage >= 0 && w.until_stage >= 0 && w.until_stage <= w.from_stage)
      report(diagnostics, f.place_of("until_stage"), f.path_of("until_stage"), "the wall vanishes before it is put in",
             "name a stage after that of from_stage");
    check_motion(i, sections, model, diagnostics);
    if (f.is_given("friction_angle") && w.rough)
      report(diagnostics, f.place_of("friction_angle"), f.path_of("friction_angle"),
             "has no meaning on a rough wall, to which soil sticks", "leave it out, or set soil = \"smooth\"");
    if (!fits(0) || !fits(up)) continue;
    if (model.walls[i].line.size() >= 2) check_thin_wall(model.walls[i], f, model, diagnostics);
    if (model.walls[i].polygon.size() >= 3) check_body(model.walls[i], f, model, diagnostics);
  }
}

}  // namespace polder::case_file
