// Walls against the model and its grid.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "polder/case/geometry.hpp"
#include "polder/case/sections.hpp"
#include "polder/case/wall_line.hpp"

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
    if (f.is_given("friction_angle") && w.rough)
      report(diagnostics, f.place_of("friction_angle"), f.path_of("friction_angle"),
             "has no meaning on a rough wall, to which soil sticks", "leave it out, or set soil = \"smooth\"");
    if (!fits(0) || !fits(up)) continue;
    if (model.walls[i].line.size() >= 2) check_thin_wall(model.walls[i], f, model, diagnostics);
    if (model.walls[i].polygon.size() >= 3) check_body(model.walls[i], f, model, diagnostics);
  }
}

}  // namespace polder::case_file
