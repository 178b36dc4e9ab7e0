#include "polder/stability/fem_strength_reduction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "polder/seepage/flow_results.hpp"
#include "polder/seepage/mesher.hpp"
#include "polder/stability/section_strength_reduction.hpp"
#include "reference_slopes.hpp"

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

double factor(stability::Section section) {
  const auto reduction = stability::reduce_strength(stability::prepare(std::move(section)));
  EXPECT_EQ(reduction.problem, "");
  return reduction.result.factor;
}

TEST(StrengthReduction, GriffithsAndLanesFirstSlope) {
  EXPECT_NEAR(factor(stability::testing::griffiths_lane_1()) / 1.40, 1, 0.05);
}

TEST(StrengthReduction, Acads1a) { EXPECT_NEAR(factor(stability::testing::acads_1a()) / 0.99, 1, 0.05); }

TEST(StrengthReduction, Acads1c) { EXPECT_NEAR(factor(stability::testing::acads_1c()) / 1.36, 1, 0.05); }

TEST(StrengthReduction, SaysWhatItCannotTake) {
  stability::Section section = stability::testing::acads_1a();
  section.earthquake.horizontal = 0.1;
  EXPECT_NE(stability::reduce_strength(stability::prepare(section)).problem, "");
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
  request.size = 0.6;
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
  const auto result = strength_reduction(solver, solver.k0(action, [](int) { return 0.5; }), action);
  ASSERT_TRUE(result.found);
  RecordProperty("factor", std::to_string(result.factor));
  EXPECT_NEAR(result.factor / reference, 1, 0.03) << result.factor;
}
INSTANTIATE_TEST_SUITE_P(Phases, Levee,
                         testing::Values(std::pair{82.0, 1.38}, std::pair{102.0, 1.23}, std::pair{112.0, 1.15}));

}  // namespace
