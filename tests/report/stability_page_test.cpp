#include "polder/report/stability_page.hpp"

#include <gtest/gtest.h>

#include "polder/case/reader.hpp"
#include "polder/report/section_drawing.hpp"
#include "polder/seepage/mesher.hpp"

namespace polder {
namespace {

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(StabilityPage, ShowsFactorSurfaceSlicesAndReferenceAndFetchesNothing) {
  const ReadResult read = read_case(std::string(POLDER_SOURCE_DIR) + "/cases/acads-1c/case.toml");
  ASSERT_TRUE(read.ok());
  const stability::Study study{read.model, read.stability, read.seepage};
  const stability::AssessmentOptions options{{stability::find_stability_method("bishop")}, true, false, 0};
  const stability::Assessment all = assess(study, options, {{"bishop", 1.405, 0.02, "the referee's <report>"}});
  const std::string page = stability_page(all, "0");
  EXPECT_NE(page.find("1.40"), std::string::npos);
  EXPECT_NE(page.find("1.405 ± 2.0 %"), std::string::npos);
  EXPECT_NE(page.find("the referee's &lt;report&gt;"), std::string::npos);
  EXPECT_EQ(count_of(page, "<figure"), 2u);  // the surface with its slices, the factors by centre
  EXPECT_GT(count_of(page, "<tr>"), 40u);    // slices
  EXPECT_EQ(page.find("http://"), std::string::npos);
  EXPECT_EQ(page.find("https://"), std::string::npos);
}

TEST(SlipDrawing, ShowsTheTensionCrackAndItsWaterWhereTheSurfaceBegins) {
  const ReadResult read = read_case(std::string(POLDER_SOURCE_DIR) + "/cases/griffiths-lane-1/case.toml",
                                    {"stability.crack_depth=2 m", "stability.crack_water=0.5"});
  ASSERT_TRUE(read.ok());
  const stability::Study study{read.model, read.stability, read.seepage};
  const stability::AssessmentOptions options{{stability::find_stability_method("bishop")}, false, false, 0};
  const stability::Assessment all = assess(study, options, {});
  const Drawing drawing = draw_slip(all.sections[0].prepared, &*all.factors[0].outcome.search, "");
  std::vector<double> upright;  // heights of upright lines thicker than those between slices
  for (const Shape& shape : drawing.shapes)
    if (const auto* path = std::get_if<Path>(&shape); path && path->points.size() == 2 && path->stroke &&
                                                      path->stroke->width > 1.5 &&
                                                      path->points[0][0] == path->points[1][0])
      upright.push_back(std::abs(path->points[0][1] - path->points[1][1]));
  ASSERT_EQ(upright.size(), 2u);  // the water, 1 m, and the crack, 2 m
  EXPECT_NEAR(upright[0] / upright[1], 0.5, 1e-6);
}

TEST(FieldDrawing, ContourLinesLieWhereTheFieldHasTheirValue) {
  MeshRequest request;
  request.polygons = {{{0, 0}, {4, 0}, {4, 1}, {0, 1}}};
  request.size = 0.5;
  const Mesh mesh = make_mesh(request);
  std::vector<double> x;
  for (const Point2& p : mesh.nodes) x.push_back(p[0]);
  TriangleField field = nodal_field(mesh, x);
  EXPECT_EQ(field.pieces.size(), 4 * mesh.triangles.size());
  field.lines = 4;
  const Drawing drawing = draw_field(mesh, field);
  // White lines of x = 0, 1, 2 … are upright.
  std::size_t found = 0;
  for (const Shape& shape : drawing.shapes) {
    const auto* path = std::get_if<Path>(&shape);
    if (!path || path->points.size() != 2 || !path->stroke || path->stroke->colour.opacity != 0.75) continue;
    EXPECT_NEAR(path->points[0][0], path->points[1][0], 1e-6);
    ++found;
  }
  EXPECT_GT(found, 4u);
}

}  // namespace
}  // namespace polder
