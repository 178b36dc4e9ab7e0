#include "polder/step/pore_flow.hpp"

#include <algorithm>
#include <cmath>

#include "polder/step/cell_beside.hpp"
#include "polder/step/face_loop.hpp"

namespace polder {

namespace {

constexpr int most_iterations = 60;
constexpr int full_steps = 6;      // of Newton; then a step that makes the error larger is taken back by halves
constexpr int settled_after = 12;  // iterations: then conductivities stay as they are, or both may go round in a circle
constexpr double least_share = 1.0 / 64;
constexpr double closed_to = 1e-9;  // of its pores: error of a cell's balance at which Newton ends

/// Share of a face that soil fills: beside the surface, that of the less filled cell; upwards, soil that fills a tenth
/// of the lower cell carries the water of the whole.
template <class Space>
double open_share(const Setup<Space>& setup, const PoreFields<Space>& pores, int axis, std::ptrdiff_t low,
                  std::ptrdiff_t high) {
  const auto filled = [&](std::ptrdiff_t cell) {  // of what a body leaves open
    return pores.bulk[cell] / (setup.lattice.cell_volume(cell) * std::max(0.1, setup.bodies.open_cell(cell)));
  };
  const double share = axis == Space::up ? 10 * filled(low) : std::min(filled(low), filled(high));
  return std::clamp(share, 0.01, 1.0) * setup.bodies.open_face(axis, high);
}

/// k A/(γw d) of a face, m³/s/Pa.
template <class Space>
double conductance(const Setup<Space>& setup, const PoreFields<Space>& pores, int axis, std::ptrdiff_t face) {
  const auto& lattice = setup.lattice;
  if (setup.shut(axis, face)) return 0;
  const std::ptrdiff_t low = face - lattice.stride[axis];
  if (!pores.active[low] || !pores.active[face] || pores.host[low] >= 0 || pores.host[face] >= 0) return 0;
  const Array& a = pores.resistance[axis == Space::up];
  const int place = lattice.place(face, axis);
  const double below = relative_width(lattice, axis, place - 1), above = relative_width(lattice, axis, place);
  return open_share(setup, pores, axis, low, face) * lattice.face_area(axis, face) *
         (pores.relative[low] + pores.relative[face]) / (lattice.spacing[axis] * (a[low] * below + a[face] * above));
}

}  // namespace

template <class Space>
SolveResult solve_pore_pressure(const Setup<Space>& setup, double dt, std::vector<PoreExit>& exits,
                                GridFields<Space>& grid, PoreFields<Space>& pores, PressureSolver<Space>& solver,
                                Team& team) {
  const auto& lattice = setup.lattice;
  double weight[Space::axes];                     // of the water against the axis, Pa/m
  int lowest[Space::axes], highest[Space::axes];  // cells with a side of the model
  for (int a = 0; a < Space::axes; ++a) {
    const bool joined = setup.soil_box.periodic(a);
    weight[a] = -setup.water.density * setup.pull(a);
    lowest[a] = joined ? -1 : 0;
    highest[a] = lattice.cells[a] - (joined ? 0 : 1);
  }
  const Array coupled = pores.saturation;  // the coupling stays that of the step's start
  Array increment(coupled.size(), 0.0);
  Array conducts[Space::axes];
  for (auto& c : conducts) c = lattice.make_array();
  Array pressure_before, content_before;  // the last step of Newton, for the chord between
  SolveResult total;
  double last_error = 0, share = 1;  // of the increment, that has been added

  const auto flow = [&](int a, std::ptrdiff_t f) {
    const double head = weight[a] != 0 ? weight[a] * lattice.axis[a].gap(lattice.place(f, a)) : 0;
    return conducts[a][f] * (grid.pressure[f - lattice.stride[a]] - grid.pressure[f] - head);
  };
  const auto inner = [&](int a, std::ptrdiff_t cell, int end) {  // whether the cell's face at this end is inside
    const int place = lattice.place(cell, a);
    return end == 0 ? place > lowest[a] : place < highest[a];
  };

  const auto add = [&](double factor) {  // so much of the increment, and what the soil makes of it
    over_cell_rows(lattice, grid.rows, team, [&](std::ptrdiff_t first, int count, const auto&) {
      for (std::ptrdiff_t cell = first; cell < first + count; ++cell) grid.pressure[cell] += factor * increment[cell];
    });
    join_ends(grid.pressure, setup.soil_box, lattice);
    for (int a = 0; a < Space::axes; ++a)
      over_face_rows(lattice, grid.rows, a, team, [&](std::ptrdiff_t first, int count, const auto&) {
        const std::ptrdiff_t s = lattice.stride[a];
        for (std::ptrdiff_t f = first; f < first + count; ++f)
          grid.soil_velocity[a][f] += factor * grid.soil_response[a][f] / lattice.spacing[a] *
                                      (pores.weight[a][f - s] * coupled[f - s] * increment[f - s] -
                                       pores.weight[a][f] * coupled[f] * increment[f]);
      });
  };

  for (int iteration = 0;; ++iteration) {
    fill_pores(setup, grid, pores, team);
    for (int a = 0; a < Space::axes; ++a)
      over_face_rows(lattice, grid.rows, a, team, [&](std::ptrdiff_t first, int count, const auto&) {
        for (std::ptrdiff_t f = first; f < first + count; ++f) {
          if (iteration < settled_after) conducts[a][f] = conductance(setup, pores, a, f);
          pores.flow[a][f] = flow(a, f);
        }
      });
    set_volume_change(setup, grid, pores, team);
    for (PoreExit& exit : exits)
      exit.out = std::max(exit.conductance * (grid.pressure[exit.cell] - exit.level), exit.least);

    // balance of every cell, and its derivatives
    std::vector<double> worst(grid.rows.spans.size(), 0.0);
    over_cell_rows(lattice, grid.rows, team, [&](std::ptrdiff_t first, int count, std::array<int, 3> place) {
      if (setup.periodic) solver.matrix.seam[first] = 0;
      for (std::ptrdiff_t cell = first; cell < first + count; ++cell, ++place[0]) {
        for (int a = 0; a < Space::axes; ++a) solver.matrix.coupling[a][cell] = 0;
        solver.matrix.diagonal[cell] = solver.right_side[cell] = 0;
        if (!pores.active[cell] || pores.host[cell] >= 0) continue;
        double slope = pores.storage[cell];
        if (iteration > full_steps && grid.pressure[cell] != pressure_before[cell])
          slope = std::max(
              slope, (pores.content[cell] - content_before[cell]) / (grid.pressure[cell] - pressure_before[cell]));
        double out = 0, sum = slope / dt;
        for (int a = 0; a < Space::axes; ++a)
          for (const int end : {0, 1}) {
            const std::ptrdiff_t f = cell + end * lattice.stride[a], other = end == 0 ? cell - lattice.stride[a] : f;
            const double h = lattice.spacing[a];
            const double own = coupled[cell] * pores.weight[a][cell] / h;
            const double strains = own * true_area(lattice, a, place);
            sum += own * strains * grid.soil_response[a][f];
            if (!inner(a, cell, end)) continue;
            out += (end == 0 ? -1 : 1) * pores.flow[a][f];
            sum += conducts[a][f];
            if (end == 0 && pores.active[other] && pores.host[other] < 0) {
              Array& coupling = place[a] == 0 ? solver.matrix.seam : solver.matrix.coupling[a];
              coupling[cell] =
                  conducts[a][f] + strains * grid.soil_response[a][f] * coupled[other] * pores.weight[a][other] / h;
            }
          }
        solver.matrix.diagonal[cell] = sum;
        solver.right_side[cell] =
            -((pores.content[cell] - pores.water[cell]) / dt + coupled[cell] * pores.volume_change[cell] + out);
      }
    });
    over_hosted(lattice, pores, [&](std::ptrdiff_t cell, std::ptrdiff_t host) {  // what they add to their hosts'
      for (int a = 0; a < Space::axes; ++a)
        for (const int end : {0, 1}) {
          const std::ptrdiff_t f = cell + end * lattice.stride[a];
          const std::ptrdiff_t other = cell_beside(lattice, setup.soil_box, cell, a, end == 0 ? -1 : 1);
          const double own = coupled[cell] * pores.weight[a][cell] / lattice.spacing[a];
          const double shared = other == host ? coupled[host] * pores.weight[a][host] / lattice.spacing[a] : 0;
          const double strains = own * true_area(lattice, a, lattice.places(cell));
          solver.matrix.diagonal[host] += strains * (own - 2 * shared) * grid.soil_response[a][f];
        }
    });
    for (const PoreExit& exit : exits) {
      solver.right_side[exit.cell] -= exit.out;
      if (exit.conductance * (grid.pressure[exit.cell] - exit.level) > exit.least)
        solver.matrix.diagonal[exit.cell] += exit.conductance;
    }
    for (std::size_t row = 0; row < grid.rows.spans.size(); ++row) {
      const RowSpan span = grid.rows.spans[row];
      const int j = static_cast<int>(static_cast<std::ptrdiff_t>(row) % lattice.cells[1]);
      const int k = static_cast<int>(static_cast<std::ptrdiff_t>(row) / lattice.cells[1]);
      const RowVolume<Space> volume(lattice, {0, j, k});
      for (int i = span.begin; i < span.end; ++i)
        worst[row] = std::max(worst[row], std::abs(solver.right_side[lattice.index(i, j, k)]) * (dt / volume(i)));
    }
    const double error = *std::max_element(worst.begin(), worst.end());
    if (error < closed_to) break;
    if (iteration == most_iterations || !std::isfinite(error)) {
      total.converged = std::isfinite(error) && error < 1e-4;
      total.residual = error;
      break;
    }

    // where pores fill or begin to empty, the slope is another beyond, and full steps may go round in a circle
    if (iteration > full_steps && error > last_error && share > least_share) {
      share /= 2;
      add(-share);
      continue;
    }
    last_error = error;
    share = 1;
    if (iteration >= full_steps) {
      pressure_before = grid.pressure;
      content_before = pores.content;
    }
    std::fill(increment.begin(), increment.end(), 0.0);
    const SolveResult result = solver.solve(grid.rows, increment, setup.numerics.pressure_tolerance, 400, team);
    total.iterations += result.iterations;
    over_hosted(lattice, pores, [&](std::ptrdiff_t cell, std::ptrdiff_t host) { increment[cell] = increment[host]; });
    join_ends(increment, setup.soil_box, lattice);
    add(share);
  }
  return total;
}

template SolveResult solve_pore_pressure(const Setup<PlaneStrain>&, double, std::vector<PoreExit>&,
                                         GridFields<PlaneStrain>&, PoreFields<PlaneStrain>&,
                                         PressureSolver<PlaneStrain>&, Team&);
template SolveResult solve_pore_pressure(const Setup<Solid>&, double, std::vector<PoreExit>&, GridFields<Solid>&,
                                         PoreFields<Solid>&, PressureSolver<Solid>&, Team&);

}  // namespace polder
