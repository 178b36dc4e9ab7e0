#include <gtest/gtest.h>

#include "polder/seepage/mesher.hpp"
#include "polder/stability/fem_loading.hpp"

namespace {

using namespace polder;

/// Bearing pressure over cohesion of a rough rigid strip, half of it by symmetry, pressed into undrained ground.
TEST(Footing, BearsPrandtlsLoad) {
  const double c = 100, half = 1;
  MeshRequest request;
  request.polygons = {{{0, 0}, {6, 0}, {6, 4}, {0, 4}}};
  request.lines = {{{0, 4}, {half, 4}}};
  request.size = 0.4;
  request.growth = 0.15;
  request.finer = {{{half, 4}, 0.02}};
  request.polygons[0] = {{0, 0}, {6, 0}, {6, 4}, {half, 4}, {0, 4}};
  const Mesh mesh = make_mesh(request);
  FemMaterial m;
  m.young_modulus = 1e5;
  m.poisson_ratio = 0.49;
  m.cohesion = c;
  FemProblem problem;
  problem.mesh = &mesh;
  problem.materials = {m};
  const double settlement = 0.03 * half;
  problem.supports = {{{{0, 0}, {6, 0}}, 0.0, 0.0},
                      {{{0, 0}, {0, 4}}, 0.0, {}},
                      {{{6, 0}, {6, 4}}, 0.0, {}},
                      {{{0, 4}, {half, 4}}, 0.0, -settlement}};
  const FemSolver solver(problem);
  FemState state = solver.unstressed();
  const auto bearing = [&](const FemAction& action) {
    return -solver.reaction(state, action, std::vector<Point2>{{0, 4}, {half, 4}})[1] / (half * c);
  };
  FemAction none, most, full;
  none.load = 0;
  most.load = 0.8;
  LoadingOptions options;
  options.first = 0.05;
  ASSERT_TRUE(load_in_steps(solver, state, none, most, options).reached);
  const double before = bearing(most);
  ASSERT_TRUE(load_in_steps(solver, state, most, full, options).reached);
  EXPECT_NEAR(bearing(full) / 5.14159, 1, 0.02);
  EXPECT_NEAR(bearing(full) / before, 1, 0.005) << "the load has not levelled off";
}

}  // namespace
