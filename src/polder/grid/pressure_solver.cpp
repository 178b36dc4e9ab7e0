#include "polder/grid/pressure_solver.hpp"

#include <algorithm>
#include <cmath>

#include "polder/math/simd.hpp"

namespace polder {

template <class Space>
PressureSolver<Space>::PressureSolver(const Lattice<Space>& lattice)
    : matrix(lattice),
      right_side(lattice.make_array()),
      lattice_(lattice),
      multigrid_(lattice),
      residual_(lattice.make_array()),
      preconditioned_(lattice.make_array()),
      direction_(lattice.make_array()),
      product_(lattice.make_array()) {
  for (auto& p : partial_) p.assign(static_cast<std::size_t>(lattice.row_count()), 0.0);
  inside_.resize(static_cast<std::size_t>(lattice.row_count()));
  last_ = inside_;
}

template <class Space>
void PressureSolver<Space>::multiply_row(const double* x, double* __restrict y, std::ptrdiff_t at,
                                         std::ptrdiff_t n) const {
  const std::ptrdiff_t dy = lattice_.stride[1];
  const double* d = matrix.diagonal.data() + at;
  const double* ax = matrix.coupling[0].data() + at;
  const double* ay = matrix.coupling[1].data() + at;
  x += at;
  y += at;
  if constexpr (Space::axes == 2) {
    for (std::ptrdiff_t i = 0; i < n; ++i)
      y[i] = d[i] * x[i] - ax[i] * x[i - 1] - ax[i + 1] * x[i + 1] - ay[i] * x[i - dy] - ay[i + dy] * x[i + dy];
  } else {
    const std::ptrdiff_t dz = lattice_.stride[2];
    const double* az = matrix.coupling[Space::axes - 1].data() + at;
    for (std::ptrdiff_t i = 0; i < n; ++i)
      y[i] = d[i] * x[i] - ax[i] * x[i - 1] - ax[i + 1] * x[i + 1] - ay[i] * x[i - dy] - ay[i + dy] * x[i + dy] -
             az[i] * x[i - dz] - az[i + dz] * x[i + dz];
  }
}

/// The couplings of a periodic lattice's rows to themselves, after multiply_row().
template <class Space>
void PressureSolver<Space>::close_row(const double* x, double* y, std::ptrdiff_t row) const {
  const std::ptrdiff_t first =
      lattice_.index(0, static_cast<int>(row % lattice_.cells[1]), static_cast<int>(row / lattice_.cells[1]));
  const double seam = matrix.seam[first];
  if (seam == 0) return;
  const std::ptrdiff_t last = first + lattice_.cells[0] - 1;
  y[first] -= seam * x[last];
  y[last] -= seam * x[first];
}

/// Σ over rows of term(index of the span's first cell, number of cells, row), the rows' sums added in sequence by every
/// thread.
template <class Space>
template <class Term>
double PressureSolver<Space>::sum_rows(const std::vector<RowSpan>& spans, const std::vector<std::ptrdiff_t>& bounds,
                                       Team& team, int rank, int slot, Term&& term) {
  auto& partial = partial_[slot];
  for (std::ptrdiff_t row = bounds[rank]; row < bounds[rank + 1]; ++row) {
    const int j = static_cast<int>(row % lattice_.cells[1]), k = static_cast<int>(row / lattice_.cells[1]);
    const RowSpan span = spans[row];
    partial[row] = span.count() > 0 ? term(lattice_.index(span.begin, j, k), span.count(), row) : 0.0;
  }
  team.barrier();
  double sum = 0;
  for (const double p : partial) sum += p;
  return sum;
}

template <class Space>
void PressureSolver<Space>::leave(const std::vector<RowSpan>& now) {
  for (std::size_t row = 0; row < now.size(); ++row) {
    const RowSpan before = last_[row], after = now[row];
    if (before == after) continue;
    const int j = static_cast<int>(static_cast<std::ptrdiff_t>(row) % lattice_.cells[1]);
    const int k = static_cast<int>(static_cast<std::ptrdiff_t>(row) / lattice_.cells[1]);
    for (int i = before.begin; i < before.end; ++i) {
      if (i >= after.begin && i < after.end) continue;
      const std::ptrdiff_t cell = lattice_.index(i, j, k);
      matrix.diagonal[cell] = 0;
      for (auto& coupling : matrix.coupling) coupling[cell] = 0;
      matrix.seam[cell] = 0;
    }
  }
  last_ = now;
}

template <class Space>
SolveResult PressureSolver<Space>::solve(const ActiveRows<Space>& rows, Array& x, double tolerance, int most_iterations,
                                         Team& team, Array* trend) {
  leave(rows.spans);
  if (rows.cell_count < cells_worth_sharing) {
    Team alone(1);
    return solve_together(rows, x, tolerance, most_iterations, alone, trend);
  }
  return solve_together(rows, x, tolerance, most_iterations, team, trend);
}

template <class Space>
SolveResult PressureSolver<Space>::solve_together(const ActiveRows<Space>& rows, Array& x, double tolerance,
                                                  int most_iterations, Team& team, Array* trend) {
  SolveResult result;
  std::vector<std::ptrdiff_t> all;
  deal_out(rows.spans, team.size(), all);
  std::fill(inside_.begin(), inside_.end(), RowSpan{});
  team.run([&](int rank) {
    const double bb = sum_rows(rows.spans, all, team, rank, 0, [&](std::ptrdiff_t at, int n, std::ptrdiff_t row) {
      int begin = n, end = 0;
      double sum = 0;
      for (int i = 0; i < n; ++i) {
        const bool active = matrix.diagonal[at + i] > 0;
        if (active) {
          begin = std::min(begin, i);
          end = i + 1;
        }
        x[at + i] = active ? x[at + i] : 0;
        if (trend) (*trend)[at + i] = active ? (*trend)[at + i] : 0;
        right_side[at + i] = active ? right_side[at + i] : 0;
        sum += right_side[at + i] * right_side[at + i];
      }
      const int origin = rows.spans[row].begin;
      inside_[row] = end > begin ? RowSpan{origin + begin, origin + end} : RowSpan{};
      return sum;
    });
    std::vector<std::ptrdiff_t> bounds;
    deal_out(inside_, team.size(), bounds);
    const auto sum_inside = [&](int slot, auto&& term) { return sum_rows(inside_, bounds, team, rank, slot, term); };
    double rr = sum_inside(1, [&](std::ptrdiff_t at, int n, std::ptrdiff_t row) {
      multiply_row(x.data(), product_.data(), at, n);
      close_row(x.data(), product_.data(), row);
      POLDER_INDEPENDENT
      for (std::ptrdiff_t i = at; i < at + n; ++i) residual_[i] = right_side[i] - product_[i];
      const double* other = trend ? trend->data() : residual_.data();
      return dot(residual_.data() + at, other + at, n);
    });
    if (trend) {
      const double tr = rr;
      const double tq = sum_inside(2, [&](std::ptrdiff_t at, int n, std::ptrdiff_t row) {
        multiply_row(trend->data(), product_.data(), at, n);
        close_row(trend->data(), product_.data(), row);
        return dot(trend->data() + at, product_.data() + at, n);
      });
      const double share = tq > 0 ? tr / tq : 0;
      rr = sum_inside(3, [&](std::ptrdiff_t at, int n, std::ptrdiff_t) {
        POLDER_INDEPENDENT
        for (std::ptrdiff_t i = at; i < at + n; ++i) {
          const double start = x[i];
          x[i] += share * (*trend)[i];
          (*trend)[i] = start;
          residual_[i] -= share * product_[i];
        }
        return dot(residual_.data() + at, residual_.data() + at, n);
      });
    }
    const double goal = tolerance * tolerance * bb + 1e-40;
    int iterations = 0;
    double rz = 0, scale = 1 / std::sqrt(rr);
    if (rr > goal) {
      multigrid_.build(matrix, inside_, team, rank);
      for (std::ptrdiff_t row = bounds[rank]; row < bounds[rank + 1]; ++row) multigrid_.load_row(row, residual_, scale);
    }
    while (rr > goal && iterations < most_iterations && std::isfinite(rr)) {
      multigrid_.cycle(team, rank);
      const double rz_new = sum_inside(2, [&](std::ptrdiff_t at, int n, std::ptrdiff_t row) {
        multigrid_.unload_row(row, preconditioned_, 1 / scale);
        return dot(residual_.data() + at, preconditioned_.data() + at, n);
      });
      const double beta = iterations == 0 ? 0 : rz_new / rz;
      rz = rz_new;
      sum_inside(3, [&](std::ptrdiff_t at, int n, std::ptrdiff_t) {
        POLDER_INDEPENDENT
        for (std::ptrdiff_t i = at; i < at + n; ++i) direction_[i] = preconditioned_[i] + beta * direction_[i];
        return 0.0;
      });
      const double dq = sum_inside(0, [&](std::ptrdiff_t at, int n, std::ptrdiff_t row) {
        multiply_row(direction_.data(), product_.data(), at, n);
        close_row(direction_.data(), product_.data(), row);
        return dot(direction_.data() + at, product_.data() + at, n);
      });
      ++iterations;
      if (!(dq > 0)) break;
      const double alpha = rz / dq;
      scale = 1 / std::sqrt(rr);
      rr = sum_inside(1, [&](std::ptrdiff_t at, int n, std::ptrdiff_t row) {
        POLDER_INDEPENDENT
        for (std::ptrdiff_t i = at; i < at + n; ++i) {
          x[i] += alpha * direction_[i];
          residual_[i] -= alpha * product_[i];
        }
        multigrid_.load_row(row, residual_, scale);
        return dot(residual_.data() + at, residual_.data() + at, n);
      });
    }
    if (trend)
      sum_inside(2, [&](std::ptrdiff_t at, int n, std::ptrdiff_t) {
        for (std::ptrdiff_t i = at; i < at + n; ++i) (*trend)[i] = x[i] - (*trend)[i];
        return 0.0;
      });
    if (rank == 0) {
      result.iterations = iterations;
      result.residual = bb > 0 ? std::sqrt(rr / bb) : 0;
      result.converged = rr <= goal;
    }
  });
  return result;
}

template class PressureSolver<PlaneStrain>;
template class PressureSolver<Solid>;

}  // namespace polder
