// ParaView's own reader on what Polder writes; skipped where ParaView is not installed.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <sstream>

#include "polder/result/vtk.hpp"
#include "sample_frame.hpp"
#include "temporary_folder.hpp"

using namespace polder;

namespace {

std::string output_of(const std::string& command) {
  std::string text;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  std::array<char, 4096> buffer;
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe)) text.append(buffer.data(), count);
  ::pclose(pipe);
  return text;
}

void expect_part(std::istream& found, const char* part, const PointSet& points) {
  std::string name;
  std::size_t count = 0, vertices = 0;
  found >> name >> count >> vertices;
  EXPECT_EQ(name, part);
  EXPECT_EQ(count, points.size());
  EXPECT_EQ(vertices, points.size());
  int components = 0;
  double sum = 0;
  found >> name >> components >> sum;
  EXPECT_EQ(name, "id");
  EXPECT_EQ(sum, static_cast<double>(std::accumulate(points.id.begin(), points.id.end(), std::uint64_t{0})));
  found >> name >> components >> sum;
  EXPECT_EQ(name, "volume");
  EXPECT_NEAR(sum, std::accumulate(points.volume.begin(), points.volume.end(), 0.0), 1e-12);
  for (const PointField& field : points.fields) {
    found >> name >> components >> sum;
    EXPECT_EQ(name, field.info.name);
    EXPECT_EQ(components, field.components == 2 ? 3 : field.components == 4 ? 6 : field.components);
    double size = 0;
    for (const double value : field.values) size += std::abs(value);
    EXPECT_NEAR(sum, std::accumulate(field.values.begin(), field.values.end(), 0.0), 1e-12 * size) << name;
  }
}

}  // namespace

TEST(ParaView, ReadsEveryPartTimeAndValue) {
  if (output_of("command -v pvpython").empty()) GTEST_SKIP() << "no pvpython here (Debian: python3-paraview)";
  const TemporaryFolder folder;
  VtkSeries series;
  Frame dry = sample_frame(0.1);
  dry.water = PointSet{};
  dry.water.fields = {make_field("pressure", {})};
  const Frame last = sample_frame(2.5);
  add_snapshot(folder.path, series, dry, VtkPrecision::float64);
  add_snapshot(folder.path, series, last, VtkPrecision::float64);
  const auto read = [&] {
    return output_of("pvpython --force-offscreen-rendering '" POLDER_SOURCE_DIR
                     "/tests/result/read_with_paraview.py' '" +
                     (folder.path / "points.pvd").string() + "' 2>&1");
  };
  const std::string text = read();
  SCOPED_TRACE(text);
  std::istringstream found(text);
  std::string word;
  double first_time = 0, last_time = 0;
  found >> word >> first_time >> last_time;
  EXPECT_EQ(word, "times");
  EXPECT_EQ(first_time, 0.1);
  EXPECT_EQ(last_time, 2.5);
  expect_part(found, "soil", last.soil);
  expect_part(found, "water", last.water);

  series = resume_series(folder.path, 1.0);  // what is left is the instant without water
  const std::string dry_text = read();
  EXPECT_NE(dry_text.find("water 0 0\n"), std::string::npos) << dry_text;
}
