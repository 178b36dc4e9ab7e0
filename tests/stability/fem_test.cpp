#include "polder/stability/fem_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "polder/seepage/mesher.hpp"

namespace {

using namespace polder;
constexpr double degree = std::numbers::pi / 180;

TEST(FemSolver, ACylinderAtConstantVolumeDoesNotLock) {
  // A thick cylinder under inner pressure, ν = 0.4999: u(a) = (1 + ν) p a² [(1 − 2ν) a + b²/a] / (E (b² − a²)).
  const double a = 1, b = 3, young = 1e7, nu = 0.4999, p = 1e4;
  MeshRequest request;
  std::vector<Point2> outer, inner;
  const int parts = 32;
  for (int i = 0; i <= parts; ++i) {
    const double angle = i * std::numbers::pi / 2 / parts;
    inner.push_back({a * std::cos(angle), a * std::sin(angle)});
    outer.push_back({b * std::cos(angle), b * std::sin(angle)});
  }
  std::vector<Point2> ring = outer;
  ring.insert(ring.end(), inner.rbegin(), inner.rend());
  request.polygons = {ring};
  request.size = 0.3;
  const Mesh mesh = make_mesh(request);
  FemMaterial m;
  m.young_modulus = young;
  m.poisson_ratio = nu;
  m.elastic = true;
  FemProblem problem;
  problem.mesh = &mesh;
  problem.materials = {m};
  problem.supports = {{{{a, 0}, {b, 0}}, {}, 0.0}, {{{0, a}, {0, b}}, 0.0, {}}};
  for (int i = 0; i < parts; ++i) {
    const double angle = (i + 0.5) * std::numbers::pi / 2 / parts;
    problem.loads.push_back({{inner[i], inner[i + 1]}, {p * std::cos(angle), p * std::sin(angle)}});
  }
  const FemSolver solver(problem);
  FemState state = solver.unstressed();
  EXPECT_TRUE(solver.solve(state, {}).converged);
  const double exact = (1 + nu) * p * a * a * ((1 - 2 * nu) * a + b * b / a) / (young * (b * b - a * a));
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (std::abs(std::hypot(mesh.nodes[n][0], mesh.nodes[n][1]) - a) < 1e-9) {
      EXPECT_NEAR(std::hypot(state.displacement[2 * n], state.displacement[2 * n + 1]) / exact, 1, 0.01);
    }
}

TEST(FemSolver, K0StressOfLevelGroundIsInEquilibrium) {
  MeshRequest request;
  request.polygons = {{{0, 4}, {10, 4}, {10, 10}, {0, 10}}, {{0, 0}, {10, 0}, {10, 4}, {0, 4}}};
  request.size = 1;
  const Mesh mesh = make_mesh(request);
  FemMaterial top, base;
  top.dry_unit_weight = 16e3;
  base.dry_unit_weight = 15e3;
  base.porosity = 0.4;
  base.friction_angle = top.friction_angle = 30 * degree;
  base.cohesion = top.cohesion = 1e3;
  FemProblem problem;
  problem.mesh = &mesh;
  problem.materials = {top, base};
  problem.supports = {{{{0, 0}, {10, 0}}, 0.0, 0.0}, {{{0, 0}, {0, 10}}, 0.0, {}}, {{{10, 0}, {10, 10}}, 0.0, {}}};
  FemAction action;
  for (const auto& p : mesh.nodes) action.pore_pressure.push_back(9810 * (4 - p[1]));
  const FemSolver solver(problem);
  FemState state = solver.k0(action, [](int) { return 0.5; });
  const FemOutcome outcome = solver.solve(state, action, {1e-6, 30, true});
  EXPECT_TRUE(outcome.converged);
  EXPECT_LT(outcome.largest_displacement, 1e-6);
  double worst = 0;
  for (std::size_t i = 0; i < state.stress.size(); ++i) {
    const double y = solver.points()[i].position[1];
    const double exact = y > 4 ? -16e3 * (10 - y) : -16e3 * 6 - (15e3 + 0.4 * 9810 - 9810) * (4 - y);
    worst = std::max(worst, std::abs(state.stress[i][1] - exact));
  }
  EXPECT_LT(worst, 50);  // 0.05 % of the largest
}

}  // namespace
