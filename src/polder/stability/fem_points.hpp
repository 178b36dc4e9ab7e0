#pragma once
// The Gauss points of a mesh of 6-node triangles: strains from displacements, forces from stresses, stiffness.
#include <Eigen/Dense>
#include <span>
#include <string>
#include <vector>

#include "polder/seepage/mesh.hpp"

namespace polder {

/// One of three points in a triangle (order two: exact for a straight-sided triangle's stiffness, and soft enough at
/// constant volume).
struct FemPoint {
  std::array<Point2, 6> gradient;  ///< of the shape functions, 1/m
  std::array<double, 3> weight;    ///< barycentric coordinates
  Point2 position;                 ///< m
  double volume;                   ///< m² (per metre of thickness: m³)
};

/// Three per triangle, in its order.
std::vector<FemPoint> fem_points(const Mesh& mesh);

/// Strain xx, yy and engineering shear γxy from displacements (x, y per node).
Eigen::Vector3d strain(const FemPoint& point, const std::array<int, 6>& nodes, std::span<const double> displacement);

/// √(2/3 e:e) of a plane strain, e its deviator: the axial strain of an undrained triaxial test of the same distortion.
double deviatoric_strain(const Eigen::Vector3d& strain);

/// f += ∫ Bᵀ σ at the point; stress xx, yy, zz, xy.
void add_internal(const FemPoint& point, const std::array<int, 6>& nodes, const std::array<double, 4>& stress,
                  Eigen::VectorXd& f);

/// Adds Bᵀ D B at the point to the places `slot` (144, row by row; −1: left out) of `values`.
void add_stiffness(const FemPoint& point, const Eigen::Matrix3d& tangent, const int* slot, double* values);

/// Quadratic interpolation of nodal values in a triangle; zero where there are none.
double value_at(const Mesh& mesh, std::span<const double> nodal, int triangle, const std::array<double, 3>& weight);

/// Sides of the outline that lie on a polyline. Throws std::invalid_argument, naming `what`, where there are none.
std::vector<MeshEdge> sides_on(const Mesh& mesh, const std::vector<Point2>& line, const std::string& what);

}  // namespace polder
