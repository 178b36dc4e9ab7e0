#include "polder/report/figures.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "synthetic_run.hpp"

namespace polder {
namespace {

class Figures : public testing::Test {
 protected:
  std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("polder-figures-" + std::to_string(::getpid()));
  void SetUp() override {
    SyntheticRun run;
    run.spacing = 0.2;
    run.frames = 7;
    write_synthetic_run(folder, run);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  std::string bytes(const std::filesystem::path& path) const {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
};

TEST_F(Figures, AreThoseAskedForAndTheSameWhenWrittenAgain) {
  FigureOptions options;
  options.fields = {"porosity", "pore_pressure"};
  options.times = {2.2, 12};
  const auto files = write_figures(folder, options);
  std::vector<std::string> names, first;
  for (const auto& file : files) {
    names.push_back(file.filename().string());
    first.push_back(bytes(file));
    EXPECT_GT(first.back().size(), 1000u) << file;
    std::filesystem::remove(file);
  }
  EXPECT_EQ(names,
            (std::vector<std::string>{"porosity_2s.png", "porosity_2s.svg", "porosity_12s.png", "porosity_12s.svg",
                                      "pore_pressure_2s.png", "pore_pressure_2s.svg", "pore_pressure_12s.png",
                                      "pore_pressure_12s.svg", "sheet.png", "sheet.svg"}));
  EXPECT_EQ(write_figures(folder, options), files);
  for (std::size_t k = 0; k < files.size(); ++k) EXPECT_EQ(bytes(files[k]), first[k]) << files[k];
}

TEST_F(Figures, CarryTitleTimeAxesUnitAndScaleBar) {
  FigureOptions options;
  options.fields = {"pore_pressure"};
  options.times = {0};
  options.formats = {"svg"};
  const std::string svg = bytes(write_figures(folder, options).at(0));
  for (const char* text : {">A slumping dike, from formulas<", ">t = 0.00 s<", ">x (m)<", ">y (m)<", ">kPa<", ">1 m<"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
}

TEST_F(Figures, SpreadOverTheRunUnlessTimesAreGiven) {
  FigureOptions options;
  options.fields = {"liquefied"};
  options.formats = {"svg"};
  EXPECT_EQ(write_figures(folder, options).size(), 5u + 1);
  options.all_times = true;
  EXPECT_EQ(write_figures(folder, options).size(), 7u + 1);
}

TEST_F(Figures, OfAFieldThatIsNotThereAreRefusedWithTheNamesOfThoseThatAre) {
  FigureOptions options;
  options.fields = {"porousity"};
  try {
    write_figures(folder, options);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("porousity"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("porosity, pore_pressure"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace polder
