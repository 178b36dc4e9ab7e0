#include "polder/stability/fem_solver.hpp"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "polder/stability/sparse_ldu.hpp"

namespace polder {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// Share of the elastic stiffness in the tangent. The least holds nodes whose points all flow at the apex; it grows
/// where a Newton step does not bring the forces closer to balance (with the elastic stiffness alone the iteration is
/// slow but sure) and shrinks again where steps succeed.
constexpr double least_share = 1e-4, first_share = 1e-2, largest_share = 0.7;

/// √(2/3 eᵖ:eᵖ) of a step: the deviator of the strain less that of the elastic strain, Δs/2G.
double plastic_distortion(const Eigen::Vector3d& de, const std::array<double, 4>& from, const std::array<double, 4>& to,
                          double shear) {
  const double mean = (de[0] + de[1]) / 3;
  std::array<double, 4> d{};
  for (int k = 0; k < 4; ++k) d[k] = to[k] - from[k];
  const double pressure = (d[0] + d[1] + d[2]) / 3;
  const double xx = de[0] - mean - (d[0] - pressure) / (2 * shear), yy = de[1] - mean - (d[1] - pressure) / (2 * shear),
               zz = -mean - (d[2] - pressure) / (2 * shear), xy = de[2] / 2 - d[3] / (2 * shear);
  return std::sqrt(2.0 / 3.0 * (xx * xx + yy * yy + zz * zz + 2 * xy * xy));
}

constexpr double no_limit = std::numeric_limits<double>::infinity();

}  // namespace

struct FemSolver::Pattern {
  std::vector<int> unknown;   ///< per degree of freedom its row, −1 where prescribed
  std::vector<double> value;  ///< prescribed displacement, m
  int count = 0;
  Matrix matrix;  ///< of the unknowns, values of the last assembly
  Matrix elastic;
  std::vector<int> slot;  ///< 144 per triangle: place in the matrix's values, −1: none
  mutable Matrix tangent;
  mutable SparseLdu linear;
  Eigen::SimplicialLDLT<Matrix> elastic_factor;
};

FemSolver::~FemSolver() = default;

FemSolver::FemSolver(FemProblem problem)
    : problem_(std::move(problem)), points_(fem_points(*problem_.mesh)), pattern_(std::make_unique<Pattern>()) {
  const Mesh& mesh = *problem_.mesh;
  for (const int region : mesh.region)
    if (region < 0 || region >= static_cast<int>(problem_.materials.size()))
      throw std::invalid_argument(fmt::format("finite elements: no material for region {} of the mesh", region));
  for (const auto& m : problem_.materials)
    if (!(m.young_modulus > 0) || !(m.poisson_ratio > -1 && m.poisson_ratio < 0.5))
      throw std::invalid_argument("finite elements: Young's modulus must be positive and Poisson's ratio below 0.5");

  Pattern& p = *pattern_;
  const int dofs = 2 * static_cast<int>(mesh.nodes.size());
  p.unknown.assign(dofs, 0);
  p.value.assign(dofs, 0);
  for (const auto& support : problem_.supports)
    for (const auto& side : sides_on(mesh, support.line, "support"))
      for (const int n : {side.a, side.middle, side.b})
        for (int k = 0; k < 2; ++k)
          if (const auto& fixed = k == 0 ? support.x : support.y)
            p.unknown[2 * n + k] = -1, p.value[2 * n + k] = *fixed;
  for (int& u : p.unknown)
    if (u == 0) u = p.count++;
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < 12; ++j) {
        const int row = p.unknown[2 * t[i / 2] + i % 2], column = p.unknown[2 * t[j / 2] + j % 2];
        if (row >= 0 && column >= 0) entries.emplace_back(row, column, 0.0);
      }
  p.matrix.resize(p.count, p.count);
  p.matrix.setFromTriplets(entries.begin(), entries.end());
  p.matrix.makeCompressed();
  p.slot.reserve(144 * mesh.triangles.size());
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < 12; ++j) {
        const int row = p.unknown[2 * t[i / 2] + i % 2], column = p.unknown[2 * t[j / 2] + j % 2];
        p.slot.push_back(
            row < 0 || column < 0 ? -1 : static_cast<int>(&p.matrix.coeffRef(row, column) - p.matrix.valuePtr()));
      }
  p.tangent = p.matrix;
  p.elastic = p.matrix;
  const auto strength = strengths(1);
  for (std::size_t e = 0; e < mesh.triangles.size(); ++e) {
    FemStrength elastic = strength[mesh.region[e]];
    elastic.elastic = true;
    for (int g = 0; g < 3; ++g)
      add_stiffness(points_[3 * e + g], update_stress(elastic, {}, Eigen::Vector3d::Zero()).tangent, &p.slot[144 * e],
                    p.elastic.valuePtr());
  }
  p.linear.analyse(p.elastic);
  p.elastic_factor.compute(p.elastic);
  for (const auto& load : problem_.loads) sides_on(mesh, load.line, "load");
}

