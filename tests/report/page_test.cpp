#include "polder/report/page.hpp"

#include <gtest/gtest.h>

#include "polder/report/viewer.hpp"

namespace polder {
namespace {

Page page_titled(const std::string& title) {
  Page page;
  page.title = title;
  PointSeries soil;
  soil.name = "soil";
  soil.id = {1, 2};
  soil.frame_start = {0, 2};
  soil.fields = {{{"x", "x", "x", "m"}, {0, 1}}, {{"y", "y", "y", "m"}, {0, 1}}};
  page.times = {0};
  page.points.push_back({encode(soil), 1.0});
  return page;
}

TEST(ReportPage, CannotBeBrokenByATitle) {
  const std::string html = render_page(page_titled("</script><script>alert(1)</script> & \"dike\""));
  EXPECT_EQ(html.find("alert(1)</script>"), std::string::npos);
  EXPECT_NE(html.find("<title>&lt;/script&gt;&lt;script&gt;alert(1)"), std::string::npos);
  EXPECT_NE(html.find("\\u003c/script>"), std::string::npos);
}

TEST(ReportPage, HoldsEveryBlobThatItNames) {
  const std::string html = render_page(page_titled("dike"));
  for (const char* id : {"polder-soil-0", "polder-soil-1", "polder-soil-2"})
    EXPECT_NE(html.find(std::string("type=\"application/octet-stream\" id=\"") + id + "\""), std::string::npos) << id;
}

TEST(ReportPage, ForbidsItselfTheNetworkAndNamesNoHost) {
  const std::string html = render_page(page_titled("dike"));
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(html.find("src=\"http"), std::string::npos);
  EXPECT_EQ(html.find("url(http"), std::string::npos);
}

TEST(ReportPage, EmbedsTheViewerWhole) {
  EXPECT_GT(viewer_script.size(), 50000u);
  EXPECT_EQ(viewer_script.find("</script"), std::string_view::npos);
  EXPECT_NE(viewer_style.find("@font-face"), std::string_view::npos);
  EXPECT_NE(render_page(page_titled("dike")).find(viewer_script), std::string::npos);
}

}  // namespace
}  // namespace polder
