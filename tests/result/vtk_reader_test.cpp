#include "polder/result/vtk_reader.hpp"

#include <gtest/gtest.h>

#include "polder/result/picture_files.hpp"
#include "sample_frame.hpp"
#include "temporary_folder.hpp"

using namespace polder;

TEST(Snapshot, ReadsBackAsItWasWritten) {
  const TemporaryFolder folder;
  VtkSeries series;
  const Frame frame = sample_frame(2.5);
  write_section(folder.path, frame);
  add_snapshot(folder.path, series, sample_frame(1), VtkPrecision::float64);
  add_snapshot(folder.path, series, frame, VtkPrecision::float64);
  const Frame read = read_snapshot(folder.path, read_pvd(folder.path / "points.pvd"), 1);
  EXPECT_EQ(read.time, 2.5);
  EXPECT_EQ(read.title, frame.title);
  EXPECT_EQ(read.size, frame.size);
  EXPECT_EQ(read.outlines, frame.outlines);
  EXPECT_EQ(read.soil.id, frame.soil.id);
  EXPECT_EQ(read.soil.position, frame.soil.position);
  EXPECT_EQ(read.water.volume, frame.water.volume);
  EXPECT_EQ(read.soil.find("porosity")->values, frame.soil.find("porosity")->values);
  EXPECT_EQ(read.soil.find("velocity")->components, 3);
  EXPECT_EQ(magnitudes(*read.soil.find("velocity")), magnitudes(*frame.soil.find("velocity")));
  EXPECT_NO_THROW(check_frame(read));
}

TEST(Snapshot, OfSinglePrecisionReadsBackToItsPrecision) {
  const TemporaryFolder folder;
  const PointSet soil = sample_frame().soil;
  write_vtp(folder.path / "soil.vtp", soil, 0, VtkPrecision::float32);
  const PointSet read = read_vtp(folder.path / "soil.vtp");
  for (std::size_t p = 0; p < soil.size(); ++p) EXPECT_NEAR(read.position[p][0], soil.position[p][0], 4 * 6e-8);
}

TEST(Snapshot, ThatIsCutOffIsRefusedByName) {
  const TemporaryFolder folder;
  write_vtp(folder.path / "soil.vtp", sample_frame().soil, 0, VtkPrecision::float32);
  const std::string whole = bytes_of(folder.path / "soil.vtp");
  for (const std::size_t size : {std::size_t{0}, std::size_t{300}, whole.size() / 2, whole.size() - 8000}) {
    std::ofstream(folder.path / "cut.vtp", std::ios::binary) << whole.substr(0, size);
    try {
      read_vtp(folder.path / "cut.vtp");
      FAIL() << "no error at " << size << " bytes";
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find("cut.vtp: "), std::string::npos) << error.what();
    }
  }
}

TEST(PictureNames, SayWhatThePictureShows) {
  EXPECT_EQ(picture_name({"pore_pressure", 2.5}), "pore_pressure_2.5s.png");
  for (const double time : {0.0, 0.125, 1e-7, 86400.0}) {
    const auto name = parse_picture_name(picture_name({"pore_total", time}));
    ASSERT_TRUE(name.has_value());
    EXPECT_EQ(name->field, "pore_total");
    EXPECT_EQ(name->time, time);
  }
  for (const char* other : {"model.png", "sheet_tall.png", "_1s.png", "porosity_1s.svg", "porosity_s.png"})
    EXPECT_FALSE(parse_picture_name(other).has_value()) << other;
}

TEST(PictureFiles, AreListedByQuantityThenTime) {
  const TemporaryFolder folder;
  Team team(2);
  for (const double time : {10.0, 2.0})
    write_pictures(folder.path, sample_frame(time), standard_pictures(sample_frame()), time, team);
  std::vector<std::string> names;
  for (const auto& path : list_pictures(folder.path)) names.push_back(path.filename().string());
  EXPECT_EQ(names, (std::vector<std::string>{"porosity_2s.png", "porosity_10s.png", "pore_pressure_2s.png",
                                             "pore_pressure_10s.png", "velocity_2s.png", "velocity_10s.png"}));
}
