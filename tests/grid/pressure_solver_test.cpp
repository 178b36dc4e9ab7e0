#include "polder/grid/pressure_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

namespace polder {
namespace {

/// −∇·(β∇) with a free surface on top; β is 1, or 1/contrast in a block; closed walls elsewhere.
template <class Space>
PressureSolver<Space> problem(const Lattice<Space>& lattice, double contrast) {
  PressureSolver<Space> solver(lattice);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto beta = [&](const std::array<int, 3>& cell) {
    return cell[0] > lattice.cells[0] / 2 && cell[Space::up] < lattice.cells[Space::up] / 3 ? 1 / contrast : 1.0;
  };
  for (std::ptrdiff_t row = 0; row < lattice.row_count(); ++row)
    for (int i = 0; i < lattice.cells[0]; ++i) {
      const std::array<int, 3> cell{i, static_cast<int>(row % lattice.cells[1]),
                                    static_cast<int>(row / lattice.cells[1])};
      const std::ptrdiff_t at = lattice.index(cell[0], cell[1], cell[2]);
      for (int a = 0; a < Space::axes; ++a) {
        std::array<int, 3> below = cell;
        --below[a];
        if (cell[a] > 0) {
          const double b = 2 / (1 / beta(cell) + 1 / beta(below));
          solver.matrix.coupling[a][at] = b;
          solver.matrix.diagonal[at] += b;
          solver.matrix.diagonal[at - lattice.stride[a]] += b;
        }
      }
      if (cell[Space::up] == lattice.cells[Space::up] - 1) solver.matrix.diagonal[at] += 2 * beta(cell);
      solver.right_side[at] = uniform(random);
    }
  return solver;
}

TEST(PressureSolver, ConvergesInFewIterations) {
  Team team(1);
  for (const int n : {32, 64, 128}) {
    const Lattice<PlaneStrain> lattice({n, n, 1}, {1, 1, 1});
    auto solver = problem(lattice, 1);
    Array x = lattice.make_array();
    const SolveResult result = solver.solve(ActiveRows(lattice, 1), x, 1e-6, 100, team);
    EXPECT_TRUE(result.converged);
    EXPECT_LE(result.iterations, 25) << n;
  }
}

TEST(PressureSolver, StandsLargeJumpsOfTheCoefficient) {
  Team team(1);
  for (const double contrast : {1e3, 1e6}) {
    const Lattice<PlaneStrain> lattice({96, 96, 1}, {1, 1, 1});
    auto solver = problem(lattice, contrast);
    Array x = lattice.make_array();
    const SolveResult result = solver.solve(ActiveRows(lattice, 1), x, 1e-6, 200, team);
    EXPECT_TRUE(result.converged) << contrast;
    EXPECT_LE(result.iterations, 60) << contrast;
  }
}

/// Water over sand with a layer and a lens of clay, a sheet pile from the water into the sand, an uneven surface: the
/// iterations that the pressure of a spring in the sand takes from zero to 1e-6.
template <class Space>
int iterations_around_sheet_pile(int n, double contrast) {
  constexpr int up = Space::up;
  std::array<int, 3> cells{2 * n, n, Space::axes == 3 ? n : 1};
  const Lattice<Space> lattice(cells, {1, 1, 1});
  const double width = cells[0], height = cells[up];
  const auto place = [&](const std::array<int, 3>& cell) {
    return std::pair{(cell[0] + 0.5) / width, (cell[up] + 0.5) / height};
  };
  const auto wet = [&](const std::array<int, 3>& cell) {
    return cell[up] < static_cast<int>(height * (0.85 + 0.05 * std::sin(6.28 * cell[0] / width)));
  };
  const auto beta = [&](const std::array<int, 3>& cell) {
    const auto [x, z] = place(cell);
    const bool layer = z > 0.35 && z<0.5, lens = z> 0.1 && z < 0.3 && x > 0.6 && x < 0.8;
    return layer || lens ? 1 / contrast : 1.0;
  };
  PressureSolver<Space> solver(lattice);
  over_all_cells(lattice, [&](std::ptrdiff_t at, const std::array<int, 3>& cell) {
    if (!wet(cell)) return;
    for (int a = 0; a < Space::axes; ++a) {
      std::array<int, 3> below = cell;
      --below[a];
      const bool pile = a == 0 && cell[0] == n && cell[up] >= 0.45 * height;
      if (cell[a] == 0 || !wet(below) || pile) continue;
      const double b = 2 / (1 / beta(cell) + 1 / beta(below));
      solver.matrix.coupling[a][at] = b;
      solver.matrix.diagonal[at] += b;
      solver.matrix.diagonal[at - lattice.stride[a]] += b;
    }
    std::array<int, 3> above = cell;
    ++above[up];
    if (!wet(above)) solver.matrix.diagonal[at] += 2 * beta(cell);
    const auto [x, z] = place(cell);
    solver.right_side[at] = std::abs(x - 0.25) < 0.03 && z > 0.2 && z < 0.3 ? 1 : 0;
  });
  Team team(1);
  Array x = lattice.make_array();
  const SolveResult result = solver.solve(ActiveRows(lattice, 1), x, 1e-6, 100, team);
  EXPECT_TRUE(result.converged) << n;
  return result.iterations;
}

TEST(PressureSolver, StandsClayBesideSandUnderWaterWithASheetPile) {
  for (const double contrast : {1.0, 1e3, 1e6}) {
    const int coarse = iterations_around_sheet_pile<PlaneStrain>(32, contrast);
    const int fine = iterations_around_sheet_pile<PlaneStrain>(128, contrast);
    EXPECT_LE(fine, 25) << contrast;
    EXPECT_LE(fine, 1.5 * coarse) << contrast;
    EXPECT_LE(iterations_around_sheet_pile<Solid>(32, contrast), 25) << contrast;
  }
}

template <class Space>
void check_threads(const std::array<int, 3>& cells) {
  const Lattice<Space> lattice(cells, {1, 1, 1});
  Array alone;
  for (const int threads : {1, 2, 3}) {
    Team team(threads);
    auto solver = problem(lattice, 10);
    Array x = lattice.make_array();
    EXPECT_TRUE(solver.solve(ActiveRows(lattice, 1), x, 1e-9, 100, team).converged);
    if (threads == 1)
      alone = x;
    else
      EXPECT_EQ(x, alone) << threads;
  }
}

TEST(PressureSolver, IsTheSameForAnyNumberOfThreads) {
  check_threads<PlaneStrain>({101, 67, 1});
  check_threads<Solid>({21, 18, 17});
}

/// Rows of which only [low, high) of each axis is active, and the problem there.
template <class Space>
ActiveRows<Space> part_of(const Lattice<Space>& lattice, int low, int high, PressureSolver<Space>& solver) {
  ActiveRows rows(lattice, 1);
  const auto whole = problem(lattice, 10);
  for (std::ptrdiff_t row = 0; row < lattice.row_count(); ++row) {
    const int j = static_cast<int>(row % lattice.cells[1]), k = static_cast<int>(row / lattice.cells[1]);
    const bool inside = j >= low && j < high && (Space::axes == 2 || (k >= low && k < high));
    rows.spans[row] = inside ? RowSpan{low, high} : RowSpan{};
    for (int i = low; inside && i < high; ++i) {
      const std::ptrdiff_t at = lattice.index(i, j, k);
      const int place[3] = {i, j, k};
      solver.matrix.diagonal[at] = whole.matrix.diagonal[at] + 1;
      solver.right_side[at] = whole.right_side[at];
      for (int a = 0; a < Space::axes; ++a)
        solver.matrix.coupling[a][at] = place[a] > low ? whole.matrix.coupling[a][at] : 0;
    }
  }
  rows.finish(1);
  return rows;
}

template <class Space>
void check_moving(const std::array<int, 3>& cells) {
  const Lattice<Space> lattice(cells, {1, 1, 1});
  PressureSolver<Space> solver(lattice);
  for (const auto& [low, high] : {std::pair{3, 15}, std::pair{7, 17}, std::pair{0, 9}, std::pair{4, 5}}) {
    PressureSolver<Space> fresh(lattice);
    Array x = lattice.make_array(), y = lattice.make_array();
    for (Team team(2); auto* solve : {&solver, &fresh}) {
      const ActiveRows rows = part_of(lattice, low, high, *solve);
      EXPECT_TRUE(solve->solve(rows, solve == &solver ? x : y, 1e-9, 100, team).converged);
    }
    EXPECT_EQ(x, y) << low << " to " << high;
  }
}

TEST(PressureSolver, KeepsNothingOfRowsThatAreNoLongerActive) {
  check_moving<PlaneStrain>({30, 18, 1});
  check_moving<Solid>({21, 18, 17});
}

/// Right sides that change by as much again from solve to solve, and what each takes from where the last ended.
std::vector<int> iterations_of_steady_change(Team& team, bool with_trend, Array& x, Array& trend) {
  const Lattice<PlaneStrain> lattice({96, 96, 1}, {1, 1, 1});
  auto solver = problem(lattice, 10);
  const Array first = solver.right_side;
  x = lattice.make_array();
  trend = lattice.make_array();
  std::vector<int> iterations;
  for (int number = 0; number < 4; ++number) {
    over_all_cells(lattice, [&](std::ptrdiff_t at, const std::array<int, 3>& cell) {
      solver.right_side[at] = first[at] + number * 0.01 * std::cos(0.1 * cell[0]);
    });
    const SolveResult result = solver.solve(ActiveRows(lattice, 1), x, 1e-6, 100, team, with_trend ? &trend : nullptr);
    EXPECT_TRUE(result.converged) << number;
    iterations.push_back(result.iterations);
  }
  return iterations;
}

TEST(PressureSolver, ATrendGoesOn) {
  Team alone(1), two(2);
  Array x, trend, without, unused;
  const auto plain = iterations_of_steady_change(alone, false, without, unused);
  const auto ahead = iterations_of_steady_change(alone, true, x, trend);
  EXPECT_EQ(ahead[0], plain[0]);  // a trend of zero does nothing
  EXPECT_GE(plain[3], 4);
  EXPECT_LE(ahead[3], 1);
  const double largest = largest_magnitude(x.data(), static_cast<std::ptrdiff_t>(x.size()));
  for (std::size_t at = 0; at < x.size(); ++at) EXPECT_NEAR(x[at], without[at], 1e-5 * largest);

  Array x_of_two, trend_of_two;
  iterations_of_steady_change(two, true, x_of_two, trend_of_two);
  EXPECT_EQ(x_of_two, x);
  EXPECT_EQ(trend_of_two, trend);
}

TEST(PressureSolver, ATrendThatIsWrongIsNotFollowed) {
  const Lattice<PlaneStrain> lattice({64, 64, 1}, {1, 1, 1});
  Team team(1);
  std::vector<int> iterations;
  for (const double wrong : {0.0, 1e3}) {
    auto solver = problem(lattice, 10);
    Array x = lattice.make_array(), trend = lattice.make_array(), before = x;
    over_all_cells(lattice, [&](std::ptrdiff_t at, const std::array<int, 3>& cell) {
      x[at] = before[at] = std::sin(0.3 * cell[1]);
      trend[at] = wrong * std::cos(2.9 * cell[0]);
    });
    const SolveResult result = solver.solve(ActiveRows(lattice, 1), x, 1e-6, 100, team, &trend);
    EXPECT_TRUE(result.converged);
    iterations.push_back(result.iterations);
    for (std::size_t at = 0; at < x.size(); ++at) EXPECT_EQ(trend[at], x[at] - before[at]);
  }
  EXPECT_LE(iterations[1], iterations[0] + 1);
}

TEST(PressureSolver, SolvesWhatItSays) {
  const Lattice<Solid> lattice({9, 7, 8}, {1, 1, 1});
  auto solver = problem(lattice, 100);
  Team team(1);
  Array x = lattice.make_array();
  ASSERT_TRUE(solver.solve(ActiveRows(lattice, 1), x, 1e-10, 200, team).converged);
  double worst = 0, largest = 0;
  for (std::ptrdiff_t row = 0; row < lattice.row_count(); ++row)
    for (int i = 0; i < lattice.cells[0]; ++i) {
      const std::ptrdiff_t at = lattice.index(i, static_cast<int>(row % 7), static_cast<int>(row / 7));
      double y = solver.matrix.diagonal[at] * x[at];
      for (int a = 0; a < 3; ++a) {
        const std::ptrdiff_t s = lattice.stride[a];
        y -= solver.matrix.coupling[a][at] * x[at - s] + solver.matrix.coupling[a][at + s] * x[at + s];
      }
      worst = std::max(worst, std::abs(y - solver.right_side[at]));
      largest = std::max(largest, std::abs(solver.right_side[at]));
    }
  EXPECT_LT(worst, 1e-8 * largest);
}

}  // namespace
}  // namespace polder
