#include "polder/seepage/mesh.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <random>
#include <sstream>

#include "polder/seepage/delaunay.hpp"
#include "polder/seepage/mesh_file.hpp"
#include "polder/seepage/msh_reader.hpp"

namespace {

using polder::Mesh;
using polder::MeshRequest;
using polder::Point2;

double total_area(const Mesh& mesh, int region = -1) {
  double sum = 0;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    if (region < 0 || mesh.region[t] == region) sum += polder::area(mesh, t);
  return sum;
}

TEST(Delaunay, NoCircumcircleContainsAnotherPoint) {
  std::mt19937_64 random(7);
  std::uniform_int_distribution<std::int64_t> coarse(0, 40);  // many points on common lines and circles
  polder::Delaunay d = polder::empty_delaunay();
  for (int i = 0; i < 600; ++i)
    polder::insert(
        d, {coarse(random) * (polder::Delaunay::extent / 40), coarse(random) * (polder::Delaunay::extent / 40)});
  std::int64_t area = 0;
  for (int t = 0; t < static_cast<int>(d.triangles.size()); ++t) {
    if (!d.triangles[t].alive()) continue;
    const auto& v = d.triangles[t].vertex;
    const std::int64_t twice = polder::orientation(d.points[v[0]], d.points[v[1]], d.points[v[2]]);
    EXPECT_GT(twice, 0);
    area += twice;
  }
  EXPECT_EQ(area, 2 * 25 * polder::Delaunay::extent * polder::Delaunay::extent);
  // The cavity of a vertex is the triangle found to hold it, and all whose circle contains it strictly: none.
  for (std::size_t i = polder::Delaunay::corners; i < d.points.size(); ++i)
    EXPECT_EQ(polder::cavity(d, d.points[i]).size(), 1u);
}

TEST(Mesher, FillsASlopeWithLayersExactly) {
  // ACADS 1c: a layer that tapers out at the toe with an angle of 11°.
  MeshRequest request;
  request.size = 1;
  request.polygons = {{{30, 25}, {50, 29}, {54, 31}, {70, 31}, {70, 35}, {50, 35}},
                      {{30, 25}, {40, 27}, {52, 24}, {70, 24}, {70, 31}, {54, 31}, {50, 29}},
                      {{20, 20}, {70, 20}, {70, 24}, {52, 24}, {40, 27}, {30, 25}, {20, 25}}};
  const Mesh mesh = polder::make_mesh(request);
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    double exact = 0;
    const auto& p = request.polygons[k];
    for (std::size_t i = 0; i < p.size(); ++i) {
      const auto& q = p[(i + 1) % p.size()];
      exact += (p[i][0] * q[1] - q[0] * p[i][1]) / 2;
    }
    EXPECT_NEAR(total_area(mesh, k), exact, 1e-5) << "layer " << k;
    sum += exact;
  }
  EXPECT_NEAR(total_area(mesh), sum, 1e-5);
  EXPECT_GT(polder::smallest_angle(mesh), 5.0);
  EXPECT_GT(mesh.triangles.size(), sum / (0.6 * 1.0));
  EXPECT_LT(mesh.triangles.size(), 5 * sum);
}

TEST(Mesher, KeepsAnglesWideWhereTheInputDoes) {
  MeshRequest request;
  request.size = 0.5;
  request.polygons = {{{0, 0}, {10, 0}, {10, 4}, {0, 4}}};
  request.finer = {{{3, 2}, 0.02}};
  const Mesh mesh = polder::make_mesh(request);
  EXPECT_GT(polder::smallest_angle(mesh), 22.0);
  EXPECT_NEAR(total_area(mesh), 40, 1e-6);
}

TEST(Mesher, MeshesRandomPolygonsWithoutGapsOrOverlaps) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    // A star-shaped outline with spikes, and a second polygon that overlaps it.
    MeshRequest request;
    std::vector<Point2> star;
    const int corners = 5 + static_cast<int>(unit(random) * 12);
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * M_PI * i / corners, radius = 1 + 9 * unit(random);
      star.push_back({20 + radius * std::cos(angle), 20 + radius * std::sin(angle)});
    }
    request.polygons = {star, {{18, 18}, {24, 17}, {25, 23}, {19, 24}}};
    request.size = 0.4 + unit(random);
    const Mesh mesh = polder::make_mesh(request);
    double star_area = 0;
    for (int i = 0; i < corners; ++i) {
      const auto &p = star[i], &q = star[(i + 1) % corners];
      star_area += (p[0] * q[1] - q[0] * p[1]) / 2;
    }
    int inside = 0;
    const int samples = 4000;
    const polder::MeshLocator locator(mesh);
    for (int i = 0; i < samples; ++i) {
      const Point2 p{10 + 20 * unit(random), 10 + 20 * unit(random)};
      const bool expected =
          polder::inside_polygon(request.polygons[0], p) || polder::inside_polygon(request.polygons[1], p);
      inside += expected == (locator.find(p).triangle >= 0);
    }
    EXPECT_GE(inside, samples - 2) << "seed " << seed;
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
      EXPECT_GT(polder::area(mesh, t), 0) << "seed " << seed;
    EXPECT_GE(total_area(mesh), star_area - 1e-5) << "seed " << seed;
  }
}

