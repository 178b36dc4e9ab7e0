#pragma once
// Loops over the active faces and cells of a lattice, row by row, rows shared out over the team.
#include <cstdint>
#include <cstring>

#include "polder/grid/active_rows.hpp"
#include "polder/math/threads.hpp"

namespace polder {

/// Eight flags (0 or 1) at once, and what they are if all are 1.
inline std::uint64_t eight(const std::uint8_t* flags) {
  std::uint64_t word;
  std::memcpy(&word, flags, sizeof word);
  return word;
}
inline constexpr std::uint64_t eight_set = 0x0101010101010101;

/// body(first row, one past the last) on every thread that has rows, or once where sharing does not pay.
template <class Space, class Body>
void share_rows(const ActiveRows<Space>& rows, Team& team, Body&& body) {
  if (rows.cell_count < cells_worth_sharing || team.size() == 1)
    body(std::ptrdiff_t{0}, static_cast<std::ptrdiff_t>(rows.spans.size()));
  else
    team.run([&](int rank) { body(rows.bounds[rank], rows.bounds[rank + 1]); });
}

/// body(index of the first face, number of faces, place of the first one) for the active rows from `begin` to before
/// `end` of faces of component c, walls included. A place counts cells from the lattice's corner.
template <class Space, class Body>
void visit_face_rows(const Lattice<Space>& lattice, const ActiveRows<Space>& rows, int c, std::ptrdiff_t begin,
                     std::ptrdiff_t end, Body&& body) {
  for (std::ptrdiff_t row = begin; row < end; ++row) {
    const RowSpan span = rows.spans[row];
    if (span.count() == 0) continue;
    const int j = static_cast<int>(row % lattice.cells[1]), k = static_cast<int>(row / lattice.cells[1]);
    const auto visit = [&](int y, int z) {
      body(lattice.index(span.begin, y, z), span.count() + (c == 0), std::array<int, 3>{span.begin, y, z});
    };
    visit(j, k);  // and with the last row of cells, the faces beyond it
    if (c == 1 && j == lattice.cells[1] - 1) visit(j + 1, k);
    if (Space::axes == 3 && c == 2 && k == lattice.cells[2] - 1) visit(j, k + 1);
  }
}

/// body(index of the first cell, number of cells, place of the first one) for the active rows from `begin` to before
/// `end`.
template <class Space, class Body>
void visit_cell_rows(const Lattice<Space>& lattice, const ActiveRows<Space>& rows, std::ptrdiff_t begin,
                     std::ptrdiff_t end, Body&& body) {
  for (std::ptrdiff_t row = begin; row < end; ++row) {
    const RowSpan span = rows.spans[row];
    if (span.count() == 0) continue;
    const int j = static_cast<int>(row % lattice.cells[1]), k = static_cast<int>(row / lattice.cells[1]);
    body(lattice.index(span.begin, j, k), span.count(), std::array<int, 3>{span.begin, j, k});
  }
}

/// visit_face_rows() over all of them, shared out.
template <class Space, class Body>
void over_face_rows(const Lattice<Space>& lattice, const ActiveRows<Space>& rows, int c, Team& team, Body&& body) {
  share_rows(rows, team,
             [&](std::ptrdiff_t begin, std::ptrdiff_t end) { visit_face_rows(lattice, rows, c, begin, end, body); });
}

/// body(component, index of the first face, number of faces, place of the first one) over the rows of every component,
/// shared out at once.
template <class Space, class Body>
void over_all_face_rows(const Lattice<Space>& lattice, const ActiveRows<Space>& rows, Team& team, Body&& body) {
  share_rows(rows, team, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    for (int c = 0; c < Space::axes; ++c)
      visit_face_rows(lattice, rows, c, begin, end,
                      [&](std::ptrdiff_t first, int count, const auto& place) { body(c, first, count, place); });
  });
}

/// visit_cell_rows() over all of them, shared out.
template <class Space, class Body>
void over_cell_rows(const Lattice<Space>& lattice, const ActiveRows<Space>& rows, Team& team, Body&& body) {
  share_rows(rows, team,
             [&](std::ptrdiff_t begin, std::ptrdiff_t end) { visit_cell_rows(lattice, rows, begin, end, body); });
}

}  // namespace polder
