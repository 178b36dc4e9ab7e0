// Water behind a gate that vanishes, not as deep as a cell, runs out as Ritter's shallow water does: a film that is a
// quarter of a cell deep, so that no cell of it is wet, and water that becomes one as it runs out.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "case_text.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {
namespace {

constexpr double cell = 0.1, dam = 4, gravity = 9.81;  // SI

struct Film {
  std::vector<double> depth;   ///< m, by column of cells
  std::ptrdiff_t wet = 0;      ///< most cells that were wet
  double fastest_at_rest = 0;  ///< m/s, behind the rarefaction
};

Film film_after(double depth, double time) {
  Simulation<PlaneStrain> run(read_text(fmt::format(R"(
[model]
size = ["8 m", "0.3 m"]
cell = "{} m"
points_per_axis = 8
[[free_water]]
box = [["0 m", "0 m"], ["{} m", "{} m"]]
[[stage]]
name = "run"
duration = "{} s"
)",
                                                    cell, dam, depth, time)),
                              1);
  Film film;
  const auto& grid = run.state().grid;
  while (!run.finished()) {
    run.advance();
    film.wet = std::max(film.wet, std::count(grid.wet.begin(), grid.wet.end(), 1));
  }
  for (int i = 0; i < 80; ++i) film.depth.push_back(grid.fill[run.state().setup.lattice.index(i, 0)] * cell);
  const auto& water = run.state().water;
  for (std::size_t p = 0; p < water.size(); ++p)
    if (water.position[0][p] < dam - 1.5 * std::sqrt(gravity * depth) * time)
      film.fastest_at_rest = std::max(film.fastest_at_rest, std::abs(water.velocity[0][p]));
  return film;
}

/// Depths within 4 % of the first one (a point of the shallower film is 6 % of it), rms over the water that moves.
void expect_ritters(const Film& film, double depth, double time) {
  const double celerity = std::sqrt(gravity * depth);
  EXPECT_LT(film.fastest_at_rest, 0.02 * celerity);
  double square = 0;
  int number = 0;
  for (std::size_t i = 0; i < film.depth.size(); ++i) {
    const double xi = ((static_cast<double>(i) + 0.5) * cell - dam) / (celerity * time);
    if (xi < -1 || xi > 2) continue;
    square += std::pow(film.depth[i] / depth - (2 - xi) * (2 - xi) / 9, 2);
    ++number;
  }
  EXPECT_LT(std::sqrt(square / number), 0.04);
}

TEST(Film, RunsOutAsRittersShallowWaterDoes) {
  const Film film = film_after(0.25 * cell, 1.5);
  EXPECT_EQ(film.wet, 0);
  expect_ritters(film, 0.25 * cell, 1.5);
}

TEST(Film, FormsFromWaterThatRunsOut) {
  const Film film = film_after(0.75 * cell, 1.5);
  EXPECT_GT(film.wet, 0);
  expect_ritters(film, 0.75 * cell, 1.5);
}

}  // namespace
}  // namespace polder
