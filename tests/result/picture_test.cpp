#include "polder/result/picture.hpp"

#include <cairo.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "polder/result/paint.hpp"
#include "sample_frame.hpp"
#include "temporary_folder.hpp"

using namespace polder;

namespace {

struct Image {
  int width = 0, height = 0;
  std::vector<std::uint32_t> pixels;  ///< 0xRRGGBB
  std::uint32_t at(double x, double y) const {
    return pixels[static_cast<std::size_t>(static_cast<int>(y) * width + static_cast<int>(x))];
  }
};

Image decoded(const std::filesystem::path& path) {
  cairo_surface_t* surface = cairo_image_surface_create_from_png(path.c_str());
  Image image;
  image.width = cairo_image_surface_get_width(surface);
  image.height = cairo_image_surface_get_height(surface);
  const unsigned char* row = cairo_image_surface_get_data(surface);
  for (int y = 0; y < image.height; ++y, row += cairo_image_surface_get_stride(surface))
    for (int x = 0; x < image.width; ++x)
      image.pixels.push_back(reinterpret_cast<const std::uint32_t*>(row)[x] & 0xffffff);
  cairo_surface_destroy(surface);
  return image;
}

std::uint32_t hex(const Colour& c) {
  const auto byte = [](double v) { return static_cast<std::uint32_t>(v * 255 + 0.5); };
  return byte(c.red) << 16 | byte(c.green) << 8 | byte(c.blue);
}

int distance(std::uint32_t a, std::uint32_t b) {
  int most = 0;
  for (const int shift : {0, 8, 16})
    most = std::max(most, std::abs(static_cast<int>(a >> shift & 255) - static_cast<int>(b >> shift & 255)));
  return most;
}

}  // namespace

TEST(Picture, HasItsSizeAndShowsSoilWaterAndAirInTheirColours) {
  const TemporaryFolder folder;
  const Frame frame = sample_frame();
  PictureField field = picture_field("porosity");
  field.range = Range{0.4, 0.5};
  PictureStyle style;
  style.view = std::array{Range{0, 4}, Range{0, 1.5}};
  const Drawing drawing = draw_frame(frame, field, style);
  write_drawing(folder.path / "porosity.png", drawing);
  const Image image = decoded(folder.path / "porosity.png");
  EXPECT_EQ(image.width, static_cast<int>(2 * drawing.width));
  EXPECT_EQ(image.height, static_cast<int>(std::ceil(2 * drawing.height)));

  // The panel: 62 units from the left, 58 from the top, 820 wide.
  const auto pixel = [&](double x, double y) {
    return image.at(2 * (62 + x * 820 / 4), 2 * (58 + (1.5 - y) * 820 / 4));
  };
  EXPECT_LE(distance(pixel(2.0, 0.5), hex(colour_at(ColourMap::field, (0.01 * 2.5 * 2.0) / 0.1))), 4);
  EXPECT_EQ(pixel(0.51, 0.41), hex(ink::water));
  EXPECT_EQ(pixel(3.51, 1.21), 0xffffffu);
}

TEST(Picture, OfTheSameFrameHasTheSameBytes) {
  const auto draw = [](auto paint) { return paint(draw_frame(sample_frame(), picture_field("velocity"))); };
  const auto png = [](const Drawing& d) { return to_png(d); };
  const auto svg = [](const Drawing& d) { return to_svg(d); };
  EXPECT_EQ(draw(png), draw(png));
  EXPECT_EQ(draw(svg), draw(svg));
}

TEST(Picture, OfAnUnknownFieldIsRefused) {
  EXPECT_THROW(draw_frame(sample_frame(), picture_field("colour of the dike")), std::invalid_argument);
}

TEST(Picture, SheetColoursOneQuantityOnOneScaleAtAllTimes) {
  const std::vector<Frame> frames{sample_frame(0), sample_frame(10)};
  const std::vector<PictureField> fields{picture_field("porosity"), picture_field("pore_pressure")};
  const Drawing sheet = draw_sheet(frames, fields);
  std::vector<const Squares*> layers;
  for (const Shape& shape : sheet.shapes)
    if (const auto* squares = std::get_if<Squares>(&shape)) layers.push_back(squares);
  ASSERT_EQ(layers.size(), 8u);  // two quantities, two times, water and soil
  // Porosity is 0.4 everywhere at first, then 0.4 + 0.1 x: the first is the dark end of the common scale.
  std::set<std::uint32_t> first, second;
  for (const Colour& c : layers[1]->colours) first.insert(hex(c));
  for (const Colour& c : layers[3]->colours) second.insert(hex(c));
  EXPECT_EQ(first.size(), 1u);
  EXPECT_GT(second.size(), 20u);
  EXPECT_LT(to_oklab(rgb(*first.begin())).lightness, 0.45);
}

TEST(Picture, PutsZeroAtTheWhiteOfASignedQuantity) {
  Frame frame = sample_frame();
  std::vector<double> excess(frame.soil.size(), 700.0);
  excess.front() = -200;
  frame.soil.fields.push_back(make_field("excess_pressure", excess));
  const Range range = common_range({&frame, 1}, picture_field("excess_pressure"));
  EXPECT_DOUBLE_EQ(range.low, -range.high);
  EXPECT_GE(range.high, 700);
}

TEST(Picture, TextIsHarmlessInSvg) {
  const std::string svg = to_svg(draw_frame(sample_frame(), picture_field("porosity")));
  EXPECT_NE(svg.find("A dike &amp; its &lt;reservoir&gt;"), std::string::npos);
}

TEST(Base64, AgreesWithTheExamplesOfRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}
