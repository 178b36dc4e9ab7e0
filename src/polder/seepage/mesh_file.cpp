#include "polder/seepage/mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "polder/seepage/msh_reader.hpp"

namespace polder {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw std::invalid_argument(fmt::format("mesh file '{}': {}", path, what));
}

Point2 centre(const Mesh& mesh, int triangle) {
  const auto& t = mesh.triangles[triangle];
  Point2 c{};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 2; ++k) c[k] += mesh.nodes[t[i]][k] / 3;
  return c;
}

std::vector<double> areas(const Mesh& mesh, std::size_t regions) {
  std::vector<double> sum(regions, 0.0);
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) sum[mesh.region[t]] += area(mesh, t);
  return sum;
}

void take_regions(const std::string& path, const MeshRequest& request, Mesh& mesh) {
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const Point2 at = centre(mesh, t);
    int region = -1;
    for (int i = 0; i < static_cast<int>(request.polygons.size()); ++i)
      if (inside_polygon(request.polygons[i], at)) region = i;
    if (region < 0)
      fail(path, fmt::format("a triangle at ({:g}, {:g}) m lies outside the soil of the case; both have the same "
                             "coordinates, x and height in m",
                             at[0], at[1]));
    mesh.region[t] = region;
  }
}

// Against a coarse mesh of our own, which fills the polygons exactly.
void check_areas(const std::string& path, MeshRequest request, const Mesh& mesh) {
  Point2 low{1e300, 1e300}, high{-1e300, -1e300};
  for (const auto& polygon : request.polygons)
    for (const Point2& p : polygon)
      for (int k = 0; k < 2; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  request.size = std::hypot(high[0] - low[0], high[1] - low[1]);
  const std::vector<double> wanted = areas(make_mesh(request), request.polygons.size());
  const std::vector<double> found = areas(mesh, request.polygons.size());
  constexpr double tolerance = 1e-3;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    if (std::abs(found[i] - wanted[i]) > tolerance * wanted[i])
      fail(path,
           fmt::format("its triangles in the case's {}. soil have {:.6g} m2, and that soil {:.6g} m2; let sides of "
                       "triangles follow the outlines of the soils, and fill them",
                       i + 1, found[i], wanted[i]));
}

void check_lines(const std::string& path, const MeshRequest& request, const Mesh& mesh) {
  const double near = 1e-4 * typical_size(mesh);
  const auto sides = outline(mesh);
  for (const auto& line : request.lines)
    for (const Point2& p : line) {
      bool on_outline = false, at_node = false;
      for (const MeshEdge& side : sides) {
        const Point2 &a = mesh.nodes[side.a], &b = mesh.nodes[side.b];
        if (distance_to_segment(p, a, b) > near) continue;
        on_outline = true;
        at_node =
            at_node || std::min(std::hypot(p[0] - a[0], p[1] - a[1]), std::hypot(p[0] - b[0], p[1] - b[1])) < near;
      }
      if (on_outline && !at_node)
        fail(path,
             fmt::format("it has no node at ({:g}, {:g}) m, where a line of the case ends or bends (a boundary, the "
                         "edge of a load)",
                         p[0], p[1]));
    }
}

}  // namespace

double typical_size(const Mesh& mesh) {
  double sum = 0;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) sum += area(mesh, t);
  return std::sqrt(sum / static_cast<double>(mesh.triangles.size()) * 4 / std::sqrt(3.0));
}

Mesh mesh_of_file(const std::string& path, const MeshRequest& request) {
  if (!request.cuts.empty()) fail(path, "thin walls ([[wall]]) need the case's own mesh; leave the file out");
  std::ifstream file(path);
  if (!file) fail(path, "it cannot be read");
  Mesh mesh;
  try {
    mesh = read_msh(file).mesh;
  } catch (const std::invalid_argument& error) {
    fail(path, error.what());
  }
  take_regions(path, request, mesh);
  check_areas(path, request, mesh);
  check_lines(path, request, mesh);
  return mesh;
}

}  // namespace polder