TEST(Mesher, OpensACutThatEndsOnTheOutline) {
  MeshRequest request;
  request.size = 0.5;
  request.polygons = {{{0, 0}, {10, 0}, {10, 4}, {0, 4}}};
  const auto closed = polder::make_mesh(request);
  request.cuts = {{{5, 4}, {5, 2}}};
  const Mesh mesh = polder::make_mesh(request);
  double cut_length = 0;
  for (const auto& e : polder::outline(mesh))
    if (std::abs(mesh.nodes[e.middle][0] - 5) < 1e-9 && mesh.nodes[e.middle][1] > 2 && mesh.nodes[e.middle][1] < 4)
      cut_length += std::hypot(mesh.nodes[e.a][0] - mesh.nodes[e.b][0], mesh.nodes[e.a][1] - mesh.nodes[e.b][1]);
  EXPECT_NEAR(cut_length, 2 * 2.0, 1e-6);
  EXPECT_NEAR(total_area(mesh), 40, 1e-6);
}

const char* const square_2 =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 7 \"clay core\"\n$EndPhysicalNames\n"
    "$Nodes\n4\n1 0 0 0\n2 2 0 0\n3 2 1 0\n9 0 1 0\n$EndNodes\n"
    "$Elements\n3\n1 1 2 5 1 1 2\n2 2 2 7 1 1 2 3\n3 2 2 7 1 1 9 3\n$EndElements\n";
const char* const square_4 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 1 0\n3 0 0 0 2 1 0 1 7 0\n$EndEntities\n"
    "$Nodes\n1 4 1 9\n2 3 0 4\n1\n2\n3\n9\n0 0 0\n2 0 0\n2 1 0\n0 1 0\n$EndNodes\n"
    "$Elements\n1 2 1 2\n2 3 2 2\n1 1 2 3\n2 1 9 3\n$EndElements\n";

TEST(MshReader, ReadsBothVersions) {
  for (const char* text : {square_2, square_4}) {
    std::istringstream in(text);
    const auto read = polder::read_msh(in);
    EXPECT_EQ(read.mesh.triangles.size(), 2u);
    EXPECT_EQ(read.mesh.nodes.size(), 9u);
    EXPECT_EQ(read.mesh.region, (std::vector<int>{7, 7}));
    EXPECT_NEAR(total_area(read.mesh), 2, 1e-12);
  }
  std::istringstream in(square_2);
  EXPECT_EQ(polder::read_msh(in).names.at(7), "clay core");
}

