#include "polder/stability/fem_strength_reduction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "polder/seepage/flow_results.hpp"
#include "polder/seepage/mesher.hpp"

namespace {

using namespace polder;
constexpr double degree = std::numbers::pi / 180;

FemMaterial soil(double cohesion_kpa, double phi_degrees, double weight_kn) {
  FemMaterial m;
  m.young_modulus = 1e8;
  m.poisson_ratio = 0.3;
  m.cohesion = cohesion_kpa * 1e3;
  m.friction_angle = phi_degrees * degree;
  m.dry_unit_weight = weight_kn * 1e3;
  return m;
}

StrengthReductionResult slope(const std::vector<std::vector<Point2>>& polygons,
                              const std::vector<FemMaterial>& materials, double size) {
  MeshRequest request;
  request.polygons = polygons;
  request.size = size;
  const Mesh mesh = make_mesh(request);
  double left = 1e300, right = -1e300, base = 1e300, top_left = -1e300, top_right = -1e300;
  for (const auto& p : mesh.nodes)
    left = std::min(left, p[0]), right = std::max(right, p[0]), base = std::min(base, p[1]);
  for (const auto& p : mesh.nodes) {
    if (p[0] == left) top_left = std::max(top_left, p[1]);
    if (p[0] == right) top_right = std::max(top_right, p[1]);
  }
  FemProblem problem;
  problem.mesh = &mesh;
  problem.materials = materials;
  problem.supports = {{{{left, base}, {right, base}}, 0.0, 0.0}, {{{right, base}, {right, top_right}}, 0.0, {}}};
  if (top_left > base) problem.supports.push_back({{{left, base}, {left, top_left}}, 0.0, {}});
  const FemSolver solver(problem);
  const auto result = strength_reduction(solver, solver.unstressed(), {});
  return result;
}

TEST(StrengthReduction, GriffithsAndLanesFirstSlope) {
  const auto r = slope({{{0, 0}, {50, 0}, {50, 10}, {32, 10}, {12, 0}}}, {soil(10, 20, 20)}, 1);
  EXPECT_NEAR(r.factor / 1.40, 1, 0.05) << r.factor;
}

TEST(StrengthReduction, Acads1a) {
  const auto r = slope({{{20, 20}, {70, 20}, {70, 35}, {50, 35}, {30, 25}, {20, 25}}}, {soil(3, 19.6, 20)}, 1);
  EXPECT_NEAR(r.factor / 0.99, 1, 0.05);
}

TEST(StrengthReduction, Acads1c) {
  const auto r = slope({{{30, 25}, {50, 29}, {54, 31}, {70, 31}, {70, 35}, {50, 35}},
                        {{30, 25}, {40, 27}, {52, 24}, {70, 24}, {70, 31}, {54, 31}, {50, 29}},
                        {{20, 20}, {70, 20}, {70, 24}, {52, 24}, {40, 27}, {30, 25}, {20, 25}}},
                       {soil(0, 38, 19.5), soil(5.3, 23, 19.5), soil(7.2, 20, 19.5)}, 1);
  EXPECT_NEAR(r.factor / 1.36, 1, 0.05);
}

// The levee lifted at its toe, outline frozen, against an independent computation: steady seepage from a base pressure
// that falls linearly to 82 kPa at x = 50 m, no suction, riverside slope fixed.
class Levee : public testing::TestWithParam<std::pair<double, double>> {};

TEST_P(Levee, AgreesWithTheIndependentComputation) {
  const auto [pressure, reference] = GetParam();
  MeshRequest request;
  request.polygons = {{{0, 0}, {31, 0}, {14.6, 7.2}, {11, 7.2}},
                      {{0, -3.6}, {50, -3.6}, {50, 0}, {0, 0}},
                      {{0, -5.96}, {50, -5.96}, {50, -3.6}, {0, -3.6}}};
  request.size = 0.9;
  const Mesh mesh = make_mesh(request);

  FlowMaterial clay_flow, sand_flow;
  clay_flow.conductivity = {7.44e-5, 7.44e-5};
  sand_flow.conductivity = {7.44e-3, 7.44e-3};
  clay_flow.retention = LinearRetention{4e-7, 0};
  sand_flow.retention = LinearRetention{6e-6, 0};
  clay_flow.curve = sand_flow.curve = ConstantConductivity{};
  FlowBoundary base, land;
  base.condition = FlowCondition::head;
  base.line = {{0, -5.96}, {50, -5.96}};
  base.head = Table::constant(pressure * 1e3 / 9810 - 5.96);
  base.head_at_end = Table::constant(82e3 / 9810 - 5.96);
  land.line = {{50, 0}, {31, 0}, {14.6, 7.2}, {11, 7.2}};
  const FlowSolver flow({&mesh, {clay_flow, clay_flow, sand_flow}, {base, land}, 9810});
  FemAction action;
  action.pore_pressure = pore_pressure(flow, flow.steady(0));

  FemMaterial clay = soil(10, 22, 0.7 * 2542 * 9.81e-3), sand = soil(0, 37, 0.645 * 2610 * 9.81e-3);
  clay.young_modulus = 5.52e6;
  clay.poisson_ratio = 0.15;
  clay.porosity = 0.3;
  clay.retention = clay_flow.retention;
  sand.young_modulus = 55.86e6;
  sand.poisson_ratio = 0.33;
  sand.porosity = 0.355;
  sand.retention = sand_flow.retention;
  FemProblem problem;
  problem.mesh = &mesh;
  problem.materials = {clay, clay, sand};
  problem.supports = {{{{0, -5.96}, {50, -5.96}}, 0.0, 0.0},
                      {{{0, -5.96}, {0, 0}}, 0.0, {}},
                      {{{50, -5.96}, {50, 0}}, 0.0, {}},
                      {{{0, 0}, {11, 7.2}}, 0.0, 0.0}};
  const FemSolver solver(problem);
  const auto result = strength_reduction(solver, solver.unstressed(), action);
  ASSERT_TRUE(result.found);
  RecordProperty("factor", std::to_string(result.factor));
  EXPECT_NEAR(result.factor / reference, 1, 0.03) << result.factor;
}
INSTANTIATE_TEST_SUITE_P(Phases, Levee,
                         testing::Values(std::pair{82.0, 1.38}, std::pair{102.0, 1.23}, std::pair{112.0, 1.15},
                                         std::pair{122.0, 1.05}));

}  // namespace
