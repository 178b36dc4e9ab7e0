#pragma once
// Preconditioner of the pressure solve: one V-cycle of aggregation multigrid in single precision.
//
// Levels: cells are aggregated 2 × 2 (× 2), the coarse operator is Galerkin's (sums of couplings) divided by 1.8, which
// makes up for the piecewise-constant prolongation. Smoothing: two red-black Gauss–Seidel sweeps before, two in reverse
// order after, so that the cycle is symmetric; the coarsest level is solved by a Cholesky factorisation.
//
// Layout: the cells of a colour are stored contiguously, row by row. In a row of parity p = (j + k) mod 2 the colour c
// holds the cells i = 2m + q with q = p for red (c = 0), 1 − p for black. The neighbours of cell m along x are the
// other colour's m − 1 + q and m + q, those along y and z the other colour's m in the rows beside: every sweep is a
// loop over contiguous values without branches, eight at a time: rows are padded so that a last block may reach beyond
// its row's end. Couplings are stored at the upper cell of a pair. Cells outside the system, padding included, have
// zero inverse diagonals, couplings, right sides and values, so that sweeps may pass over them.
#include <array>
#include <vector>

#include "polder/grid/active_rows.hpp"
#include "polder/math/threads.hpp"

namespace polder {

/// A symmetric M-matrix over the cells of a lattice: y_i = diagonal_i x_i − Σ coupling x_neighbour, coupling[a] at a
/// cell to its lower neighbour on axis a (≥ 0). Cells with diagonal 0 are not part of the system; nothing couples to
/// them.
template <class Space>
struct CellMatrix {
  Array diagonal;
  std::array<Array, Space::axes> coupling;
  /// Of a periodic lattice, at the first cell of each row: its coupling to the row's last cell. The preconditioner does
  /// without it.
  Array seam;

  explicit CellMatrix(const Lattice<Space>& lattice) : diagonal(lattice.make_array()), seam(lattice.make_array()) {
    for (auto& a : coupling) a = lattice.make_array();
  }
};

template <class Space>
class Multigrid {
 public:
  explicit Multigrid(const Lattice<Space>& lattice);

  /// Builds all levels from the matrix, which is 0 outside `inside` (a span per row). Called by every thread of the
  /// team from inside Team::run.
  void build(const CellMatrix<Space>& matrix, const std::vector<RowSpan>& inside, Team& team, int rank);

  /// The cycle: z ≈ A⁻¹ r. Rows of r go in, times `scale` (which keeps single precision in range), and rows of z come
  /// out, each row handled by the thread that deal_out() gives it; cycle() is called from inside Team::run.
  void load_row(std::ptrdiff_t row, const Array& r, double scale);
  void cycle(Team& team, int rank);
  void unload_row(std::ptrdiff_t row, Array& z, double back) const;

  int level_count() const { return static_cast<int>(levels_.size()); }

 private:
  static constexpr int axes = Space::axes;
  using Floats = AlignedVector<float>;

  /// The cells 2m + q, begin ≤ m < end, that a colour has in a row's span; the row begins at `row` in the arrays.
  struct ColourRow {
    std::ptrdiff_t row = 0;
    int begin = 0, end = 0, q = 0;
    std::ptrdiff_t at() const { return row + begin; }
    std::ptrdiff_t count() const { return end - begin; }
  };
  struct Colour {
    Floats inverse, diagonal, right_side, value;
    std::array<Floats, axes> coupling;
    std::vector<ColourRow> inside;  // of every row of the level
  };
  struct Level {
    std::array<int, 3> cells{1, 1, 1};
    std::array<std::ptrdiff_t, 3> natural_stride{1, 0, 0};  // of the natural (uncoloured) arrays
    std::ptrdiff_t natural_origin = 0;
    std::ptrdiff_t row_length = 0;                    // of a coloured row, padding included
    std::array<std::ptrdiff_t, 3> row_step{0, 0, 0};  // from a coloured row to its neighbour on axis 1, 2
    std::ptrdiff_t first_row = 0;
    std::array<Colour, 2> colour;
    Array diagonal;  // natural, of coarse levels
    std::array<Array, axes> coupling;
    AlignedVector<float> row_sum;  // natural coarse rows while restricting and prolonging
    std::vector<RowSpan> inside;   // cells of the system, per row
    std::vector<RowSpan> touched;  // and those of the last build, which this one has to clear
    std::vector<std::ptrdiff_t> bounds;
    std::ptrdiff_t cell_count = 0;  // inside
    std::ptrdiff_t rows() const { return static_cast<std::ptrdiff_t>(cells[1]) * cells[2]; }
  };

  void colour_level(Level& level, const Array& diagonal, const std::array<Array, axes>& coupling, std::ptrdiff_t row0,
                    std::ptrdiff_t row1);
  void coarsen(const Level& fine, const Array& diagonal, const std::array<Array, axes>& coupling, Level& coarse,
               std::ptrdiff_t row0, std::ptrdiff_t row1);
  void spread_inside(const std::vector<RowSpan>& inside, int parts);
  void factor_coarsest();
  void solve_coarsest();
  void smooth(Level& level, int colour, bool from_zero, std::ptrdiff_t row0, std::ptrdiff_t row1);
  void restrict_to(Level& fine, Level& coarse, std::ptrdiff_t row0, std::ptrdiff_t row1);
  void prolong_to(Level& coarse, Level& fine, std::ptrdiff_t row0, std::ptrdiff_t row1);
  void cycle_from(std::size_t l, Team& team, int rank);
  void cycle_alone(std::size_t l);
  bool shared(const Level& level) const;

  std::ptrdiff_t coloured_row(const Level& level, std::ptrdiff_t row) const {
    const std::ptrdiff_t j = row % level.cells[1], k = row / level.cells[1];
    return level.first_row + j * level.row_step[1] + k * level.row_step[2];
  }
  std::ptrdiff_t natural_row(const Level& level, std::ptrdiff_t row) const {
    const std::ptrdiff_t j = row % level.cells[1], k = row / level.cells[1];
    return level.natural_origin + j * level.natural_stride[1] + k * level.natural_stride[2];
  }
  ColourRow colour_row(const Level& level, std::ptrdiff_t row, int c, RowSpan span) const {
    const int q = c == 0 ? parity(level, row) : 1 - parity(level, row);
    return {coloured_row(level, row), (span.begin - q + 1) / 2, (span.end - q + 1) / 2, q};
  }
  /// Of a row of row_sum: its cells and room for a last block.
  static std::ptrdiff_t sum_length(const Level& level) { return level.cells[0] + 9; }
  static int parity(const Level& level, std::ptrdiff_t row) {
    return static_cast<int>((row % level.cells[1] + row / level.cells[1]) & 1);
  }

  std::vector<Level> levels_;
  std::vector<double> factor_;  // lower triangle of the coarsest matrix
  std::vector<std::ptrdiff_t> coarse_cells_;
  std::vector<double> coarse_value_;
};

}  // namespace polder