/// What the reader says of a file of version 4.1 or 2.2 with these sections.
std::string refusal_of_msh(const std::string& version, const std::string& sections) {
  std::istringstream in("$MeshFormat\n" + version + " 0 8\n$EndMeshFormat\n" + sections);
  try {
    polder::read_msh(in);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return {};
}

TEST(MshReader, SaysWhichLineIsWrong) {
  const std::string said = refusal_of_msh("2.2", "$Nodes\n2\n1 0 0 0\nx 1 0 0\n$EndNodes\n");
  EXPECT_NE(said.find("line 7"), std::string::npos) << said;
}

TEST(MshReader, RefusesCountsThatCannotBe) {
  for (const char* count : {"-1", "4000000000000000000"}) {
    const std::string said = refusal_of_msh("4.1", "$Nodes\n1 4 1 9\n2 3 0 " + std::string(count) + "\n1\n");
    EXPECT_NE(said.find("msh file, line"), std::string::npos) << count << ": " << said;
  }
  EXPECT_NE(refusal_of_msh("2.2", "$Nodes\n-4\n").find("cannot be negative"), std::string::npos);
}

TEST(MshReader, RefusesTrianglesWithoutArea) {
  const std::string nodes = "$Nodes\n4\n1 0 0 0\n2 2 0 0\n3 1 0 0\n4 1e300 1e300 0\n$EndNodes\n$Elements\n1\n";
  for (const char* corners : {"2 2 3", "1 2 3", "1 2 2"}) {
    const std::string said = refusal_of_msh("2.2", nodes + "1 2 2 3 3 " + corners + "\n");
    EXPECT_NE(said.find("has no area"), std::string::npos) << corners << ": " << said;
  }
}

TEST(MshReader, RefusesNodesBeyondAnySection) {
  const std::string said =
      refusal_of_msh("2.2", "$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 1 6e66 0\n$EndNodes\n$Elements\n1\n1 2 2 3 3 1 2 3\n");
  EXPECT_NE(said.find("no section does"), std::string::npos) << said;
}

/// The mesh as Gmsh writes it (2.2), three-node triangles.
std::string gmsh_text(const Mesh& mesh) {
  std::string text = fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", mesh.nodes.size());
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    text += fmt::format("{} {:.16g} {:.16g} 0\n", i + 1, mesh.nodes[i][0], mesh.nodes[i][1]);
  text += fmt::format("$EndNodes\n$Elements\n{}\n", mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    text += fmt::format("{} 2 2 9 1 {} {} {}\n", t + 1, mesh.triangles[t][0] + 1, mesh.triangles[t][1] + 1,
                        mesh.triangles[t][2] + 1);
  return text + "$EndElements\n";
}

std::string written(const std::string& text) {
  const std::string path = testing::TempDir() + fmt::format("polder-{}.msh", getpid());
  std::ofstream(path) << text;
  return path;
}

MeshRequest two_soils() {
  MeshRequest request;
  request.polygons = {{{0, 0}, {4, 0}, {4, 1}, {0, 1}}, {{0, 1}, {4, 1}, {4, 2}, {0, 2}}};
  request.size = 0.3;
  return request;
}

TEST(MeshFile, GivesTheMeshOfTheSoilsByThePlaceOfItsTriangles) {
  const Mesh own = make_mesh(two_soils());
  const Mesh read = mesh_of_file(written(gmsh_text(own)), two_soils());
  EXPECT_EQ(read.region, own.region);
  EXPECT_EQ(read.nodes.size(), own.nodes.size());
  EXPECT_NEAR(typical_size(read), 0.3, 0.1);
}

TEST(MeshFile, SaysWhatDoesNotFitTheCase) {
  const MeshRequest soils = two_soils();
  const std::string path = written(gmsh_text(make_mesh(soils)));
  const auto refusal = [&](const MeshRequest& request) -> std::string {
    try {
      mesh_of_file(path, request);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return {};
  };
  MeshRequest other = soils;
  other.polygons.pop_back();
  EXPECT_NE(refusal(other).find("lies outside the soil of the case"), std::string::npos) << refusal(other);
  other = soils;
  other.polygons[1] = {{0, 1}, {4, 1}, {4, 2.5}, {0, 2.5}};
  EXPECT_NE(refusal(other).find("2. soil have 4 m2, and that soil 6 m2"), std::string::npos) << refusal(other);
  other = soils;
  other.lines = {{{0, 2}, {1.2345, 2}}};
  EXPECT_NE(refusal(other).find("no node at (1.2345, 2) m"), std::string::npos) << refusal(other);
  other = soils;
  other.cuts = {{{1, 1}, {1, 2}}};
  EXPECT_NE(refusal(other).find("thin walls"), std::string::npos) << refusal(other);
  EXPECT_THROW(mesh_of_file(path + ".not", soils), std::invalid_argument);
}

TEST(MeshLocator, FindsPlacesInASlenderMesh) {
  const Mesh mesh = polder::quadratic_mesh({{0, 0}, {1e-6, 0}, {1e-6, 1e9}}, {{0, 1, 2}}, {0});
  EXPECT_EQ(polder::MeshLocator(mesh).find({0.9e-6, 1e8}).triangle, 0);
}

TEST(MeshLocator, InterpolatesQuadraticFieldsExactly) {
  MeshRequest request;
  request.size = 0.7;
  request.polygons = {{{0, 0}, {4, 0}, {3, 2}, {0, 2}}};
  const Mesh mesh = polder::make_mesh(request);
  std::vector<double> field;
  for (const auto& p : mesh.nodes) field.push_back(1 + p[0] - 2 * p[1] + p[0] * p[0] - 3 * p[0] * p[1]);
  const polder::MeshLocator locator(mesh);
  for (const Point2 p : {Point2{0.3, 0.4}, {2.9, 1.9}, {1.234, 1.001}}) {
    const auto place = locator.find(p);
    ASSERT_GE(place.triangle, 0);
    EXPECT_NEAR(polder::interpolate(mesh, field, place), 1 + p[0] - 2 * p[1] + p[0] * p[0] - 3 * p[0] * p[1], 1e-9);
  }
  EXPECT_LT(locator.find({3.9, 1.9}).triangle, 0);
}

TEST(Mesh, ASideMayPassOverTheVerticesOfALine) {
  MeshRequest request;
  request.polygons = {{{0, 0}, {3, 0}, {3, 1}, {0, 1}}};
  request.size = 0.7;
  const Mesh mesh = make_mesh(request);
  const std::vector<Point2> base{{0, 0}, {1.234, 0}, {1.777, 0}, {3, 0}};
  double length = 0;
  for (const polder::MeshEdge& side : outline(mesh))
    if (side_lies_on(mesh, side, base, 1e-6)) length += std::abs(mesh.nodes[side.b][0] - mesh.nodes[side.a][0]);
  EXPECT_NEAR(length, 3, 1e-9);
}

}  // namespace
