#include "polder/grid/multigrid.hpp"

#include <algorithm>
#include <cmath>

#include "polder/math/simd.hpp"

namespace polder {

namespace {
constexpr double coarse_scale = 1 / 1.8;
constexpr std::ptrdiff_t coarsest_cells = 40;
constexpr std::ptrdiff_t lanes = 8;
// Of a level, for its sweeps to be shared: they wait at barriers of a team that is awake, which costs less than waking
// it for a loop (cells_worth_sharing).
constexpr std::ptrdiff_t cells_worth_a_barrier = 1500;
}  // namespace

template <class Space>
Multigrid<Space>::Multigrid(const Lattice<Space>& lattice) {
  std::array<int, 3> cells = lattice.cells;
  while (true) {
    Level level;
    level.cells = cells;
    if (levels_.empty()) {
      level.natural_stride = lattice.stride;
      level.natural_origin = lattice.index(0, 0, 0);
    } else {
      const std::ptrdiff_t nx = cells[0] + 2, ny = cells[1] + 2;
      level.natural_stride = {1, nx, axes == 3 ? nx * ny : 0};
      level.natural_origin = 1 + nx + level.natural_stride[2];
      const std::size_t size = static_cast<std::size_t>(nx * ny * (axes == 3 ? cells[2] + 2 : 1));
      level.diagonal.assign(size, 0.0);
      for (auto& a : level.coupling) a.assign(size, 0.0);
    }
    level.row_length = ((cells[0] + 1) / 2 + 7) / 8 * 8 + 8;
    level.row_step = {0, level.row_length, axes == 3 ? level.row_length * (cells[1] + 2) : 0};
    level.first_row = 1 + level.row_step[1] + level.row_step[2];
    const std::size_t size =
        static_cast<std::size_t>(level.row_length * (cells[1] + 2) * (axes == 3 ? cells[2] + 2 : 1) + 16);
    for (auto& colour : level.colour) {
      for (auto* a : {&colour.inverse, &colour.diagonal, &colour.right_side, &colour.value}) a->assign(size, 0.0F);
      for (auto& a : colour.coupling) a.assign(size, 0.0F);
    }
    level.row_sum.assign(static_cast<std::size_t>(level.rows() * sum_length(level)), 0.0F);
    level.inside.resize(static_cast<std::size_t>(level.rows()));
    level.touched = level.inside;
    for (auto& colour : level.colour) colour.inside.resize(level.inside.size());
    levels_.push_back(std::move(level));

    const std::ptrdiff_t total = static_cast<std::ptrdiff_t>(cells[0]) * cells[1] * cells[2];
    if (total <= coarsest_cells) break;
    for (int a = 0; a < axes; ++a) cells[a] = (cells[a] + 1) / 2;
  }
}

template <class Space>
bool Multigrid<Space>::shared(const Level& level) const {
  return level.cell_count >= cells_worth_a_barrier;
}

template <class Space>
void Multigrid<Space>::spread_inside(const std::vector<RowSpan>& inside, int parts) {
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    Level& level = levels_[l];
    level.touched = level.inside;
    if (l == 0) {
      level.inside = inside;
    } else {
      const Level& fine = levels_[l - 1];
      std::fill(level.inside.begin(), level.inside.end(), RowSpan{});
      for (std::ptrdiff_t row = 0; row < fine.rows(); ++row) {
        const RowSpan span = fine.inside[row];
        if (span.count() == 0) continue;
        const std::ptrdiff_t j = row % fine.cells[1], k = row / fine.cells[1];
        RowSpan& coarse = level.inside[j / 2 + (axes == 3 ? k / 2 : 0) * level.cells[1]];
        coarse = coarse.joined({span.begin / 2, (span.end + 1) / 2});
      }
    }
    level.cell_count = 0;
    for (std::ptrdiff_t row = 0; row < level.rows(); ++row) {
      const RowSpan span = level.inside[row];
      level.cell_count += span.count();
      if (level.touched[row] == span) continue;
      level.touched[row] = level.touched[row].joined(span);
      for (int c = 0; c < 2; ++c) level.colour[c].inside[row] = colour_row(level, row, c, span);
    }
    deal_out(level.inside, parts, level.bounds);
  }
}

