// Water and submerged soil at rest (REFERENCES A5): pressure ρ g z, effective stress γ' z, and nothing moves.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "polder/case/reader.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {
namespace {

Model shipped(const std::string& name) {
  const ReadResult result = read_case(std::string(POLDER_SOURCE_DIR) + "/cases/" + name + "/case.toml");
  EXPECT_TRUE(result.ok());
  return result.model;
}

struct Rest {
  double pressure_rms = 0;  // of ρ g H
  double speed = 0;         // m/s, fastest point
  double stress = 0;        // largest error of a row of cells' mean σ'v, of the largest value
};

template <class Space>
Rest run_to_rest(const Model& model, double level, double bed) {
  constexpr int up = Space::up;
  Simulation<Space> run(model, 1);
  while (!run.finished()) run.advance();
  const auto& state = run.state();
  const auto& lattice = state.setup.lattice;
  const double gamma = model.water.density * model.gravity;
  Rest rest;
  double squares = 0;
  int cells = 0;
  for (std::ptrdiff_t row = 0; row < lattice.row_count(); ++row)
    for (int i = 0; i < lattice.cells[0]; ++i) {
      const int at[3] = {i, static_cast<int>(row % lattice.cells[1]), static_cast<int>(row / lattice.cells[1])};
      const double height = (at[up] + 0.5) * lattice.spacing[up];
      if (height > level) continue;
      const double error = state.grid.pressure[lattice.index(at[0], at[1], at[2])] - gamma * (level - height);
      squares += error * error;
      ++cells;
    }
  rest.pressure_rms = std::sqrt(squares / cells) / (gamma * level);
  const auto fastest = [&](const auto& points) {
    for (std::size_t p = 0; p < points.size(); ++p) {
      double square = 0;
      for (const auto& v : points.velocity) square += v[p] * v[p];
      rest.speed = std::max(rest.speed, std::sqrt(square));
    }
  };
  fastest(state.water);
  fastest(state.soil);
  // single points scatter with their jitter (the weights of irregular points); a row of cells carries what lies above
  std::map<int, std::array<double, 3>> rows;  // computed, exact, number
  double largest = 0;
  for (std::size_t p = 0; p < state.soil.size(); ++p) {
    const MaterialInput& m = model.materials[state.soil.material[p]];
    const double submerged = (1 - m.porosity) * (m.grain_density - model.water.density) * model.gravity;
    auto& row = rows[static_cast<int>(state.soil.position[up][p] / lattice.spacing[up])];
    row[0] += state.soil.stress[up][p];
    row[1] -= submerged * (bed - state.soil.position[up][p]);
    row[2] += 1;
    largest = submerged * bed;
  }
  for (const auto& [level_of_row, row] : rows)
    rest.stress = std::max(rest.stress, std::abs(row[0] - row[1]) / row[2] / largest);
  return rest;
}

TEST(HydrostaticTank, StaysAtRest) {
  const Rest rest = run_to_rest<PlaneStrain>(shipped("hydrostatic"), 1, 0);
  EXPECT_LT(rest.pressure_rms, 1e-4);
  EXPECT_LT(rest.speed, 1e-6 * std::sqrt(9.81));
}

TEST(HydrostaticTank, StaysAtRestInThreeDimensions) {
  const Rest rest = run_to_rest<Solid>(shipped("hydrostatic-3d"), 1, 0);
  EXPECT_LT(rest.pressure_rms, 1e-4);
  EXPECT_LT(rest.speed, 1e-6 * std::sqrt(9.81));
}

TEST(HydrostaticJump, StaysAtRestWithJitteredPoints) {
  const Rest rest = run_to_rest<PlaneStrain>(shipped("hydrostatic-jump"), 1, 0.5);
  EXPECT_LT(rest.pressure_rms, 1e-4);
  EXPECT_LT(rest.speed, 1e-6 * std::sqrt(9.81));
  EXPECT_LT(rest.stress, 0.005);
}

}  // namespace
}  // namespace polder
