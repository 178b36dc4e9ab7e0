#include "polder/grid/pressure_solver.hpp"

#include <algorithm>
#include <cmath>

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
}

template <class Space>
void PressureSolver<Space>::multiply_row(const double* x, double* __restrict y, std::ptrdiff_t at) const {
  const std::ptrdiff_t n = lattice_.cells[0], dy = lattice_.stride[1];
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

/// Σ over rows of term(index of the row's first cell), the rows' sums added in sequence by every thread.
template <class Space>
template <class Term>
double PressureSolver<Space>::sum_rows(Team& team, int rank, int slot, Term&& term) {
  auto& partial = partial_[slot];
  const auto [row0, row1] = team.part(lattice_.row_count(), rank);
  for (std::ptrdiff_t row = row0; row < row1; ++row)
    partial[row] =
        term(lattice_.index(0, static_cast<int>(row % lattice_.cells[1]), static_cast<int>(row / lattice_.cells[1])));
  team.barrier();
  double sum = 0;
  for (const double p : partial) sum += p;
  return sum;
}

template <class Space>
SolveResult PressureSolver<Space>::solve(Array& x, double tolerance, int most_iterations, Team& team) {
  if (lattice_.cell_count() < cells_worth_sharing) {
    Team alone(1);
    return solve_together(x, tolerance, most_iterations, alone);
  }
  return solve_together(x, tolerance, most_iterations, team);
}

template <class Space>
SolveResult PressureSolver<Space>::solve_together(Array& x, double tolerance, int most_iterations, Team& team) {
  SolveResult result;
  const std::ptrdiff_t n = lattice_.cells[0];
  team.run([&](int rank) {
    double bb = sum_rows(team, rank, 0, [&](std::ptrdiff_t at) {
      double sum = 0;
      for (std::ptrdiff_t i = at; i < at + n; ++i) {
        const bool active = matrix.diagonal[i] > 0;
        x[i] = active ? x[i] : 0;
        right_side[i] = active ? right_side[i] : 0;
        sum += right_side[i] * right_side[i];
      }
      return sum;
    });
    double rr = sum_rows(team, rank, 1, [&](std::ptrdiff_t at) {
      multiply_row(x.data(), product_.data(), at);
      double sum = 0;
      for (std::ptrdiff_t i = at; i < at + n; ++i) {
        residual_[i] = right_side[i] - product_[i];
        sum += residual_[i] * residual_[i];
      }
      return sum;
    });
    const double goal = tolerance * tolerance * bb + 1e-40;
    int iterations = 0;
    if (rr > goal) multigrid_.build(matrix, team, rank);
    double rz = 0;
    while (rr > goal && iterations < most_iterations && std::isfinite(rr)) {
      multigrid_.apply(residual_, preconditioned_, 1 / std::sqrt(rr), team, rank);
      const double rz_new = sum_rows(team, rank, 2, [&](std::ptrdiff_t at) {
        double sum = 0;
        for (std::ptrdiff_t i = at; i < at + n; ++i) sum += residual_[i] * preconditioned_[i];
        return sum;
      });
      const double beta = iterations == 0 ? 0 : rz_new / rz;
      rz = rz_new;
      sum_rows(team, rank, 3, [&](std::ptrdiff_t at) {
        for (std::ptrdiff_t i = at; i < at + n; ++i) direction_[i] = preconditioned_[i] + beta * direction_[i];
        return 0.0;
      });
      const double dq = sum_rows(team, rank, 0, [&](std::ptrdiff_t at) {
        multiply_row(direction_.data(), product_.data(), at);
        double sum = 0;
        for (std::ptrdiff_t i = at; i < at + n; ++i) sum += direction_[i] * product_[i];
        return sum;
      });
      ++iterations;
      if (!(dq > 0)) break;
      const double alpha = rz / dq;
      rr = sum_rows(team, rank, 1, [&](std::ptrdiff_t at) {
        double sum = 0;
        for (std::ptrdiff_t i = at; i < at + n; ++i) {
          x[i] += alpha * direction_[i];
          residual_[i] -= alpha * product_[i];
          sum += residual_[i] * residual_[i];
        }
        return sum;
      });
    }
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
