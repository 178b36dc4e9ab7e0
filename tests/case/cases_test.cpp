#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "polder/case/locate.hpp"
#include "polder/case/reader.hpp"
#include "polder/material/law.hpp"

namespace polder {
namespace {

const std::filesystem::path cases = std::filesystem::path(POLDER_SOURCE_DIR) / "cases";

Model read(const std::string& name, const std::vector<std::string>& overrides = {}) {
  const ReadResult result = read_case((cases / name / "case.toml").string(), overrides);
  EXPECT_TRUE(result.diagnostics.empty()) << format(result.diagnostics);
  return result.model;
}

double parameter(const MaterialInput& material, std::string_view key) {
  const LawDescription* law = find_soil_law(material.law);
  for (std::size_t i = 0; i < law->parameters.size(); ++i)
    if (law->parameters[i].key == key) return material.law_parameters.at(i);
  ADD_FAILURE() << "no parameter " << key;
  return 0;
}

TEST(ShippedCases, AreReadWithoutErrorsOrWarnings) {
  const std::filesystem::path folders[] = {cases};
  const auto shipped = shipped_cases(folders);
  EXPECT_GE(shipped.size(), 7u);
  for (const ShippedCase& c : shipped) {
    const ReadResult result = read_case(c.file.string());
    EXPECT_TRUE(result.diagnostics.empty()) << format(result.diagnostics);
  }
}

TEST(DikeSeepage, IsTableOneOfThePaperWithTrueWater) {
  const Model model = read("dike-seepage");
  EXPECT_EQ(model.name, "dike-seepage");
  EXPECT_EQ(model.size, (std::array{5.1, 1.2, 0.0}));
  EXPECT_NEAR(model.cell[0], 0.05, 1e-15);
  EXPECT_EQ(model.water.bulk_modulus, 2.2e9);
  EXPECT_EQ(model.water.viscosity, 8.905e-4);
  ASSERT_EQ(model.materials.size(), 1u);
  const MaterialInput& sand = model.materials[0];
  EXPECT_EQ(sand.grain_density, 2700);
  EXPECT_EQ(sand.porosity, 0.4);
  EXPECT_EQ(sand.max_porosity, 0.5);
  EXPECT_EQ(sand.grain_diameter, 2e-3);
  EXPECT_EQ(sand.drag, DragLaw::ergun);
  EXPECT_FALSE(sand.permeability);
  EXPECT_EQ(parameter(sand, "young_modulus"), 1e6);
  EXPECT_EQ(parameter(sand, "poisson_ratio"), 0.15);
  EXPECT_NEAR(parameter(sand, "friction_angle"), 35 * std::numbers::pi / 180, 1e-15);
  EXPECT_NEAR(parameter(sand, "dilatancy_angle"), 5 * std::numbers::pi / 180, 1e-15);
  EXPECT_EQ(parameter(sand, "critical_porosity"), 0.45);
  EXPECT_EQ(parameter(sand, "band_width"), 0.1);
  EXPECT_EQ(model.soils.at(0).region.polygon, (std::vector<Point2>{{2, 0}, {2, 1}, {2.14, 1}, {4.1, 0}}));
  EXPECT_EQ(model.water_table, (std::vector<Point2>{{2, 0.8}, {4.1, 0}}));
  EXPECT_EQ(model.initial_stress, InitialStress::none);
  ASSERT_EQ(model.stages.size(), 2u);
  EXPECT_TRUE(model.stages[0].initial && model.stages[0].hold_water);
  EXPECT_EQ(model.stages[0].ramp, 0.7);
  EXPECT_EQ(model.stages[0].damping, 10);
  EXPECT_EQ(model.stages[1].duration, 23);
  EXPECT_EQ(model.output.pictures, (std::vector<double>{2, 6, 8, 14, 23}));
}

TEST(DikeSeepage, HasARoughBaseARollerOnItsAxisAndSmoothClosedSides) {
  const Model model = read("dike-seepage");
  ASSERT_EQ(model.boundaries.size(), 5u);
  EXPECT_EQ(model.boundaries[0].side, Side::base);
  EXPECT_EQ(model.boundaries[0].soil, SoilCondition::rough);
  EXPECT_EQ(model.boundaries[0].water, WaterCondition::closed);
  EXPECT_FALSE(model.boundaries[1].side);
  ASSERT_EQ(model.boundaries[1].line.size(), 2u);
  for (const Point2& end : model.boundaries[1].line) EXPECT_NEAR(end[0], 2, 1e-14);  // snapped to the grid
  EXPECT_EQ(model.boundaries[1].soil, SoilCondition::roller);
  EXPECT_EQ(model.boundaries[1].water, WaterCondition::open);
  for (std::size_t i = 2; i < 5; ++i) {
    EXPECT_EQ(model.boundaries[i].soil, SoilCondition::roller);
    EXPECT_EQ(model.boundaries[i].water, WaterCondition::closed);
  }
}

TEST(DikePaper, DiffersFromTheDikeOnlyWhereItSaysSo) {
  const Model dike = read("dike-seepage"), paper = read("dike-paper"), darcy = read("dike-paper-darcy");
  EXPECT_EQ(paper.water.bulk_modulus, 2e7);
  EXPECT_EQ(darcy.water.bulk_modulus, 2e7);
  EXPECT_EQ(paper.materials[0].drag, DragLaw::ergun);
  EXPECT_EQ(darcy.materials[0].drag, DragLaw::darcy);
  EXPECT_NE(parameter(paper.materials[0], "dilatancy"), parameter(dike.materials[0], "dilatancy"));
  EXPECT_EQ(parameter(paper.materials[0], "friction_angle"), parameter(dike.materials[0], "friction_angle"));
  EXPECT_EQ(darcy.soils[0].region.polygon, dike.soils[0].region.polygon);
  EXPECT_EQ(darcy.stages.size(), dike.stages.size());
}

TEST(Overrides, ReachKeysByNameAndByNumber) {
  const Model model =
      read("dike-seepage", {"model.cell=0.025 m", "material.sand.friction_angle=36 deg", "stage.2.duration=5 s",
                            "numerics.seed=7", "output.pictures=[\"1 s\"]", "material.1.fixed=true"});
  EXPECT_NEAR(model.cell[1], 0.025, 1e-15);
  EXPECT_NEAR(parameter(model.materials[0], "friction_angle"), 36 * std::numbers::pi / 180, 1e-15);
  EXPECT_EQ(model.stages[1].duration, 5);
  EXPECT_EQ(model.numerics.seed, 7u);
  EXPECT_TRUE(model.materials[0].fixed);
}

TEST(Hydrostatic3d, HasHeightAsItsThirdAxis) {
  const Model model = read("hydrostatic-3d");
  EXPECT_EQ(model.space, SpaceKind::solid);
  EXPECT_EQ(model.size, (std::array{1.0, 1.0, 1.3}));
  EXPECT_EQ(model.boundaries.size(), 6u);
  EXPECT_TRUE(model.materials.empty());
}

}  // namespace
}  // namespace polder