template <class Space>
void Multigrid<Space>::colour_level(Level& level, const Array& diagonal, const std::array<Array, axes>& coupling,
                                    std::ptrdiff_t row0, std::ptrdiff_t row1) {
  for (std::ptrdiff_t row = row0; row < row1; ++row) {
    const std::ptrdiff_t from = natural_row(level, row);
    for (int c = 0; c < 2; ++c) {
      Colour& colour = level.colour[c];
      const auto [to, begin, end, q] = colour_row(level, row, c, level.touched[row]);
      for (std::ptrdiff_t m = begin; m < end; ++m) {
        const double d = diagonal[from + 2 * m + q];
        colour.diagonal[to + m] = static_cast<float>(d);
        colour.inverse[to + m] = d > 0 ? static_cast<float>(1 / d) : 0.0F;
        if (d > 0) continue;
        colour.right_side[to + m] = colour.value[to + m] = 0;
      }
      for (int a = 0; a < axes; ++a)
        for (std::ptrdiff_t m = begin; m < end; ++m)
          colour.coupling[a][to + m] = static_cast<float>(coupling[a][from + 2 * m + q]);
    }
  }
}

template <class Space>
void Multigrid<Space>::coarsen(const Level& fine, const Array& diagonal, const std::array<Array, axes>& coupling,
                               Level& coarse, std::ptrdiff_t row0, std::ptrdiff_t row1) {
  const int nx = fine.cells[0];
  for (std::ptrdiff_t row = row0; row < row1; ++row) {
    const RowSpan span = coarse.touched[row];
    if (span.count() == 0) continue;
    const std::ptrdiff_t J = row % coarse.cells[1], K = row / coarse.cells[1];
    const std::ptrdiff_t to = natural_row(coarse, row);
    double* d = coarse.diagonal.data() + to;
    std::array<double*, axes> link{};
    for (int a = 0; a < axes; ++a) {
      link[a] = coarse.coupling[a].data() + to;
      std::fill(link[a] + span.begin, link[a] + span.end, 0.0);
    }
    std::fill(d + span.begin, d + span.end, 0.0);
    for (std::ptrdiff_t k = 2 * K; k < std::min<std::ptrdiff_t>(2 * K + (axes == 3 ? 2 : 1), fine.cells[2]); ++k)
      for (std::ptrdiff_t j = 2 * J; j < std::min<std::ptrdiff_t>(2 * J + 2, fine.cells[1]); ++j) {
        const std::ptrdiff_t from = natural_row(fine, j + k * fine.cells[1]);
        const double* fd = diagonal.data() + from;
        const double* fx = coupling[0].data() + from;
        const double* fy = coupling[1].data() + from;
        const double* fz = axes == 3 ? coupling[axes - 1].data() + from : nullptr;
        const bool inner_y = j % 2 == 1, inner_z = k % 2 == 1;
        const auto add = [&](std::ptrdiff_t I, std::ptrdiff_t i) {
          double sum = fd[i];
          if (inner_y)
            sum -= 2 * fy[i];
          else
            link[1][I] += fy[i];
          if constexpr (axes == 3) {
            if (inner_z)
              sum -= 2 * fz[i];
            else
              link[axes - 1][I] += fz[i];
          }
          return sum;
        };
        std::ptrdiff_t I = span.begin;
        for (; I < span.end && 2 * I + 1 < nx; ++I) {
          link[0][I] += fx[2 * I];
          d[I] += add(I, 2 * I) + add(I, 2 * I + 1) - 2 * fx[2 * I + 1];
        }
        if (I < span.end) {
          link[0][I] += fx[2 * I];
          d[I] += add(I, 2 * I);
        }
      }
    for (int I = span.begin; I < span.end; ++I) {
      d[I] *= coarse_scale;
      for (int a = 0; a < axes; ++a) link[a][I] *= coarse_scale;
    }
  }
}

