#include "polder/stability/fem_points.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace polder {

std::vector<FemPoint> fem_points(const Mesh& mesh) {
  constexpr double near = 1.0 / 6, far = 2.0 / 3;
  constexpr std::array<std::array<double, 3>, 3> places{{{far, near, near}, {near, far, near}, {near, near, far}}};
  std::vector<FemPoint> points;
  for (int e = 0; e < static_cast<int>(mesh.triangles.size()); ++e)
    for (const auto& place : places) {
      const ShapeGradient s = shape_gradient(mesh, e, place);
      Point2 position{0, 0};
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 2; ++k) position[k] += place[i] * mesh.nodes[mesh.triangles[e][i]][k];
      points.push_back({s.gradient, place, position, s.area / 3});
    }
  return points;
}

Eigen::Vector3d strain(const FemPoint& point, const std::array<int, 6>& nodes, std::span<const double> u) {
  Eigen::Vector3d e = Eigen::Vector3d::Zero();
  for (int i = 0; i < 6; ++i) {
    const std::size_t at = std::size_t{2} * nodes[i];
    const double x = u[at], y = u[at + 1];
    e[0] += point.gradient[i][0] * x;
    e[1] += point.gradient[i][1] * y;
    e[2] += point.gradient[i][1] * x + point.gradient[i][0] * y;
  }
  return e;
}

double deviatoric_strain(const Eigen::Vector3d& e) {
  const double mean = (e[0] + e[1]) / 3;
  const double squares = std::pow(e[0] - mean, 2) + std::pow(e[1] - mean, 2) + mean * mean + e[2] * e[2] / 2;
  return std::sqrt(2.0 / 3.0 * squares);
}

void add_internal(const FemPoint& point, const std::array<int, 6>& nodes, const std::array<double, 4>& stress,
                  Eigen::VectorXd& f) {
  for (int i = 0; i < 6; ++i) {
    const double gx = point.volume * point.gradient[i][0], gy = point.volume * point.gradient[i][1];
    const Eigen::Index at = Eigen::Index{2} * nodes[i];
    f[at] += gx * stress[0] + gy * stress[3];
    f[at + 1] += gy * stress[1] + gx * stress[3];
  }
}

void add_stiffness(const FemPoint& point, const Eigen::Matrix3d& tangent, const int* slot, double* values) {
  Eigen::Matrix<double, 3, 12> b;
  for (int i = 0; i < 6; ++i) {
    const auto& g = point.gradient[i];
    const Eigen::Index at = Eigen::Index{2} * i;
    b.col(at) << g[0], 0, g[1];
    b.col(at + 1) << 0, g[1], g[0];
  }
  const Eigen::Matrix<double, 3, 12> stress = (point.volume * tangent) * b;
  Eigen::Matrix<double, 12, 12, Eigen::RowMajor> k;
  k.noalias() = b.transpose() * stress;
  for (int i = 0; i < 144; ++i)
    if (slot[i] >= 0) values[slot[i]] += k.data()[i];
}

double value_at(const Mesh& mesh, std::span<const double> nodal, int triangle, const std::array<double, 3>& weight) {
  if (nodal.empty()) return 0;
  return interpolate(mesh, nodal, {triangle, weight});
}

std::vector<MeshEdge> sides_on(const Mesh& mesh, const std::vector<Point2>& line, const std::string& what) {
  double size = 0;
  for (const auto& p : mesh.nodes) size = std::max({size, std::abs(p[0]), std::abs(p[1])});
  std::vector<MeshEdge> found;
  for (const auto& side : outline(mesh))
    if (side_lies_on(mesh, side, line, 1e-5 * size)) found.push_back(side);
  if (found.empty())
    throw std::invalid_argument(fmt::format(
        "finite elements: a {} lies on no side of the soil's outline; its line must follow the outline", what));
  return found;
}

}  // namespace polder
