#pragma once
// The part of every row of cells near which there are points. Loops over the grid visit nothing else: what lies beyond
// is empty and its fields rest at their neutral values. Also how the rows are dealt out to threads: by what is active
// in them, consecutive rows together, so that a thread meets the same cells again in every loop.
#include <algorithm>
#include <utility>
#include <vector>

#include "polder/grid/lattice.hpp"
#include "polder/math/threads.hpp"

namespace polder {

/// Cells begin … end − 1 of a row; empty where end ≤ begin.
struct RowSpan {
  int begin = 0, end = 0;
  int count() const { return end > begin ? end - begin : 0; }
  bool operator==(const RowSpan&) const = default;

  /// The smallest span that holds both.
  RowSpan joined(RowSpan other) const {
    if (count() == 0) return other;
    if (other.count() == 0) return *this;
    return {std::min(begin, other.begin), std::max(end, other.end)};
  }
};

/// Cuts rows into consecutive parts, one a thread, with about equally many cells each. Part r is [result[r],
/// result[r + 1]).
inline void deal_out(const std::vector<RowSpan>& spans, int parts, std::vector<std::ptrdiff_t>& bounds) {
  bounds.assign(static_cast<std::size_t>(parts) + 1, 0);
  cut_in_parts(
      static_cast<std::ptrdiff_t>(spans.size()), parts, [&](std::ptrdiff_t row) { return spans[row].count(); },
      [&](int part, std::ptrdiff_t, std::ptrdiff_t end) { bounds[static_cast<std::size_t>(part) + 1] = end; });
}

template <class Space>
struct ActiveRows {
  std::vector<RowSpan> spans;          ///< of row r = j + k · ny
  std::vector<std::ptrdiff_t> bounds;  ///< rows of each thread
  std::ptrdiff_t cell_count = 0;       ///< in all spans

  /// Every cell of the lattice, for `threads` threads.
  ActiveRows(const Lattice<Space>& lattice, int threads) {
    spans.assign(static_cast<std::size_t>(lattice.row_count()), {0, lattice.cells[0]});
    finish(threads);
  }

  void finish(int threads) {
    cell_count = 0;
    for (const RowSpan& span : spans) cell_count += span.count();
    deal_out(spans, threads, bounds);
  }
};

}  // namespace polder
