// The levee lifted at its toe (P4, its outline frozen): clay on sand, the head in the sand raised on the river's side.
// References: independent computations of the same outline; slip surfaces enter between crest and toe.
#include <gtest/gtest.h>

#include "polder/seepage/mesher.hpp"
#include "polder/stability/search.hpp"
#include "polder/stability/seepage_pressures.hpp"
#include "reference_slopes.hpp"

namespace polder::stability {
namespace {

constexpr double sand_base = -5.96, drain_pressure = 82e3;  // m, Pa at the base

double head_at_base(double pressure) { return pressure / 9810 + sand_base; }

Section levee() {
  Section section;
  const auto weight = [](double grain, double porosity) {
    return ((1 - porosity) * grain + porosity * 1000) * 9.81e-3;
  };
  section.soils = {testing::drained(10, 22, weight(2542, 0.3)), testing::drained(0, 37, weight(2610, 0.355))};
  section.layers = {testing::layer({{0, 0}, {31, 0}, {14.6, 7.2}, {11, 7.2}}, 0),
                    testing::layer({{0, -3.6}, {50, -3.6}, {50, 0}, {0, 0}}, 0),
                    testing::layer({{0, sand_base}, {50, sand_base}, {50, -3.6}, {0, -3.6}}, 1)};
  section.movement = Movement::right;
  section.limits.entry = Range{11, 31};
  return section;
}

// Steady seepage from a base pressure that falls linearly to the drain's.
PreparedSection with_seepage(double pressure) {
  Section section = levee();
  MeshRequest request;
  for (const Layer& layer : section.layers) request.polygons.push_back(layer.polygon);
  request.size = 0.5;
  const Mesh mesh = make_mesh(request);
  FlowMaterial clay;
  clay.conductivity = {7.44e-5, 7.44e-5};
  clay.retention = LinearRetention{4e-7, 0};
  clay.curve = ConstantConductivity{};
  FlowMaterial sand = clay;
  sand.conductivity = {7.44e-3, 7.44e-3};
  FlowBoundary base, land;
  base.condition = FlowCondition::head;
  base.line = {{0, sand_base}, {50, sand_base}};
  base.head = Table::constant(head_at_base(pressure));
  base.head_at_end = Table::constant(head_at_base(drain_pressure));
  land.condition = FlowCondition::seepage;
  land.line = {{50, 0}, {31, 0}, {14.6, 7.2}, {11, 7.2}};
  const FlowSolver solver({&mesh, {clay, clay, sand}, {base, land}, 9810});
  take_pressures(solver, solver.steady(0), 0.1, section);
  return prepare(std::move(section));
}

// The same head everywhere in the sand, pressure linear through the clay up to the ground.
PreparedSection with_uniform_head(double pressure) {
  Section section = levee();
  const Line head{{0, head_at_base(pressure)}};
  section.water.phreatic = {{0, 0}, {50, 0}};
  section.water.references = {{{{0, 0}, {50, 0}}, {}, {}}, {{{0, -3.6}, {50, -3.6}}, head, head}};
  return prepare(std::move(section));
}

struct Phase {
  double pressure, bishop, uplift_van;
};

class LeveeWithSeepage : public ::testing::TestWithParam<Phase> {};
TEST_P(LeveeWithSeepage, BishopAgreesWithinThreePerCent) {
  const SearchResult result =
      critical_circle(with_seepage(GetParam().pressure * 1e3),
                      [](const Slices& slices, const SlipSurface& surface) { return bishop(slices, surface.circle); });
  ASSERT_TRUE(result) << result.problem;
  EXPECT_NEAR(result.equilibrium.factor, GetParam().bishop, 0.03 * GetParam().bishop);
}
TEST_P(LeveeWithSeepage, UpliftVanAgreesWithinThreePerCent) {
  const SearchResult result = critical_uplift_van(with_seepage(GetParam().pressure * 1e3));
  ASSERT_TRUE(result) << result.problem;
  EXPECT_NEAR(result.equilibrium.factor, GetParam().uplift_van, 0.03 * GetParam().uplift_van);
}
INSTANTIATE_TEST_SUITE_P(Phases, LeveeWithSeepage,
                         ::testing::Values(Phase{82, 1.42, 1.38}, Phase{102, 1.27, 1.20}, Phase{112, 1.18, 1.11},
                                           Phase{122, 1.08, 1.01}, Phase{142, 0.89, 0.84}, Phase{162, 0.73, 0.70}));

class LeveeWithUniformHead : public ::testing::TestWithParam<Phase> {};
TEST_P(LeveeWithUniformHead, UpliftVanAgreesWithinThreePerCent) {
  const SearchResult result = critical_uplift_van(with_uniform_head(GetParam().pressure * 1e3));
  ASSERT_TRUE(result) << result.problem;
  EXPECT_NEAR(result.equilibrium.factor, GetParam().uplift_van, 0.03 * GetParam().uplift_van);
}
INSTANTIATE_TEST_SUITE_P(Phases, LeveeWithUniformHead,
                         ::testing::Values(Phase{82, 0, 1.47}, Phase{102, 0, 1.17}, Phase{122, 0, 0.91}));

// Beyond, the sand has no effective stress left under the whole landside: factors fall steadily with the depth of the
// plane, and a search down to the base of the sand goes under the reference's 0.71 and 0.57. Its five factors are those
// of planes that stay 0.9 m above the base, whatever the phase.
class LeveeAboveTheBase : public ::testing::TestWithParam<Phase> {};
TEST_P(LeveeAboveTheBase, UpliftVanAgreesWithinOnePerCent) {
  Section section = with_uniform_head(GetParam().pressure * 1e3).section;
  section.limits.forbidden_lines = {{{0, sand_base + 0.9}, {50, sand_base + 0.9}}};
  const SearchResult result = critical_uplift_van(prepare(std::move(section)));
  ASSERT_TRUE(result) << result.problem;
  EXPECT_NEAR(result.equilibrium.factor, GetParam().uplift_van, 0.01 * GetParam().uplift_van);
}
INSTANTIATE_TEST_SUITE_P(Phases, LeveeAboveTheBase,
                         ::testing::Values(Phase{82, 0, 1.47}, Phase{102, 0, 1.17}, Phase{122, 0, 0.91},
                                           Phase{142, 0, 0.71}, Phase{162, 0, 0.57}));

TEST(LeveeWithUniformHead, SearchGoesBelowTheReferenceOnceTheSandFloats) {
  const SearchResult at_142 = critical_uplift_van(with_uniform_head(142e3));
  const SearchResult at_162 = critical_uplift_van(with_uniform_head(162e3));
  ASSERT_TRUE(at_142) << at_142.problem;
  ASSERT_TRUE(at_162) << at_162.problem;
  EXPECT_LT(at_142.equilibrium.factor, 0.71);
  EXPECT_LT(at_162.equilibrium.factor, 0.57);
  EXPECT_LT(at_142.surface.plane.tangent, -5.5);
  EXPECT_LT(at_162.surface.plane.tangent, -5.5);
}

TEST(UpliftVan, WithoutAPlaneAndWithOneCentreItIsNearBishop) {
  // One circle split at its lowest point: Bishop's moments, but for the lever of the force on the split.
  Section section = levee();
  const PreparedSection prepared = prepare(section);
  const Point centre{24, 18};
  const double tangent = -2;
  const UpliftVanPlane plane{centre, {24 + 1e-6, 18}, tangent};
  const Slices slices = cut_slices(prepared, uplift_van_surface(prepared, plane));
  ASSERT_TRUE(slices) << slices.problem;
  const Equilibrium split = uplift_van(slices, plane);
  const Circle circle{centre, centre[1] - tangent};
  const Equilibrium whole = bishop(cut_slices(prepared, circle_surface(prepared, circle)), circle);
  ASSERT_TRUE(split) << split.problem;
  ASSERT_TRUE(whole) << whole.problem;
  EXPECT_NEAR(split.factor, whole.factor, 1e-4 * whole.factor);
}

}  // namespace
}  // namespace polder::stability