std::vector<FemStrength> FemSolver::strengths(double factor, bool associated) const {
  std::vector<FemStrength> all;
  for (const auto& m : problem_.materials) {
    const double f = m.keeps_strength ? 1 : factor;
    const double phi = std::atan(std::tan(m.friction_angle) / f),
                 sine = std::sin(associated ? phi : std::min(m.dilation_angle, phi));
    all.push_back({Elasticity::from_young(m.young_modulus, m.poisson_ratio),
                   mohr_coulomb_strength(m.cohesion / f, phi, m.tension_strength / f), (1 + sine) / (1 - sine),
                   m.elastic});
  }
  return all;
}

FemState FemSolver::unstressed() const {
  const std::size_t points = points_.size();
  return {std::vector<double>(2 * problem_.mesh->nodes.size(), 0.0),
          std::vector<std::array<double, 4>>(points, {0, 0, 0, 0}), std::vector<double>(points, 0.0)};
}

Eigen::VectorXd FemSolver::external(const FemAction& action) const {
  const Mesh& mesh = *problem_.mesh;
  Eigen::VectorXd f = Eigen::VectorXd::Zero(2 * mesh.nodes.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const FemPoint& point = points_[i];
    const auto& t = mesh.triangles[i / 3];
    const FemMaterial& m = problem_.materials[mesh.region[i / 3]];
    const double p = value_at(mesh, action.pore_pressure, static_cast<int>(i / 3), point.weight);
    const double s = action.pore_pressure.empty() ? 0.0 : saturation(m.retention, -p);
    const double weight = action.weight * (m.dry_unit_weight + m.porosity * s * problem_.water_unit_weight);
    const double carried = p >= 0 ? p : problem_.suction ? s * p : 0.0;
    const auto n = shape(point.weight);
    for (int a = 0; a < 6; ++a) {
      const Eigen::Index at = Eigen::Index{2} * t[a];
      f[at] += point.volume * point.gradient[a][0] * carried;
      f[at + 1] += point.volume * (point.gradient[a][1] * carried - n[a] * weight);
    }
  }
  const auto press = [&](const MeshEdge& side, const std::array<Point2, 3>& traction) {
    const Point2 &a = mesh.nodes[side.a], &b = mesh.nodes[side.b];
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    // ∫ N_i N_j ds over a quadratic side, times 30/length.
    constexpr std::array<std::array<double, 3>, 3> mass{{{4, 2, -1}, {2, 16, 2}, {-1, 2, 4}}};
    const std::array<int, 3> nodes{side.a, side.middle, side.b};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 2; ++k) f[2 * nodes[i] + k] += length / 30 * mass[i][j] * traction[j][k];
  };
  for (const auto& load : problem_.loads) {
    const Point2 t{load.traction[0] * action.load, load.traction[1] * action.load};
    for (const auto& side : sides_on(mesh, load.line, "load")) press(side, {t, t, t});
  }
  if (!action.pore_pressure.empty())  // water that stands against the outline
    for (const auto& side : outline(mesh)) {
      const Point2 &a = mesh.nodes[side.a], &b = mesh.nodes[side.b];
      const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
      std::array<Point2, 3> traction{};
      const std::array<int, 3> nodes{side.a, side.middle, side.b};
      for (int i = 0; i < 3; ++i) {
        const double p = std::max(action.pore_pressure[nodes[i]], 0.0);
        traction[i] = {-p * (b[1] - a[1]) / length, p * (b[0] - a[0]) / length};
      }
      press(side, traction);
    }
  return f;
}