template <class Space>
void Multigrid<Space>::factor_coarsest() {
  const Level& level = levels_.back();
  coarse_cells_.clear();
  std::vector<int> number(level.colour[0].inverse.size() * 2 + 1, -1);
  const auto place = [&](int i, std::ptrdiff_t row) {
    const int p = parity(level, row), c = i % 2 == p ? 0 : 1;
    return 2 * (coloured_row(level, row) + i / 2) + c;
  };
  for (std::ptrdiff_t row = 0; row < level.rows(); ++row)
    for (int i = 0; i < level.cells[0]; ++i) {
      const std::ptrdiff_t at = place(i, row);
      if (level.colour[at % 2].inverse[at / 2] > 0) {
        number[at] = static_cast<int>(coarse_cells_.size());
        coarse_cells_.push_back(at);
      }
    }
  const std::size_t n = coarse_cells_.size();
  factor_.assign(n * n, 0.0);
  coarse_value_.assign(n, 0.0);
  for (std::ptrdiff_t row = 0; row < level.rows(); ++row)
    for (int i = 0; i < level.cells[0]; ++i) {
      const std::ptrdiff_t at = place(i, row);
      const int me = number[at];
      if (me < 0) continue;
      const Colour& colour = level.colour[at % 2];
      factor_[me * n + me] = static_cast<double>(colour.diagonal[at / 2]);
      const auto link = [&](int axis, std::ptrdiff_t other) {
        const int lower = number[other];
        const auto value = static_cast<double>(colour.coupling[axis][at / 2]);
        if (lower >= 0 && value > 0) factor_[me * n + lower] = factor_[lower * n + me] = -value;
      };
      if (i > 0) link(0, place(i - 1, row));
      if (row % level.cells[1] > 0) link(1, place(i, row - 1));
      if (axes == 3 && row >= level.cells[1]) link(axes - 1, place(i, row - level.cells[1]));
    }
  for (std::size_t c = 0; c < n; ++c) {  // Cholesky, in place, lower triangle
    const double original = factor_[c * n + c];
    double pivot = original;
    for (std::size_t k = 0; k < c; ++k) pivot -= factor_[c * n + k] * factor_[c * n + k];
    pivot = std::sqrt(std::max(pivot, 1e-6 * original));  // a floating part has no level of its own: damp it
    factor_[c * n + c] = pivot;
    for (std::size_t r = c + 1; r < n; ++r) {
      double sum = factor_[r * n + c];
      for (std::size_t k = 0; k < c; ++k) sum -= factor_[r * n + k] * factor_[c * n + k];
      factor_[r * n + c] = sum / pivot;
    }
  }
}

template <class Space>
void Multigrid<Space>::solve_coarsest() {
  Level& level = levels_.back();
  const std::size_t n = coarse_cells_.size();
  auto& y = coarse_value_;
  for (std::size_t r = 0; r < n; ++r) {
    const std::ptrdiff_t at = coarse_cells_[r];
    double sum = static_cast<double>(level.colour[at % 2].right_side[at / 2]);
    for (std::size_t c = 0; c < r; ++c) sum -= factor_[r * n + c] * y[c];
    y[r] = sum / factor_[r * n + r];
  }
  for (std::size_t r = n; r-- > 0;) {
    for (std::size_t c = r + 1; c < n; ++c) y[r] -= factor_[c * n + r] * y[c];
    y[r] /= factor_[r * n + r];
    const std::ptrdiff_t at = coarse_cells_[r];
    level.colour[at % 2].value[at / 2] = static_cast<float>(y[r]);
  }
}

template <class Space>
void Multigrid<Space>::smooth(Level& level, int c, bool from_zero, std::ptrdiff_t row0, std::ptrdiff_t row1) {
  Colour& mine = level.colour[c];
  const Colour& other = level.colour[1 - c];
  for (std::ptrdiff_t row = row0; row < row1; ++row) {
    const ColourRow& cells = mine.inside[row];
    const std::ptrdiff_t at = cells.at(), count = cells.count();
    const int q = cells.q;
    float* __restrict x = mine.value.data() + at;
    const float* inverse = mine.inverse.data() + at;
    const float* b = mine.right_side.data() + at;
    if (from_zero) {
      for (std::ptrdiff_t m = 0; m < count; m += lanes) store8(x + m, load8(inverse + m) * load8(b + m));
      continue;
    }
    const std::ptrdiff_t dy = level.row_step[1], dz = level.row_step[2];
    const float* left = mine.coupling[0].data() + at;
    const float* right = other.coupling[0].data() + at + q;
    const float* o = other.value.data() + at + q;
    const float* down = mine.coupling[1].data() + at;
    const float* up = other.coupling[1].data() + at + dy;
    const float* oy = other.value.data() + at;
    const float* back = axes == 3 ? mine.coupling[axes - 1].data() + at : nullptr;
    const float* front = axes == 3 ? other.coupling[axes - 1].data() + at + dz : nullptr;
    for (std::ptrdiff_t m = 0; m < count; m += lanes) {
      Vec8f sum = load8(b + m) + load8(left + m) * load8(o + m - 1) + load8(right + m) * load8(o + m) +
                  load8(down + m) * load8(oy + m - dy) + load8(up + m) * load8(oy + m + dy);
      if constexpr (axes == 3) sum += load8(back + m) * load8(oy + m - dz) + load8(front + m) * load8(oy + m + dz);
      store8(x + m, load8(inverse + m) * sum);
    }
  }
}

