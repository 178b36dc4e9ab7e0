#pragma once
// The wells of a case that are there in a stage, as the cells that they take their water from.
#include <algorithm>
#include <cmath>
#include <map>

#include "polder/boundary/in_stage.hpp"
#include "polder/case/model.hpp"
#include "polder/grid/lattice.hpp"

namespace polder {

struct WellCells {
  Well well;
  std::vector<std::ptrdiff_t> cells;  ///< indices in the lattice
  std::vector<double> length;         ///< m, of the well in each; of a pipe across a plane section 1
  /// Direction of a line's axis; −1: a pipe across the section, or a line that follows no axis.
  int along = -1;
  bool line = false;
};

template <class Space>
WellCells well_cells(const Well& well, const Lattice<Space>& lattice) {
  WellCells found;
  found.well = well;
  std::array<double, 3> from = well.at.front(), to = well.at.back(), d{};
  double length = 0;
  for (int a = 0; a < Space::axes; ++a) {
    d[a] = to[a] - from[a];
    length += d[a] * d[a];
  }
  length = std::sqrt(length);
  found.line = length > 0;
  for (int a = 0; a < Space::axes; ++a)
    if (found.line && std::abs(d[a]) > 0.99 * length) found.along = a;
  const int pieces = found.line ? static_cast<int>(std::ceil(100 * length / lattice.smallest_spacing())) : 1;
  std::map<std::ptrdiff_t, double> by_cell;
  for (int i = 0; i < pieces; ++i) {
    std::array<int, 3> cell{0, 0, 0};
    for (int a = 0; a < Space::axes; ++a)
      cell[a] = std::clamp(static_cast<int>(lattice.axis[a].place(from[a] + (i + 0.5) / pieces * d[a])), 0,
                           lattice.cells[a] - 1);
    by_cell[lattice.index(cell[0], cell[1], cell[2])] += found.line ? length / pieces : 1;
  }
  for (const auto& [cell, part] : by_cell) {
    found.cells.push_back(cell);
    found.length.push_back(part);
  }
  return found;
}

/// Those that are there in stage number `stage`.
template <class Space>
std::vector<WellCells> make_wells(const Model& model, const Lattice<Space>& lattice, std::size_t stage) {
  std::vector<WellCells> wells;
  for (const Well& well : model.wells)
    if (in_stage(well, stage)) wells.push_back(well_cells(well, lattice));
  return wells;
}

}  // namespace polder
