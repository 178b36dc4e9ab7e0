#include "polder/result/vtk.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "polder/result/output_error.hpp"
#include "sample_frame.hpp"
#include "temporary_folder.hpp"

using namespace polder;

namespace {

// Reads an appended array back by the offset that the header states.
template <class Number>
std::vector<Number> array_of(const std::string& file, const std::string& name) {
  const std::size_t mark = file.find("<AppendedData encoding=\"raw\">\n_") + 31;
  const std::string header = file.substr(0, mark);
  const std::string named = "Name=\"" + name + "\"", says = "offset=\"";
  const std::size_t begin = header.find(named), end = header.find('>', begin), at = header.find(says, begin);
  if (begin == std::string::npos || at > end) return {};
  const std::size_t offset = mark + std::stoul(header.substr(at + says.size()));
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, file.data() + offset, sizeof bytes);
  std::vector<Number> values(bytes / sizeof(Number));
  std::memcpy(values.data(), file.data() + offset + sizeof bytes, bytes);
  return values;
}

}  // namespace

TEST(Vtp, HoldsEveryNumberOfTheFrameInDoublePrecision) {
  const TemporaryFolder folder;
  const PointSet soil = sample_frame().soil;
  write_vtp(folder.path / "soil.vtp", soil, 2.5, VtkPrecision::float64);
  const std::string file = bytes_of(folder.path / "soil.vtp");
  const std::size_t n = soil.size();

  const auto position = array_of<double>(file, "Points");
  const auto porosity = array_of<double>(file, "porosity");
  const auto velocity = array_of<double>(file, "velocity");
  const auto stress = array_of<double>(file, "effective_stress");
  const auto id = array_of<std::int64_t>(file, "id");
  const auto vertex = array_of<std::int32_t>(file, "connectivity");
  const auto end = array_of<std::int32_t>(file, "offsets");
  ASSERT_EQ(position.size(), 3 * n);
  ASSERT_EQ(velocity.size(), 3 * n);
  ASSERT_EQ(stress.size(), 6 * n);
  ASSERT_EQ(id.size(), n);
  ASSERT_EQ(vertex.size(), n);
  ASSERT_EQ(end.size(), n);
  EXPECT_EQ(porosity, soil.find("porosity")->values);
  for (std::size_t p = 0; p < n; ++p) {
    for (std::size_t a = 0; a < 3; ++a) EXPECT_EQ(position[3 * p + a], soil.position[p][a]);
    EXPECT_EQ(velocity[3 * p + 1], soil.find("velocity")->values[2 * p + 1]);
    EXPECT_EQ(velocity[3 * p + 2], 0);
    for (std::size_t c = 0; c < 4; ++c) EXPECT_EQ(stress[6 * p + c], soil.find("effective_stress")->values[4 * p + c]);
    EXPECT_EQ(stress[6 * p + 5], 0);
    EXPECT_EQ(static_cast<std::uint64_t>(id[p]), soil.id[p]);
    EXPECT_EQ(vertex[p], static_cast<std::int32_t>(p));
    EXPECT_EQ(end[p], static_cast<std::int32_t>(p + 1));
  }
}

TEST(Vtp, InSinglePrecisionIsTheNearestFloat) {
  const TemporaryFolder folder;
  const PointSet soil = sample_frame().soil;
  write_vtp(folder.path / "soil.vtp", soil, 2.5, VtkPrecision::float32);
  const auto pressure = array_of<float>(bytes_of(folder.path / "soil.vtp"), "pore_pressure");
  ASSERT_EQ(pressure.size(), soil.size());
  for (std::size_t p = 0; p < soil.size(); ++p)
    EXPECT_EQ(pressure[p], static_cast<float>(soil.find("pore_pressure")->values[p]));
}

TEST(Pvd, NamesOnlyCompleteFilesAndReadsBack) {
  const TemporaryFolder folder;
  VtkSeries series;
  for (const double time : {0.0, 0.1, 1.0 / 3}) add_snapshot(folder.path, series, sample_frame(time));
  const VtkSeries read = read_pvd(folder.path / "points.pvd");
  ASSERT_EQ(read.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(read[i].time, series[i].time);
    EXPECT_EQ(read[i].part, i % 2 == 0 ? "soil" : "water");
    EXPECT_NE(bytes_of(folder.path / read[i].file).find("</VTKFile>"), std::string::npos) << read[i].file;
  }
}

TEST(Pvd, ResumingDropsWhatIsLaterThanTheCheckpoint) {
  const TemporaryFolder folder;
  VtkSeries series;
  for (const double time : {0.0, 1.0, 2.0}) add_snapshot(folder.path, series, sample_frame(time));
  series = resume_series(folder.path, 1.0);
  EXPECT_EQ(series.size(), 4u);
  EXPECT_FALSE(std::filesystem::exists(folder.path / "points/soil_00002.vtp"));
  add_snapshot(folder.path, series, sample_frame(1.5));
  const VtkSeries read = read_pvd(folder.path / "points.pvd");
  ASSERT_EQ(read.size(), 6u);
  EXPECT_EQ(read.back().time, 1.5);
  EXPECT_EQ(read.back().file, "points/water_00002.vtp");
}

TEST(Pvd, ThatCannotBeWrittenSaysWhichPathAndWhy) {
  const TemporaryFolder folder;
  try {
    write_pvd(folder.path / "missing" / "points.pvd", {});
    FAIL() << "no error";
  } catch (const OutputError& error) {
    EXPECT_EQ(error.path(), (folder.path / "missing" / "points.pvd").string());
    EXPECT_EQ(error.reason(), "No such file or directory");
  }
}

TEST(Frame, WithAFieldOfTheWrongLengthIsRefused) {
  Frame frame = sample_frame();
  frame.soil.fields[1].values.pop_back();
  EXPECT_THROW(check_frame(frame), std::logic_error);
}
