// Slice tables of D-Stability results: the factor recomputed from the slices' weights, pressures and strengths.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>

#include "polder/stability/equilibrium.hpp"
#include "shared_data.hpp"

namespace polder::stability {
namespace {

// Rows as slices. The table's angle is negative where the base dips to the right, which is the way these slide.
Slices read_table(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line, cell;
  std::getline(in, line);
  std::erase(line, '\r');
  std::vector<std::string> names;
  for (std::stringstream header(line); std::getline(header, cell, ',');) names.push_back(cell);
  Slices slices;
  while (std::getline(in, line)) {
    std::map<std::string, double> row;
    std::stringstream cells(line);
    for (const std::string& name : names) {
      std::getline(cells, cell, ',');
      row[name] = std::stod(cell);
    }
    Slice slice;
    slice.left = row["xl_b"], slice.right = row["xr_b"];
    slice.base_left = row["zl_b"], slice.base_right = row["zr_b"];
    slice.top_left = row["zl_t"], slice.top_right = row["zr_t"];
    slice.width = row["Width"], slice.length = row["ArcLength"];
    slice.angle = -row["BottomAngle"] * std::numbers::pi / 180;
    slice.vertical = row["TotalStress"] * 1e3 * slice.width;
    slice.pore_pressure = row["TotalPorePressure"] * 1e3;
    slice.horizontal = row["SurfacePorePressure"] * 1e3 * (slice.top_right - slice.top_left);
    slice.horizontal_level = slice.top();
    // Undrained rows give s_u; the few drained ones have c = 0, and their strength is the effective stress's share.
    if (std::isfinite(row["SuOutput"]))
      slice.cohesion = row["SuOutput"] * 1e3;
    else
      slice.tan_friction = row["ShearStress"] / row["NormalStress"];
    slices.list.push_back(slice);
  }
  return slices;
}

Equilibrium bishop_table(const Slices& slices) { return bishop(slices, {{23.7, 24.6}, 28.7}); }

Equilibrium uplift_van_table(const Slices& slices) {
  return uplift_van(slices, {{32.20306898, 32.41148044}, {39.71123469, 12.80536623}, -5.00007461});
}

class SliceTable : public ::testing::Test {
 public:
  SliceTable(std::filesystem::path file, Equilibrium (*method)(const Slices&), double factor)
      : file_(std::move(file)), method_(method), factor_(factor) {}
  void TestBody() override {
    const Equilibrium result = method_(read_table(file_));
    ASSERT_TRUE(result) << result.problem;
    EXPECT_NEAR(result.factor, factor_, 0.006 * factor_);
    RecordProperty("factor", std::to_string(result.factor));
  }

 private:
  std::filesystem::path file_;
  Equilibrium (*method_)(const Slices&);
  double factor_;
};

bool register_if_there(const char* name, const char* file, Equilibrium (*method)(const Slices&), double factor) {
  const auto path = testing::shared_file(file);
  if (path)
    ::testing::RegisterTest("DStabilitySlices", name, nullptr, nullptr, __FILE__, __LINE__,
                            [=]() -> SliceTable* { return new SliceTable(*path, method, factor); });
  return path.has_value();
}

[[maybe_unused]] const bool bishop_there =
    register_if_there("BishopIsRecomputed", "data/dstability_bishop_ResultExample_F1.01498.csv", bishop_table, 1.01498);
[[maybe_unused]] const bool uplift_van_there = register_if_there(
    "UpliftVanIsRecomputed", "data/dstability_upliftvan_ResultExample_F0.96973.csv", uplift_van_table, 0.96973);

}  // namespace
}  // namespace polder::stability
