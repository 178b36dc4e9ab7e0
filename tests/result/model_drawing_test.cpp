#include "polder/result/model_drawing.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "polder/result/paint.hpp"

using namespace polder;

namespace {

Model sample_model() {
  Model model;
  model.title = "Dike & reservoir";
  model.size = {5, 1.25, 0};
  model.cell = {0.05, 0.05, 0};
  MaterialInput sand;
  sand.name = "coarse sand";
  sand.law = "mohr-coulomb";
  model.materials = {sand};
  model.soils.resize(1);
  model.soils[0].region.polygon = {{2, 0}, {2, 1}, {2.1, 1}, {4, 0}};
  model.water_table = {{2, 0.8}, {4, 0}};
  Boundary base, reservoir;
  base.side = Side::base;
  base.soil = SoilCondition::rough;
  reservoir.water = WaterCondition::reservoir;
  reservoir.region.polygon = {{0, 0}, {2, 0}, {2, 0.8}, {0, 0.8}};
  reservoir.head = Table::constant(0.8);
  model.boundaries = {base, reservoir};
  Monitor toe;
  toe.name = "toe";
  toe.at = {{4, 0, 0}};
  model.monitors = {toe};
  return model;
}

}  // namespace

TEST(ModelDrawing, NamesEverythingThatTheModelHasAndNothingElse) {
  const std::string svg = to_svg(draw_model(sample_model()));
  for (const char* text : {"Dike &amp; reservoir", "plane strain, 5 m × 1.25 m; cells of 0.05 m (100 × 25)",
                           "coarse sand: mohr-coulomb, n = 0.4", "water table", "reservoir (head held)", "h = 0.8 m",
                           "soil held (rough)", ">toe<"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  for (const char* text : {"rollers", "open to water", "free water"})
    EXPECT_EQ(svg.find(text), std::string::npos) << text;
}

TEST(ModelDrawing, PutsTheSoilAtItsPlaceOnAnEqualScale) {
  const Model model = sample_model();
  const Drawing drawing = draw_model(model);
  const Path* soil = nullptr;
  for (const Shape& shape : drawing.shapes)
    if (const auto* path = std::get_if<Path>(&shape);
        path && path->fill && path->points.size() == 4 && path->closed && path->points[0][0] == path->points[1][0] &&
        path->points[1][1] == path->points[2][1] && path->points[0][1] == path->points[3][1])
      soil = path;
  ASSERT_NE(soil, nullptr);
  const double scale = soil->points[0][1] - soil->points[1][1];  // 1 m high
  EXPECT_NEAR(soil->points[2][0] - soil->points[1][0], 0.1 * scale, 1e-9);
  EXPECT_NEAR(soil->points[3][0] - soil->points[0][0], 2 * scale, 1e-9);
}

TEST(ModelDrawing, ShowsTheRiverOnUnsaturatedGroundAndLoads) {
  Model model = sample_model();
  model.unsaturated = true;
  SeepageCondition river, drain, face;
  river.name = "river";
  river.line = {{2.1, 1}, {4, 0}, {5, 0}};
  river.head = Table{{0, 10}, {0.2, 0.7}};
  drain = river;
  drain.name = "drain";
  drain.line = {{2, 0}, {3, 0}};  // under the ground: no water stands on it
  face.kind = SeepageCondition::Kind::seepage;
  face.line = {{2.1, 1}, {4, 0}, {5, 0}};
  model.pore_water = {river, drain, face};
  GroundLoad road;
  road.name = "road";
  road.span = {2, 2.1};
  road.pressure = Table{{0, 1}, {0, 13e3}};
  model.loads = {road};
  const std::string svg = to_svg(draw_model(model));
  for (const char* text : {"river: 0.2 to 0.7 m", "drain: 0.2 to 0.7 m", "ground under a head", "seepage face",
                           "road: 0 to 13 kPa", "load on the ground"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  const auto levels = [](const Drawing& drawing) {
    return std::count_if(drawing.shapes.begin(), drawing.shapes.end(), [](const Shape& shape) {
      const auto* path = std::get_if<Path>(&shape);
      return path && path->stroke && path->stroke->width == 1.2 && path->points.size() == 2;
    });
  };
  EXPECT_EQ(levels(draw_model(model)), levels(draw_model(sample_model())) + 3)
      << "the river's level with the two lines of its mark, not the drain's";
}

TEST(ModelDrawing, OfAnEmptyBoxIsDrawn) {
  Model model;
  model.name = "empty";
  model.size = {1, 1, 0};
  model.cell = {0.1, 0.1, 0};
  EXPECT_NE(to_svg(draw_model(model)).find("empty"), std::string::npos);
}
