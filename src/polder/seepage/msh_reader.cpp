#include "polder/seepage/msh_reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <unordered_map>

namespace polder {
namespace {

constexpr int three_node_triangle = 2, six_node_triangle = 9;
constexpr double farthest = 1e9;  // m, of a node from the origin

struct Reader {
  std::istream& in;
  int line_number = 0;
  double version = 0;
  std::unordered_map<long, Point2> nodes{};
  std::unordered_map<int, int> group_of_surface{};  ///< version 4: entity → physical group
  std::vector<std::array<long, 3>> corners{};
  std::vector<int> region{};
  std::map<int, std::string> names{};

  [[noreturn]] void fail(const std::string& what) const {
    throw std::invalid_argument(fmt::format("msh file, line {}: {}", line_number, what));
  }

  bool next(std::string& line) {
    if (!std::getline(in, line)) return false;
    ++line_number;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return true;
  }

  std::istringstream fields(const char* section) {
    std::string line;
    if (!next(line)) fail(fmt::format("the file ends inside {}", section));
    return std::istringstream(line);
  }

  template <class... T>
  void take(std::istringstream& s, const char* what, T&... value) {
    if (!((s >> value) && ...)) fail(fmt::format("expected {}", what));
  }

  /// A number of things that the file says are to follow; memory is taken as they come, not for what it promises.
  template <class... T>
  void take_counts(std::istringstream& s, const char* what, T&... count) {
    take(s, what, count...);
    if (((count < 0) || ...)) fail(fmt::format("expected {}, which cannot be negative", what));
  }

  void element(int type, int group, std::istringstream& s) {
    if (type != three_node_triangle && type != six_node_triangle) return;
    std::array<long, 3> v{};
    take(s, "the nodes of a triangle", v[0], v[1], v[2]);
    corners.push_back(v);
    region.push_back(group);
  }

  void format() {
    auto s = fields("$MeshFormat");
    int binary = 0, size = 0;
    take(s, "version, file type and data size", version, binary, size);
    if (binary != 0) fail("binary files are not read; save the mesh with Mesh.Binary = 0");
    if (version != 2.2 && version != 4.1) fail(fmt::format("version {} is not read; save as 2.2 or 4.1", version));
  }

  void physical_names() {
    int count = 0;
    auto head = fields("$PhysicalNames");
    take_counts(head, "the number of names", count);
    for (int i = 0; i < count; ++i) {
      auto s = fields("$PhysicalNames");
      int dimension = 0, tag = 0;
      take(s, "dimension and number of a physical group", dimension, tag);
      std::string name;
      std::getline(s, name);
      const auto first = name.find('"'), last = name.rfind('"');
      if (dimension == 2 && first != std::string::npos && last > first)
        names[tag] = name.substr(first + 1, last - first - 1);
    }
  }

  void entities() {
    std::array<int, 4> count{};
    auto head = fields("$Entities");
    take_counts(head, "the numbers of entities", count[0], count[1], count[2], count[3]);
    for (int dimension = 0; dimension < 4; ++dimension)
      for (int i = 0; i < count[dimension]; ++i) {
        auto s = fields("$Entities");
        int tag = 0, physical = 0, group = 0;
        double skipped = 0;
        take(s, "an entity", tag);
        for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) take(s, "the bounds of an entity", skipped);
        take(s, "its physical groups", physical);
        if (physical > 0) take(s, "its physical groups", group);
        if (dimension == 2) group_of_surface[tag] = physical > 0 ? group : tag;
      }
  }

  void nodes_2() {
    long count = 0;
    auto head = fields("$Nodes");
    take_counts(head, "the number of nodes", count);
    for (long i = 0; i < count; ++i) {
      auto s = fields("$Nodes");
      long tag = 0;
      Point2 p{};
      take(s, "a node", tag, p[0], p[1]);
      nodes[tag] = p;
    }
  }

