#include "polder/seepage/flow.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "polder/seepage/flow_results.hpp"
#include "polder/seepage/mesher.hpp"

namespace {

using namespace polder;

/// Nearly a step: conducts below the water table only, as the closed-form solutions of unconfined flow assume.
FlowMaterial sharp(double k, double height) {
  FlowMaterial m;
  m.conductivity = {k, k};
  m.retention = LinearRetention{1 / (9810 * height), 0};
  m.curve = TableConductivity{{{0, 1}, {1e-4, 1}}};
  return m;
}

FlowMaterial saturated(double k) {
  FlowMaterial m;
  m.conductivity = {k, k};
  m.curve = ConstantConductivity{};
  return m;
}

// A13: a sheet pile s deep in a layer of thickness T, head difference H; exact by conformal mapping (Polubarinova-
// Kochina 1962).
struct PileCase {
  double s_over_t, flow, gradient, head;
};
class SheetPile : public testing::TestWithParam<PileCase> {};

TEST_P(SheetPile, MatchesTheConformalSolution) {
  const PileCase c = GetParam();
  const double thickness = 10, s = c.s_over_t * thickness, drop = 4, reach = 6 * thickness;
  MeshRequest request;
  request.polygons = {{{-reach, -thickness}, {reach, -thickness}, {reach, 0}, {-reach, 0}}};
  request.cuts = {{{0, 0}, {0, -s}}};
  request.size = 3;
  request.growth = 0.12;
  request.finer = {{{0, -s}, 0.02}, {{0, 0}, 0.1}};
  const Mesh mesh = make_mesh(request);
  FlowProblem problem{&mesh, {saturated(1e-4)}, {}, 9810};
  problem.boundaries.resize(2);
  problem.boundaries[0] = {"outside", FlowCondition::head, {{-reach, 0}, {0, 0}}, Table::constant(drop), {}, {}, true};
  problem.boundaries[1] = {"inside", FlowCondition::head, {{0, 0}, {reach, 0}}, Table::constant(0), {}, {}, true};
  const FlowSolver solver(problem);
  const FlowState state = solver.steady(0);
  const double q = discharge(solver, state, 1);
  EXPECT_NEAR(q / (1e-4 * drop) / c.flow, 1, 0.01);
  EXPECT_NEAR(q + discharge(solver, state, 0), 0, 1e-9 * q);

  const ExitFlow exit = exit_flow(solver, state, 1);
  double at_wall = 0;
  for (std::size_t i = 0; i < exit.at.size(); ++i)
    if (std::abs(exit.at[i][0]) < 1e-9) at_wall = exit.gradient[i];
  EXPECT_NEAR(at_wall * s / drop / c.gradient, 1, 0.01);

  // Mean excess head on the base of Terzaghi's prism, s/2 wide at the depth of the toe.
  double mean = 0;
  const MeshLocator locator(mesh);
  const int samples = 2000;
  for (int i = 0; i < samples; ++i)
    mean += interpolate(mesh, state.head, locator.find({(i + 0.5) / samples * s / 2 + 1e-7, -s})) / samples;
  EXPECT_NEAR(mean / drop / c.head, 1, 0.01);
  // From the base round the toe, off its singular point, to the wall.
  const std::vector<Point2> section{{0, -thickness}, {s / 4, -s}, {0, -s / 2}};
  EXPECT_NEAR(std::abs(discharge_through(solver, state, section)) / q, 1, 0.01);
}
INSTANTIATE_TEST_SUITE_P(A13, SheetPile,
                         testing::Values(PileCase{.2, .80717, .31564, .35225}, PileCase{.4, .57803, .30691, .34647},
                                         PileCase{.5, .50000, .29954, .34136}));

// A13: half a cofferdam, half-width b, the inside dug e below the outer ground, wall s below the inside.
struct CofferdamCase {
  double b, e, flow, gradient, head;
};
class Cofferdam : public testing::TestWithParam<CofferdamCase> {};

TEST_P(Cofferdam, MatchesTheReference) {
  const CofferdamCase c = GetParam();
  const double t = 1, s = 0.5, b = c.b * t, e = c.e * t, drop = 1, reach = 6;
  MeshRequest request;
  request.polygons = {{{0, 0}, {b, 0}, {b + reach, 0}, {b + reach, t + e}, {b, t + e}, {b, t}, {0, t}}};
  request.cuts = {{{b, t}, {b, t - s}}};
  request.size = 0.3;
  request.growth = 0.12;
  request.finer = {{{b, t - s}, 0.002}, {{b, t}, 0.01}};
  const Mesh mesh = make_mesh(request);
  FlowProblem problem{&mesh, {saturated(1)}, {}, 9810};
  problem.boundaries.resize(2);
  problem.boundaries[0] = {
      "outside", FlowCondition::head, {{b, t + e}, {b + reach, t + e}}, Table::constant(t + e + drop), {}, {}, true};
  problem.boundaries[1] = {"inside", FlowCondition::head, {{0, t}, {b, t}}, Table::constant(t + e), {}, {}, true};
  if (e > 0) problem.boundaries[1].head = Table::constant(t), problem.boundaries[0].head = Table::constant(t + drop);
  const FlowSolver solver(problem);
  const FlowState state = solver.steady(0);
  EXPECT_NEAR(discharge(solver, state, 1) / drop / c.flow, 1, 0.01);
  const ExitFlow exit = exit_flow(solver, state, 1);
  double at_wall = 0;
  for (std::size_t i = 0; i < exit.at.size(); ++i)
    if (std::abs(exit.at[i][0] - b) < 1e-9) at_wall = exit.gradient[i];
  EXPECT_NEAR(at_wall * s / drop / c.gradient, 1, 0.01);
  double mean = 0;
  const MeshLocator locator(mesh);
  for (int i = 0; i < 2000; ++i)
    mean += (interpolate(mesh, state.head, locator.find({b - (i + 0.5) / 2000 * s / 2, t - s})) -
             problem.boundaries[1].head(0)) /
            2000;
  EXPECT_NEAR(mean / drop / c.head, 1, 0.01);
}
INSTANTIATE_TEST_SUITE_P(A13, Cofferdam,
                         testing::Values(CofferdamCase{.5, 0, .4041, .4228, .4442},
                                         CofferdamCase{.25, 0, .2870, .5749, .5740},
                                         CofferdamCase{1, .5, .4233, .2861, .3191}));

TEST(Dupuit, DischargeThroughARectangularDamIsExact) {
  // Charny: Q = K (h1² − h2²)/2L holds exactly in spite of the seepage face.
  const double length = 4, h1 = 3, h2 = 0.5, k = 1e-3;
  MeshRequest request;
  request.polygons = {{{0, 0}, {length, 0}, {length, 3.3}, {0, 3.3}}};
  request.size = 0.09;
  request.finer = {{{length, 0.5}, 0.04}, {{length, 1.2}, 0.04}};
  const Mesh mesh = make_mesh(request);
  FlowProblem problem{&mesh, {sharp(k, 0.02)}, {}, 9810};
  problem.boundaries.resize(2);
  problem.boundaries[0] = {"upstream", FlowCondition::head, {{0, 0}, {0, 3.3}}, Table::constant(h1), {}, {}, true};
  problem.boundaries[1] = {"downstream", FlowCondition::head, {{length, 0}, {length, 3.3}}, Table::constant(h2), {}, {},
                           true};
  const FlowSolver solver(problem);
  const FlowState state = solver.steady(0);
  const double exact = k * (h1 * h1 - h2 * h2) / (2 * length);
  EXPECT_NEAR(discharge(solver, state, 1) / exact, 1, 0.01);
  const std::vector<Point2> section{{2, 0}, {2, 3.3}};
  EXPECT_NEAR(discharge_through(solver, state, section) / -exact, -1, 0.01);
  // The seepage face exists: water leaves above the tail water, and the table meets the face there.
  double top = 0;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (state.exit[n]) top = std::max(top, mesh.nodes[n][1]);
  EXPECT_GT(top, h2 + 0.2);
  EXPECT_NEAR(*phreatic_height(solver, state, length - 0.02), top, 0.1);
  // Twice the conductivity everywhere, the same heads: twice the discharge.
  FlowSolver faster(problem);
  faster.scale_conductivity(std::vector<double>(mesh.triangles.size(), 2.0));
  const FlowState doubled = faster.steady(0);
  EXPECT_NEAR(discharge(faster, doubled, 1), 2 * discharge(solver, state, 1), 1e-6 * exact);
  EXPECT_NEAR(discharge_through(faster, doubled, section), 2 * discharge_through(solver, state, section), 1e-6 * exact);
}

TEST(PhreaticHeight, IsTheLevelOfTheWaterWhereTheGroundIsSaturatedOrUnderIt) {
  MeshRequest request;
  request.polygons = {{{0, 0}, {4, 0}, {4, 1}, {2, 1}, {0, 2}}};
  request.size = 0.2;
  const Mesh mesh = make_mesh(request);
  const FlowSolver closed({&mesh, {sharp(1e-3, 0.02)}, {}, 9810});
  EXPECT_NEAR(*phreatic_height(closed, closed.hydrostatic(1.5), 3), 1.0, 1e-9);  // under pressure, but no water on it
  EXPECT_NEAR(*phreatic_height(closed, closed.hydrostatic(1.0), 3), 1.0, 1e-9);
  EXPECT_NEAR(*phreatic_height(closed, closed.hydrostatic(1.5), 0.4), 1.5, 0.02);
  EXPECT_FALSE(phreatic_height(closed, closed.hydrostatic(-1), 3));
  FlowProblem problem{&mesh, {sharp(1e-3, 0.02)}, {}, 9810};
  problem.boundaries = {{"pond", FlowCondition::head, {{4, 1}, {2, 1}}, Table::constant(1.5), {}, {}, true}};
  const FlowSolver pond(problem);
  EXPECT_NEAR(*phreatic_height(pond, pond.hydrostatic(1.5), 3), 1.5, 1e-9);  // half a metre of water
}

TEST(Infiltration, FollowsSrivastavaAndYeh) {
  // A9, lengths in m, time in s; ψ in cm at z above the water table.
  const double ks = 0.01 / 3600, alpha = 10;
  MeshRequest request;
  request.polygons = {{{0, 0}, {0.05, 0}, {0.05, 1}, {0, 1}}};
  request.size = 0.025;
  const Mesh mesh = make_mesh(request);
  FlowMaterial soil;
  soil.conductivity = {ks, ks};
  soil.porosity = 0.40;
  soil.retention = GardnerRetention{alpha / 9810, 0.06 / 0.40, 1};
  soil.curve = GardnerConductivity{alpha / 9810};
  FlowProblem problem{&mesh, {soil}, {}, 9810};
  problem.boundaries.resize(2);
  problem.boundaries[0] = {"table", FlowCondition::head, {{0, 0}, {0.05, 0}}, Table::constant(0), {}, {}, true};
  problem.boundaries[1] = {"rain", FlowCondition::rain, {{0, 1}, {0.05, 1}}, {}, {}, Table::constant(0.1 * ks), true};
  FlowState state = FlowSolver(problem).steady(0);
  problem.boundaries[1].rate = Table::constant(0.9 * ks);
  const FlowSolver solver(problem);
  const MeshLocator locator(mesh);
  const std::array<double, 4> heights{.25, .5, .75, .99999};
  const std::array<std::array<double, 5>, 3> reference{{{5, -17.489, -21.523, -12.802, -3.066},
                                                        {10, -16.499, -14.190, -6.179, -1.913},
                                                        {30, -4.172, -2.652, -1.539, -1.129}}};
  FlowOptions options;
  options.longest_step = 150;
  for (const auto& row : reference) {
    const FlowTally tally = solver.advance(state, row[0] * 3600, options);
    EXPECT_NEAR(tally.inflow, tally.storage, 1e-6 * std::abs(tally.storage) + 1e-12);
    for (int i = 0; i < 4; ++i) {
      const double head = interpolate(mesh, state.head, locator.find({0.025, heights[i]}));
      EXPECT_NEAR((head - heights[i]) * 100 / row[1 + i], 1, 0.02) << "t " << row[0] << " h, z " << heights[i];
    }
  }
}

TEST(Flow, RainPondsWhenTheSoilCannotTakeIt) {
  MeshRequest request;
  request.polygons = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  request.size = 0.1;
  const Mesh mesh = make_mesh(request);
  FlowMaterial soil;
  soil.retention = van_genuchten(3, 2, 0, 1, 9810);
  FlowProblem problem{&mesh, {soil}, {}, 9810};
  problem.boundaries.resize(2);
  problem.boundaries[0] = {"drain", FlowCondition::head, {{0, 0}, {1, 0}}, Table::constant(0), {}, {}, true};
  problem.boundaries[1] = {"rain", FlowCondition::rain, {{0, 1}, {1, 1}}, {}, {}, Table::constant(5e-5), true};
  const FlowSolver solver(problem);
  const FlowState state = solver.steady(0);
  EXPECT_NEAR(discharge(solver, state, 0), 1e-5, 1e-9);  // unit gradient through saturated soil
}

TEST(Flow, RefusesABoundaryOffTheOutline) {
  MeshRequest request;
  request.polygons = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  const Mesh mesh = make_mesh(request);
  FlowProblem problem{&mesh, {saturated(1)}, {}, 9810};
  problem.boundaries = {{"river", FlowCondition::head, {{2, 0}, {2, 1}}, Table::constant(1), {}, {}, true}};
  EXPECT_THROW(FlowSolver{problem}, std::invalid_argument);
}

}  // namespace
