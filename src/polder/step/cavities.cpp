#include "polder/step/cavities.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>

#include "polder/step/face_loop.hpp"
#include "polder/step/interior.hpp"

namespace polder {

namespace {

constexpr int most_rounds = 20;
constexpr double full = 0.95;  // fill of a cell without a void: points are never spread evenly

using Cells = std::vector<std::ptrdiff_t>;  // ascending

Cells either(const Cells& a, const Cells& b) {
  Cells cells;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(cells));
  return cells;
}
Cells both(const Cells& a, const Cells& b) {
  Cells cells;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(cells));
  return cells;
}
Cells without(const Cells& a, const Cells& b) {
  Cells cells;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(cells));
  return cells;
}

/// The cells whose pressure is at most `limit`; what is dry has none but in a void.
template <class Space>
Cells cells_at_most(const Setup<Space>& setup, const GridFields<Space>& grid, double limit) {
  Cells cells;
  Team alone(1);
  over_cell_rows(setup.lattice, grid.rows, alone, [&](std::ptrdiff_t first, int count, const auto&) {
    const double* pressure = grid.pressure.data() + first;
    std::int64_t number = 0;
    for (int i = 0; i < count; ++i) number += pressure[i] <= limit;
    if (number == 0) return;
    for (int i = 0; i < count; ++i)
      if (pressure[i] <= limit) cells.push_back(first + i);
  });
  std::sort(cells.begin(), cells.end());
  return cells;
}

/// The equations of a solver with the pressure given in some cells: these are out of the matrix, and their neighbours
/// have them on the right side.
template <class Space>
class HeldCells {
 public:
  HeldCells(const Lattice<Space>& lattice, double pressure, PressureSolver<Space>& solver)
      : lattice_(lattice), pressure_(pressure), solver_(solver) {}

  /// Holds these cells and no others.
  void hold(const Cells& cells) {
    release();
    for (const std::ptrdiff_t cell : cells) equations_.push_back(equation_of(cell));
    for (const Equation& equation : equations_)
      for (const Link& link : equation.links) {
        solver_.right_side[link.cell] += link.coupling * pressure_;
        *link.entry = 0;
      }
    for (const std::ptrdiff_t cell : cells) solver_.right_side[cell] = solver_.matrix.diagonal[cell] * pressure_;
  }

  /// The cells whose void is full and into which more flows than out of them, at the pressures that were found.
  Cells closed(const GridFields<Space>& grid) const {
    Cells cells;
    for (const Equation& equation : equations_) {
      double out = solver_.matrix.diagonal[equation.cell] * grid.pressure[equation.cell] - equation.right_side;
      for (const Link& link : equation.links) out -= link.coupling * grid.pressure[link.cell];
      if (out < 0 && grid.fill[equation.cell] >= full) cells.push_back(equation.cell);
    }
    return cells;
  }

 private:
  struct Link {
    std::ptrdiff_t cell;
    double* entry;
    double coupling;
  };
  struct Equation {
    std::ptrdiff_t cell;
    double right_side;
    std::vector<Link> links;
  };

  Equation equation_of(std::ptrdiff_t cell) {
    auto& matrix = solver_.matrix;
    Equation equation{cell, solver_.right_side[cell], {}};
    const auto link = [&](std::ptrdiff_t other, double& entry) {
      if (entry > 0) equation.links.push_back({other, &entry, entry});
    };
    for (int a = 0; a < Space::axes; ++a) {
      const std::ptrdiff_t s = lattice_.stride[a];
      link(cell - s, matrix.coupling[a][cell]);
      link(cell + s, matrix.coupling[a][cell + s]);
    }
    const int place = lattice_.place(cell, 0), last = lattice_.cells[0] - 1;
    if (place == 0) link(cell + last, matrix.seam[cell]);
    if (place == last) link(cell - last, matrix.seam[cell - last]);
    return equation;
  }

  void release() {
    for (const Equation& equation : equations_)
      for (const Link& link : equation.links) {
        solver_.right_side[link.cell] -= link.coupling * pressure_;
        *link.entry = link.coupling;
      }
    for (const Equation& equation : equations_) solver_.right_side[equation.cell] = equation.right_side;
    equations_.clear();
  }

  const Lattice<Space>& lattice_;
  double pressure_;
  PressureSolver<Space>& solver_;
  std::vector<Equation> equations_;
};

}  // namespace

template <class Space>
void keep_cavities(const Setup<Space>& setup, GridFields<Space>& grid) {
  Cells& cells = grid.cavities;
  cells = cells_at_most(setup, grid, 0.99 * setup.water.cavitation_pressure);
  if (cells.empty()) return;
  Cells voids;
  for (const std::ptrdiff_t cell : cells)
    if (!grid.wet[cell]) voids.push_back(cell), grid.wet[cell] = 1;
  for (bool aired = true; aired;) {  // air comes in from cell to cell
    join_ends(grid.wet, setup.water_box, setup.lattice);
    aired = false;
    for (const std::ptrdiff_t cell : voids) {
      if (!grid.wet[cell] || is_inside_water(setup, grid, cell, setup.lattice.places(cell))) continue;
      grid.wet[cell] = 0;
      grid.pressure[cell] = 0;
      aired = true;
    }
  }
  std::erase_if(cells, [&](std::ptrdiff_t cell) { return !grid.wet[cell]; });
}

template <class Space>
SolveResult solve_with_cavities(const Setup<Space>& setup, GridFields<Space>& grid, PressureSolver<Space>& solver,
                                Team& team) {
  const double limit = setup.water.cavitation_pressure;
  HeldCells<Space> equations(setup.lattice, limit, solver);
  Cells held = grid.cavities, may_close = held;
  SolveResult result;
  for (int round = 0; round < most_rounds; ++round) {
    equations.hold(held);
    const SolveResult last = solver.solve(grid.rows, grid.pressure, setup.numerics.pressure_tolerance, 400, team,
                                          round == 0 ? &grid.pressure_trend : nullptr);
    result = {result.iterations + last.iterations, last.residual, last.converged};
    // each of them may be let go once, so that the search ends
    const Cells closed = both(equations.closed(grid), may_close);
    Cells next = without(either(held, cells_at_most(setup, grid, limit)), closed);
    if (next == held) break;
    may_close = without(may_close, closed);
    held = std::move(next);
  }
  return result;
}

template void keep_cavities(const Setup<PlaneStrain>&, GridFields<PlaneStrain>&);
template void keep_cavities(const Setup<Solid>&, GridFields<Solid>&);
template SolveResult solve_with_cavities(const Setup<PlaneStrain>&, GridFields<PlaneStrain>&,
                                         PressureSolver<PlaneStrain>&, Team&);
template SolveResult solve_with_cavities(const Setup<Solid>&, GridFields<Solid>&, PressureSolver<Solid>&, Team&);

}  // namespace polder