Eigen::VectorXd FemSolver::internal(const FemState& state) const {
  const Mesh& mesh = *problem_.mesh;
  Eigen::VectorXd f = Eigen::VectorXd::Zero(2 * mesh.nodes.size());
  for (std::size_t i = 0; i < points_.size(); ++i) add_internal(points_[i], mesh.triangles[i / 3], state.stress[i], f);
  return f;
}

Point2 FemSolver::reaction(const FemState& state, const FemAction& action, std::span<const Point2> line) const {
  const Eigen::VectorXd r = internal(state) - external(action);
  const Mesh& mesh = *problem_.mesh;
  std::vector<bool> counted(mesh.nodes.size(), false);
  Point2 sum{0, 0};
  for (const auto& side : sides_on(mesh, {line.begin(), line.end()}, "line of a reaction"))
    for (const int n : {side.a, side.middle, side.b}) {
      if (counted[n]) continue;
      counted[n] = true;
      for (int k = 0; k < 2; ++k)
        if (pattern_->unknown[2 * n + k] < 0) sum[k] += r[2 * n + k];
    }
  return sum;
}

std::vector<double> FemSolver::deviatoric_strain(std::span<const double> displacement) const {
  std::vector<double> out;
  for (std::size_t i = 0; i < points_.size(); ++i)
    out.push_back(polder::deviatoric_strain(strain(points_[i], problem_.mesh->triangles[i / 3], displacement)));
  return out;
}