  void nodes_4() {
    long blocks = 0;
    auto head = fields("$Nodes");
    take_counts(head, "the number of blocks of nodes", blocks);
    for (long b = 0; b < blocks; ++b) {
      int dimension = 0, entity = 0, parametric = 0;
      long count = 0;
      auto s = fields("$Nodes");
      take(s, "a block of nodes", dimension, entity, parametric);
      take_counts(s, "the number of nodes of a block", count);
      std::vector<long> tags;
      for (long i = 0; i < count; ++i) {
        auto t = fields("$Nodes");
        take(t, "a node's number", tags.emplace_back());
      }
      for (const long tag : tags) {
        auto t = fields("$Nodes");
        Point2 p{};
        take(t, "a node's coordinates", p[0], p[1]);
        nodes[tag] = p;
      }
    }
  }

  void elements_2() {
    long count = 0;
    auto head = fields("$Elements");
    take_counts(head, "the number of elements", count);
    for (long i = 0; i < count; ++i) {
      auto s = fields("$Elements");
      long tag = 0;
      int type = 0, tags = 0, physical = 0, elementary = 0, skipped = 0;
      take(s, "an element", tag, type, tags);
      for (int k = 0; k < tags; ++k)
        take(s, "the tags of an element", k == 0 ? physical : k == 1 ? elementary : skipped);
      element(type, physical != 0 ? physical : elementary, s);
    }
  }

  void elements_4() {
    long blocks = 0;
    auto head = fields("$Elements");
    take_counts(head, "the number of blocks of elements", blocks);
    for (long b = 0; b < blocks; ++b) {
      int dimension = 0, entity = 0, type = 0;
      long count = 0;
      auto s = fields("$Elements");
      take(s, "a block of elements", dimension, entity, type);
      take_counts(s, "the number of elements of a block", count);
      const auto it = group_of_surface.find(entity);
      for (long i = 0; i < count; ++i) {
        auto t = fields("$Elements");
        long tag = 0;
        take(t, "an element", tag);
        if (dimension == 2) element(type, it == group_of_surface.end() ? entity : it->second, t);
      }
    }
  }
};

}  // namespace

GmshMesh read_msh(std::istream& in) {
  Reader r{in};
  std::string line;
  while (r.next(line)) {
    if (line == "$MeshFormat")
      r.format();
    else if (line == "$PhysicalNames")
      r.physical_names();
    else if (line == "$Entities")
      r.entities();
    else if (line == "$Nodes")
      r.version == 2.2 ? r.nodes_2() : r.nodes_4();
    else if (line == "$Elements")
      r.version == 2.2 ? r.elements_2() : r.elements_4();
  }
  if (r.version == 0) r.fail("no $MeshFormat: this is not a Gmsh file");
  if (r.corners.empty()) r.fail("no triangles in the file");

  std::unordered_map<long, int> number;
  std::vector<Point2> points;
  std::vector<std::array<int, 3>> triangles;
  for (const auto& c : r.corners) {
    std::array<int, 3> t{};
    for (int i = 0; i < 3; ++i) {
      const auto node = r.nodes.find(c[i]);
      if (node == r.nodes.end()) r.fail(fmt::format("a triangle uses node {}, which is not in the file", c[i]));
      for (const double x : node->second)
        if (!(std::abs(x) <= farthest)) r.fail(fmt::format("node {} lies at {:g} m: no section does", c[i], x));
      const auto [it, fresh] = number.try_emplace(c[i], static_cast<int>(points.size()));
      if (fresh) points.push_back(node->second);
      t[i] = it->second;
    }
    triangles.push_back(t);
  }
  GmshMesh read{quadratic_mesh(std::move(points), triangles, std::move(r.region)), std::move(r.names)};
  for (std::size_t t = 0; t < r.corners.size(); ++t)
    if (const double size = area(read.mesh, static_cast<int>(t)); !(size > 0) || !std::isfinite(size))
      r.fail(fmt::format("the triangle of the nodes {}, {} and {} has no area", r.corners[t][0], r.corners[t][1],
                         r.corners[t][2]));
  return read;
}

}  // namespace polder
