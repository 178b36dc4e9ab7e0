// Walls against the model and its grid.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "polder/case/sections.hpp"
#include "polder/case/wall_line.hpp"

namespace polder::case_file {
namespace {

void check_wall(const WallInput& wall, const Fields& f, const Model& model, Diagnostics& diagnostics) {
  const std::size_t up = model.space == SpaceKind::solid ? 2 : 1;
  const double width = model.size[0], height = model.size[up], tolerance = 1e-9 * std::max(width, height);
  for (const Point2& p : wall.line)
    if (p[0] < -tolerance || p[0] > width + tolerance || p[1] < -tolerance || p[1] > height + tolerance) {
      report(diagnostics, f.place_of("line"), f.path_of("line"),
             fmt::format("the corner ({:.6g}, {:.6g}) m is outside the model", p[0], p[1]),
             fmt::format("the model reaches from (0, 0) to ({:.6g}, {:.6g}) m", width, height));
      return;
    }
  const SteppedWall stepped = stepped_wall(wall.line, {model.cell[0], model.cell[up]});
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
    if (fits(0) && fits(up) && model.walls[i].line.size() >= 2) check_wall(model.walls[i], f, model, diagnostics);
  }
}

}  // namespace polder::case_file