FemOutcome FemSolver::solve(FemState& state, const FemAction& action, const FemOptions& options) const {
  const Mesh& mesh = *problem_.mesh;
  const Pattern& p = *pattern_;
  const auto strength = strengths(action.strength_factor, action.associated);
  const Eigen::VectorXd outer = external(action);
  const int dofs = static_cast<int>(outer.size());
  const std::vector<std::array<double, 4>> start = state.stress;
  const std::vector<double> before = state.displacement;
  std::vector<double> increment(dofs, 0.0);
  Eigen::VectorXd inner(dofs);
  std::vector<Eigen::Matrix3d> tangent(points_.size());

  /// Stress, internal force and point tangents for a displacement increment of the step.
  const auto evaluate = [&](const std::vector<double>& u) {
    inner.setZero();
    for (std::size_t e = 0; e < mesh.triangles.size(); ++e)
      for (std::size_t i = 3 * e; i < 3 * e + 3; ++i) {
        const FemPoint& point = points_[i];
        const FemStress now = update_stress(strength[mesh.region[e]], start[i], strain(point, mesh.triangles[e], u));
        state.stress[i] = now.stress;
        tangent[i] = now.tangent;
        add_internal(point, mesh.triangles[e], now.stress, inner);
      }
  };
  const auto assemble = [&](double share) {
    for (int k = 0; k < p.tangent.nonZeros(); ++k) p.tangent.valuePtr()[k] = share * p.elastic.valuePtr()[k];
    for (std::size_t i = 0; i < points_.size(); ++i)
      add_stiffness(points_[i], (1 - share) * tangent[i], &p.slot[144 * (i / 3)], p.tangent.valuePtr());
  };
  const auto unbalance = [&] {
    Eigen::VectorXd r(p.count);
    for (int d = 0; d < dofs; ++d)
      if (p.unknown[d] >= 0) r[p.unknown[d]] = outer[d] - inner[d];
    return r;
  };
  /// What drives the step: loads, or the forces that hold prescribed displacements.
  const auto driving = [&] {
    double held = 0;
    for (int d = 0; d < dofs; ++d)
      if (p.unknown[d] < 0) held += std::pow(inner[d] - outer[d], 2);
    return std::max({outer.norm(), std::sqrt(held), 1e-12});
  };

  std::vector<double> imposed(dofs, 0.0);
  bool moves = false;
  for (int d = 0; d < dofs; ++d)
    if (p.unknown[d] < 0) {
      imposed[d] = p.value[d] * action.load - before[d];
      moves = moves || imposed[d] != 0;
    }

  FemOutcome outcome;
  /// Energy that the out-of-balance forces would set free in the elastic ground: falls steadily towards equilibrium.
  const auto energy = [&](const Eigen::VectorXd& r) { return r.dot(p.elastic_factor.solve(r)); };

  evaluate(increment);
  std::array<double, 4> recent{};
  double elastic_share = first_share;
  double best = no_limit;
  int since_best = 0;
  for (outcome.iterations = 1; outcome.iterations <= options.iterations; ++outcome.iterations) {
    Eigen::VectorXd r = unbalance();
    const bool pushes = moves && outcome.iterations == 1;
    if (pushes) {
      // The prescribed movement enters with the tangent, so that the first strains spread into the ground.
      Eigen::VectorXd pushed = Eigen::VectorXd::Zero(dofs);
      for (std::size_t i = 0; i < points_.size(); ++i) {
        const Eigen::Vector3d s = tangent[i] * strain(points_[i], mesh.triangles[i / 3], imposed);
        add_internal(points_[i], mesh.triangles[i / 3], {s[0], s[1], 0, s[2]}, pushed);
      }
      for (int d = 0; d < dofs; ++d)
        if (p.unknown[d] >= 0) r[p.unknown[d]] -= pushed[d];
    }
    // Non-associated flow need not fall at every step: it has to stay below the worst of the last few (Grippo 1986).
    if (!pushes) recent[outcome.iterations % recent.size()] = energy(r);
    const double ceiling = *std::max_element(recent.begin(), recent.end());
    assemble(elastic_share);
    p.linear.factorise(p.tangent);
    const Eigen::VectorXd change = p.linear.solve(r);
    if (!change.allFinite()) break;
    const std::vector<double> base = increment;
    double share = 1;
    bool falls = false;
    for (int cut = 0; cut < 3 && !falls; ++cut, share /= 2) {
      for (int d = 0; d < dofs; ++d)
        increment[d] = base[d] + (p.unknown[d] >= 0 ? share * change[p.unknown[d]] : pushes ? imposed[d] : 0.0);
      evaluate(increment);
      falls = pushes || energy(unbalance()) < ceiling;
    }
    if (!falls) {
      increment = base;
      evaluate(increment);
    }
    outcome.residual = unbalance().norm() / driving();
    if (outcome.residual < options.tolerance) {
      outcome.converged = true;
      break;
    }
    if (falls && share == 0.5)
      elastic_share = std::max(elastic_share / 4, least_share);
    else
      elastic_share = std::min(elastic_share * (falls ? 3 : 10), largest_share);
    const double now = energy(unbalance());
    if (now < 0.8 * best)
      best = now, since_best = 0;
    else if (++since_best >= 20 && options.stop_early)
      break;
  }

  for (int d = 0; d < dofs; ++d) state.displacement[d] = before[d] + increment[d];
  for (std::size_t x = 0; x + 1 < increment.size(); x += 2)
    outcome.largest_displacement = std::max(outcome.largest_displacement, std::hypot(increment[x], increment[x + 1]));
  if (outcome.converged)
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const double shear = strength[mesh.region[i / 3]].elasticity.shear;
      state.plastic_shear[i] +=
          plastic_distortion(strain(points_[i], mesh.triangles[i / 3], increment), start[i], state.stress[i], shear);
    }
  return outcome;
}

}  // namespace polder