template <class Space>
void Multigrid<Space>::restrict_to(Level& fine, Level& coarse, std::ptrdiff_t row0, std::ptrdiff_t row1) {
  // the sweep before ended with black, whose residual is zero: only red counts
  const Colour& red = fine.colour[0];
  const Colour& black = fine.colour[1];
  for (std::ptrdiff_t row = row0; row < row1; ++row) {
    const std::ptrdiff_t J = row % coarse.cells[1], K = row / coarse.cells[1];
    const RowSpan span = coarse.inside[row];
    if (span.count() == 0) continue;
    float* sum = coarse.row_sum.data() + row * sum_length(coarse);
    std::fill(sum, sum + sum_length(coarse), 0.0F);
    for (std::ptrdiff_t k = 2 * K; k < std::min<std::ptrdiff_t>(2 * K + (axes == 3 ? 2 : 1), fine.cells[2]); ++k)
      for (std::ptrdiff_t j = 2 * J; j < std::min<std::ptrdiff_t>(2 * J + 2, fine.cells[1]); ++j) {
        const std::ptrdiff_t fine_row = j + k * fine.cells[1];
        const ColourRow& cells = red.inside[fine_row];
        const std::ptrdiff_t at = cells.at(), count = cells.count();
        const int q = cells.q;
        const std::ptrdiff_t dy = fine.row_step[1], dz = fine.row_step[2];
        const float *x = red.value.data() + at, *b = red.right_side.data() + at, *d = red.diagonal.data() + at;
        const float *left = red.coupling[0].data() + at, *right = black.coupling[0].data() + at + q;
        const float *down = red.coupling[1].data() + at, *up = black.coupling[1].data() + at + dy;
        const float *o = black.value.data() + at + q, *oy = black.value.data() + at;
        const float* back = axes == 3 ? red.coupling[axes - 1].data() + at : nullptr;
        const float* front = axes == 3 ? black.coupling[axes - 1].data() + at + dz : nullptr;
        for (std::ptrdiff_t m = 0; m < count; m += lanes) {
          Vec8f r = load8(b + m) - load8(d + m) * load8(x + m) + load8(left + m) * load8(o + m - 1) +
                    load8(right + m) * load8(o + m) + load8(down + m) * load8(oy + m - dy) +
                    load8(up + m) * load8(oy + m + dy);
          if constexpr (axes == 3) r += load8(back + m) * load8(oy + m - dz) + load8(front + m) * load8(oy + m + dz);
          store8(sum + cells.begin + m, load8(sum + cells.begin + m) + r);
        }
      }
    for (Colour& colour : coarse.colour) {
      const auto [start, begin, end, q] = colour.inside[row];
      float* b = colour.right_side.data() + start;
      for (std::ptrdiff_t m = begin; m < end; ++m) b[m] = sum[2 * m + q];
    }
  }
}

template <class Space>
void Multigrid<Space>::prolong_to(Level& coarse, Level& fine, std::ptrdiff_t row0, std::ptrdiff_t row1) {
  for (std::ptrdiff_t row = row0; row < row1; ++row) {
    const RowSpan span = coarse.inside[row];
    if (span.count() == 0) continue;
    const std::ptrdiff_t J = row % coarse.cells[1], K = row / coarse.cells[1];
    float* e = coarse.row_sum.data() + row * sum_length(coarse);  // the coarse row in natural order
    for (const Colour& colour : coarse.colour) {
      const auto [start, begin, end, Q] = colour.inside[row];
      const float* value = colour.value.data() + start;
      for (std::ptrdiff_t M = begin; M < end; ++M) e[2 * M + Q] = value[M];
    }
    for (std::ptrdiff_t k = 2 * K; k < std::min<std::ptrdiff_t>(2 * K + (axes == 3 ? 2 : 1), fine.cells[2]); ++k)
      for (std::ptrdiff_t j = 2 * J; j < std::min<std::ptrdiff_t>(2 * J + 2, fine.cells[1]); ++j)
        for (Colour& colour : fine.colour) {
          const auto [start, begin, end, q] = colour.inside[j + k * fine.cells[1]];
          float* __restrict x = colour.value.data() + start;
          POLDER_INDEPENDENT
          for (std::ptrdiff_t m = begin; m < end; ++m) x[m] += e[m];  // cell 2m + q lies in coarse cell m
        }
  }
}

