#pragma once
// Small-strain elastic–plastic finite elements in plane strain on 6-node triangles with three Gauss points each, which
// do not lock at constant volume. Equilibrium of effective stresses, pore pressures given:
//     ∫ Bᵀ (σ' − p m) dV = ∫ Nᵀ γ dV + ∫ Nᵀ t dS,   by Newton with the consistent tangent and a line search.
#include <Eigen/Sparse>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "polder/material/retention.hpp"
#include "polder/seepage/mesh.hpp"
#include "polder/stability/fem_material.hpp"
#include "polder/stability/fem_points.hpp"

namespace polder {

struct FemMaterial {
  double young_modulus = 1e8;  ///< Pa, drained
  double poisson_ratio = 0.3;
  double cohesion = 0;                                                 ///< Pa
  double friction_angle = 0;                                           ///< rad
  double dilation_angle = 0;                                           ///< rad
  double tension_strength = std::numeric_limits<double>::quiet_NaN();  ///< Pa; NaN: the cone's apex
  double dry_unit_weight = 0;                                          ///< N/m³, of soil without water
  double porosity = 0;                                                 ///< the water in it weighs n S γw
  Retention retention = LinearRetention{1, 0};                         ///< dry above the water table unless given
  bool elastic = false;
  /// Not weakened by strength reduction (structures, ground that must not fail).
  bool keeps_strength = false;
};

/// Displacements prescribed along the sides of the outline that lie on `line` (m; absent: free).
struct FemSupport {
  std::vector<Point2> line;
  std::optional<double> x, y;
};

/// Uniform traction on the sides of the outline that lie on `line`, Pa (x, y).
struct FemLoad {
  std::vector<Point2> line;
  Point2 traction{0, 0};
};

struct FemProblem {
  const Mesh* mesh = nullptr;
  std::vector<FemMaterial> materials;  ///< one per region of the mesh
  std::vector<FemSupport> supports;
  std::vector<FemLoad> loads;
  double water_unit_weight = 9810;  ///< N/m³
  /// Suction strengthens the soil by S·s where true (Bishop's χ = S); ignored above the water table where false.
  bool suction = false;
};

struct FemState {
  std::vector<double> displacement;           ///< m: x, y per node
  std::vector<std::array<double, 4>> stress;  ///< effective, Pa, three Gauss points per triangle
  std::vector<double> plastic_shear;          ///< deviatoric plastic strain gathered, per Gauss point
};

/// What acts: pore pressure, weight and loads, and the strength of the materials.
struct FemAction {
  std::vector<double> pore_pressure;  ///< Pa at the nodes; empty: dry
  double weight = 1;                  ///< factor on gravity
  double load = 1;                    ///< factor on loads and prescribed displacements
  double strength_factor = 1;         ///< F: c/F, tan φ/F
  /// ψ = φ instead of the materials' own ψ: equilibrium is then found wherever there is one.
  bool associated = false;
};

struct FemOptions {
  double tolerance = 5e-4;  ///< out-of-balance force over the driving force
  int iterations = 50;
  bool stop_early = true;  ///< give up when displacements run away, as at failure
};

struct FemOutcome {
  bool converged = false;
  int iterations = 0;
  double residual = 0;              ///< out-of-balance over driving force
  double largest_displacement = 0;  ///< m, in this step
};

class FemSolver {
 public:
  /// Throws std::invalid_argument where a support or load lies on no side, or a material is missing or impossible.
  explicit FemSolver(FemProblem problem);
  ~FemSolver();

  const FemProblem& problem() const { return problem_; }
  FemState unstressed() const;
  /// Stress from the weight above, σ'h = K0 σ'v, without displacement. In general not in equilibrium: follow with
  /// solve.
  FemState k0(const FemAction& action, const std::function<double(int material)>& k0) const;
  /// Moves `state` to equilibrium with `action`. Where that fails, `state` holds the last iterate.
  FemOutcome solve(FemState& state, const FemAction& action, const FemOptions& options = {}) const;
  /// Force on the soil at the supports of a line, N/m (x, y).
  Point2 reaction(const FemState& state, const FemAction& action, std::span<const Point2> line) const;
  /// Deviatoric strain √(2/3 e:e) of a displacement field, per Gauss point.
  std::vector<double> deviatoric_strain(std::span<const double> displacement) const;
  /// Three Gauss points per triangle, in its order.
  const std::vector<FemPoint>& points() const { return points_; }

 private:
  struct Pattern;
  Eigen::VectorXd external(const FemAction& action) const;
  Eigen::VectorXd internal(const FemState& state) const;
  std::vector<FemStrength> strengths(double factor, bool associated = false) const;

  FemProblem problem_;
  std::vector<FemPoint> points_;
  std::unique_ptr<Pattern> pattern_;
};

}  // namespace polder