template <class Space>
void Multigrid<Space>::build(const CellMatrix<Space>& matrix, const std::vector<RowSpan>& inside, Team& team,
                             int rank) {
  if (rank == 0) spread_inside(inside, team.size());
  team.barrier();
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    Level& level = levels_[l];
    const Array& diagonal = l == 0 ? matrix.diagonal : level.diagonal;
    const auto& coupling = l == 0 ? matrix.coupling : level.coupling;
    const bool split = shared(level);
    const auto my_rows = [&](const Level& of) {
      return split ? std::pair{of.bounds[rank], of.bounds[rank + 1]} : std::pair{std::ptrdiff_t{0}, of.rows()};
    };
    const std::pair<std::ptrdiff_t, std::ptrdiff_t> rows = my_rows(level);
    if (split || rank == 0) colour_level(level, diagonal, coupling, rows.first, rows.second);
    if (l + 1 < levels_.size()) {
      Level& coarse = levels_[l + 1];
      const std::pair<std::ptrdiff_t, std::ptrdiff_t> coarse_rows = my_rows(coarse);
      if (split || rank == 0) coarsen(level, diagonal, coupling, coarse, coarse_rows.first, coarse_rows.second);
      if (split) team.barrier();
    }
  }
  if (rank == 0) factor_coarsest();
  team.barrier();
}

template <class Space>
void Multigrid<Space>::cycle_alone(std::size_t l) {
  if (l + 1 == levels_.size()) return solve_coarsest();
  Level &level = levels_[l], &coarse = levels_[l + 1];
  const std::ptrdiff_t rows = level.rows();
  smooth(level, 0, true, 0, rows);
  smooth(level, 1, false, 0, rows);
  smooth(level, 0, false, 0, rows);
  smooth(level, 1, false, 0, rows);
  restrict_to(level, coarse, 0, coarse.rows());
  cycle_alone(l + 1);
  prolong_to(coarse, level, 0, coarse.rows());
  for (const int c : {1, 0, 1, 0}) smooth(level, c, false, 0, rows);
}

template <class Space>
void Multigrid<Space>::cycle_from(std::size_t l, Team& team, int rank) {
  Level& level = levels_[l];
  if (!shared(level) || l + 1 == levels_.size()) {
    if (rank == 0) cycle_alone(l);
    team.barrier();
    return;
  }
  const std::ptrdiff_t row0 = level.bounds[rank], row1 = level.bounds[rank + 1];
  const auto sweep = [&](int c, bool from_zero) {
    smooth(level, c, from_zero, row0, row1);
    team.barrier();
  };
  sweep(0, true);
  sweep(1, false);
  sweep(0, false);
  sweep(1, false);
  Level& coarse = levels_[l + 1];
  const std::ptrdiff_t coarse0 = coarse.bounds[rank], coarse1 = coarse.bounds[rank + 1];
  restrict_to(level, coarse, coarse0, coarse1);
  team.barrier();
  cycle_from(l + 1, team, rank);
  prolong_to(coarse, level, coarse0, coarse1);
  team.barrier();
  for (const int c : {1, 0, 1, 0}) sweep(c, false);
}

template <class Space>
void Multigrid<Space>::cycle(Team& team, int rank) {
  if (!shared(levels_[0])) team.barrier();  // one thread goes on with what all have loaded
  cycle_from(0, team, rank);
}

template <class Space>
void Multigrid<Space>::load_row(std::ptrdiff_t row, const Array& r, double scale) {
  Level& level = levels_[0];
  const std::ptrdiff_t from = natural_row(level, row);
  for (Colour& colour : level.colour) {
    const auto [to, begin, end, q] = colour.inside[row];
    float* b = colour.right_side.data() + to;
    const double* source = r.data() + from + q;
    for (std::ptrdiff_t m = begin; m < end; ++m) b[m] = static_cast<float>(scale * source[2 * m]);
  }
}

template <class Space>
void Multigrid<Space>::unload_row(std::ptrdiff_t row, Array& z, double back) const {
  const Level& level = levels_[0];
  const std::ptrdiff_t to = natural_row(level, row);
  for (const Colour& colour : level.colour) {
    const auto [from, begin, end, q] = colour.inside[row];
    const float* x = colour.value.data() + from;
    double* target = z.data() + to + q;
    for (std::ptrdiff_t m = begin; m < end; ++m) target[2 * m] = back * static_cast<double>(x[m]);
  }
}

template class Multigrid<PlaneStrain>;
template class Multigrid<Solid>;

}  // namespace polder
