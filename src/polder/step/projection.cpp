#include "polder/step/projection.hpp"

#include <algorithm>
#include <cstring>

#include "polder/math/simd.hpp"
#include "polder/step/cavities.hpp"
#include "polder/step/face_loop.hpp"
#include "polder/step/far_field.hpp"
#include "polder/step/interior.hpp"
#include "polder/step/row_metric.hpp"

namespace polder {

namespace {

/// Fills the solver's matrix from face coefficients: −∇·(coefficient ∇) over wet cells with p = 0 at the surface, whose
/// distance is `distance(wet cell, dry cell)` of the way between their centres, plus `storage(cell, volume)` on the
/// diagonal.
template <bool graded, class Space, class Coefficient, class Distance, class Storage>
void assemble(const Setup<Space>& setup, const GridFields<Space>& grid, CellMatrix<Space>& matrix, Team& team,
              Coefficient&& coefficient, Distance&& distance, Storage&& storage) {
  const auto& lattice = setup.lattice;
  over_cell_rows(lattice, grid.rows, team, [&](std::ptrdiff_t first, int count, const std::array<int, 3>& place) {
    const RowMetric<Space, graded> metric(lattice, place);
    if (setup.periodic) matrix.seam[first] = 0;
    for (std::ptrdiff_t cell = first; cell < first + count; ++cell) {
      for (int a = 0; a < Space::axes; ++a) matrix.coupling[a][cell] = 0;
      matrix.diagonal[cell] = 0;
      if (!grid.wet[cell]) continue;
      const int i = static_cast<int>(cell - first);
      double sum = storage(cell, metric.volume(i));
      for (int a = 0; a < Space::axes; ++a) {
        const std::ptrdiff_t s = lattice.stride[a];
        const double low = metric.conductance(a, i, 0) * coefficient(a, cell);
        const double high = metric.conductance(a, i, 1) * coefficient(a, cell + s);
        if (grid.wet[cell - s]) {
          if (a == 0 && setup.periodic && cell == first && place[0] == 0)
            matrix.seam[cell] = low;
          else
            matrix.coupling[a][cell] = low;
          sum += low;
        } else if (low > 0) {
          sum += low / distance(cell, cell - s);
        }
        if (grid.wet[cell + s])
          sum += high;
        else if (high > 0)
          sum += high / distance(cell, cell + s);
      }
      matrix.diagonal[cell] = sum > 1e-30 ? sum : 0;
    }
  });
}

/// The pressure beyond the sides with a head, and beyond absorbing ones, on the right side of the equation.
template <class Space, class Distance>
void add_heads(const Setup<Space>& setup, const GridFields<Space>& grid, Distance&& distance, Array& right_side) {
  const auto& lattice = setup.lattice;
  std::vector<OpenSide> sides = far_sides(setup);
  sides.insert(sides.end(), setup.open_sides.begin(), setup.open_sides.end());
  for (const OpenSide& side : sides) {
    if (!side.prescribes_head) continue;
    over_side(lattice, side,
              [&](std::ptrdiff_t face, std::ptrdiff_t inside, std::ptrdiff_t outside, const std::array<int, 3>& cell) {
                const double h = lattice.axis[side.axis].width(cell[side.axis]);
                if (grid.wet[inside])
                  right_side[inside] += lattice.cell_volume(cell) / (h * h) * grid.mobility[side.axis][face] *
                                        grid.pressure[outside] / distance(inside, outside);
              });
  }
}

/// Carries a face field `layers` (1 or 2) layers beyond the faces where `known` is not 0, by the mean of the known
/// neighbours on the same side of thin walls. A film's velocity is carried up, and along it to faces without water of
/// their own: what has momentum would gain by it. Returns where the field is known then.
template <class Space>
const FaceFlags<Space>& spread(const Lattice<Space>& lattice, const ThinWalls<Space>& walls,
                               const FaceFlags<Space>& known, int layers, FaceField<Space>& field,
                               const GridFields<Space>& grid, Layers<Space>& scratch, Team& team) {
  // from a face of component c to the one above it on axis a
  const auto linked = [&](int c, int a, std::ptrdiff_t f) {
    if (!walls.any() || a == c) return true;
    const std::ptrdiff_t s = lattice.stride[a];
    return !walls.blocked(a, f + s) || !walls.blocked(a, f + s - lattice.stride[c]);
  };
  const FaceFlags<Space>* reached = &known;
  for (int layer = 0; layer < layers; ++layer) {
    over_all_face_rows(lattice, grid.rows, team, [&](int c, std::ptrdiff_t first, int count, const auto& place) {
      const std::uint8_t* before = (*reached)[c].data();
      std::uint8_t* after = scratch[layer][c].data();
      const double* water_mass = grid.water_mass[c].data();
      double* v = field[c].data();
      for (int i = 0; i < count; ++i) {
        const std::ptrdiff_t f = first + i;
        if (i + 8 <= count) {  // eight that are all known, or far from all that is known
          const std::uint64_t own = eight(before + f);
          std::uint64_t around = own;
          for (int a = 0; a < Space::axes; ++a)
            around |= eight(before + f - lattice.stride[a]) | eight(before + f + lattice.stride[a]);
          if (own == eight_set || around == 0) {
            std::memcpy(after + f, &own, sizeof own);
            i += 7;
            continue;
          }
        }
        after[f] = before[f];
        if (before[f] || walls.blocked(c, f)) continue;
        const int at[3] = {place[0] + i, place[1], place[2]};
        double sum = 0;
        int number = 0;
        std::uint8_t kind = film_face;
        const auto take = [&](int a, std::ptrdiff_t from) {
          if (before[from] == film_face && a != Space::up && water_mass[f] > 0) return;
          sum += v[from], ++number;
          if (before[from] != film_face) kind = 1;
        };
        for (int a = 0; a < Space::axes; ++a) {
          const std::ptrdiff_t s = lattice.stride[a];
          if (at[a] > 0 && before[f - s] && linked(c, a, f - s)) take(a, f - s);
          if (at[a] < lattice.cells[a] - (a != c) && before[f + s] && linked(c, a, f)) take(a, f + s);
        }
        if (number == 0) continue;
        v[f] = sum / number;
        after[f] = kind;
      }
    });
    reached = &scratch[layer];
  }
  return *reached;
}

}  // namespace

template <class Space>
void extrapolate_soil(const Setup<Space>& setup, GridFields<Space>& grid, Team& team) {
  const auto& lattice = setup.lattice;
  over_all_face_rows(lattice, grid.rows, team, [&](int c, std::ptrdiff_t first, int count, const auto&) {
    const double* mass = grid.soil_mass[c].data() + first;
    std::uint8_t* known = grid.soil_known[c].data() + first;
    POLDER_INDEPENDENT
    for (int i = 0; i < count; ++i) known[i] = mass[i] > 0;
    for (int i = 0; setup.walls.any() && i < count; ++i) known[i] = known[i] && !setup.walls.blocked(c, first + i);
  });
  spread(lattice, setup.walls, grid.soil_known, setup.bodies.any() ? 2 : 1, grid.soil_velocity, grid, grid.layers,
         team);
}

template <class Space>
SolveResult project(const Setup<Space>& setup, double dt, const std::vector<WellFlow>& wells, GridFields<Space>& grid,
                    PressureSolver<Space>& solver, Team& team) {
  const auto& lattice = setup.lattice;
  const double theta = setup.numerics.pressure_weight, earlier = (1 - theta) / theta;
  const double softness = setup.water.bulk_modulus * dt * theta * theta;
  const Array before = theta < 1 ? grid.pressure : Array{};
  const auto distance = [&](std::ptrdiff_t wet, std::ptrdiff_t dry) {
    return surface_distance(grid.fill[wet], grid.fill[dry]);
  };
  by_spacing(lattice, [&]<bool graded>() {
    assemble<graded>(
        setup, grid, solver.matrix, team,
        [&](int a, std::ptrdiff_t f) { return grid.mobility[a][f] * setup.bodies.open_face(a, f); }, distance,
        [&](std::ptrdiff_t cell, double volume) {
          return volume / softness * grid.cell_porosity[cell] * setup.bodies.open_cell(cell);
        });

    over_cell_rows(lattice, grid.rows, team, [&](std::ptrdiff_t first, int count, const std::array<int, 3>& place) {
      const RowMetric<Space, graded> metric(lattice, place);
      for (std::ptrdiff_t cell = first; cell < first + count; ++cell) {
        if (!grid.wet[cell]) {
          solver.right_side[cell] = 0;
          continue;
        }
        const int i = static_cast<int>(cell - first);
        double divergence = 0;
        for (int a = 0; a < Space::axes; ++a) {
          const auto flux = [&](std::ptrdiff_t f) {
            const double n = grid.porosity[a][f];
            double v = n * grid.water_velocity[a][f] + (1 - n) * grid.soil_velocity[a][f];
            if (earlier > 0) v += earlier * (n * grid.water_before[a][f] + (1 - n) * grid.soil_before[a][f]);
            return setup.bodies.open_face(a, f) * v + (1 + earlier) * setup.bodies.flux(a, f);
          };
          divergence += metric.area(a, i) * (flux(cell + lattice.stride[a]) - flux(cell));
        }
        solver.right_side[cell] = metric.volume(i) / softness * grid.cell_porosity[cell] *
                                      setup.bodies.open_cell(cell) * grid.pressure[cell] -
                                  divergence;
      }
    });
  });
  add_heads(setup, grid, distance, solver.right_side);
  for (const WellFlow& well : wells) {
    solver.matrix.diagonal[well.cell] += well.conductance;
    solver.right_side[well.cell] += well.conductance * well.level - well.rate;
  }
  const SolveResult result = solve_with_cavities(setup, grid, solver, team);
  join_ends(grid.pressure, setup.water_box, lattice);

  by_spacing(lattice, [&]<bool graded>() {
    for (int c = 0; c < Space::axes; ++c) {
      const std::ptrdiff_t s = lattice.stride[c];
      over_face_rows(lattice, grid.rows, c, team,
                     [&](std::ptrdiff_t first, int count, const std::array<int, 3>& place) {
                       const RowMetric<Space, graded> metric(lattice, place);
                       for (std::ptrdiff_t f = first; f < first + count; ++f) {
                         if (!grid.reached[c][f] || grid.mobility[c][f] <= 0) continue;
                         const std::ptrdiff_t low = f - s;
                         const double inverse = metric.inverse_gap(c, static_cast<int>(f - first));
                         double gradient;
                         if (grid.wet[low] && grid.wet[f])
                           gradient = (grid.pressure[f] - grid.pressure[low]) * inverse;
                         else  // what is not wet has pressure zero; beyond a side with a head it is the side's
                           gradient = (grid.pressure[f] - grid.pressure[low]) * inverse /
                                      (grid.wet[low] ? distance(low, f) : distance(f, low));
                         grid.water_velocity[c][f] += grid.water_response[c][f] * gradient;
                         grid.soil_velocity[c][f] += grid.soil_response[c][f] * gradient;
                       }
                     });
    }
  });
  for (std::size_t cell = 0; cell < before.size(); ++cell)
    if (grid.wet[cell]) grid.pressure[cell] = (grid.pressure[cell] - (1 - theta) * before[cell]) / theta;
  return result;
}

template <class Space>
void extrapolate_water(const Setup<Space>& setup, const GridFields<Space>& grid, FaceField<Space>& field,
                       bool keep_ballistic, Layers<Space>& layers, Team& team) {
  const auto& lattice = setup.lattice;
  const FaceFlags<Space>& filled = spread(lattice, setup.walls, grid.reached, 2, field, grid, layers, team);
  over_all_face_rows(lattice, grid.rows, team, [&](int c, std::ptrdiff_t first, int count, const auto& at) {
    double* row = field[c].data() + first;
    const std::uint8_t* known = filled[c].data() + first;
    const double* mass = grid.water_mass[c].data() + first;
    for (int i = 0; i < count; ++i) row[i] = known[i] || (keep_ballistic && mass[i] > 0) ? row[i] : 0;

    const auto close = [&](int end, int i, int along) {
      const OpenSide* open = setup.open_side(c, end);
      if (setup.water_box.periodic(c) || (open && open->part.covers(along)) || setup.absorbs(c, end)) return;
      row[i] = keep_ballistic ? setup.wall_velocity(c, end) : 0;  // a velocity is that of the wall there, a shift none
    };
    if (c > 0 && (at[c] == 0 || at[c] == lattice.cells[c]))
      for (int i = 0; i < count; ++i) close(at[c] == 0 ? 0 : 1, i, at[0] + i);
    if (c == 0 && at[0] == 0) close(0, 0, at[Space::up]);
    if (c == 0 && at[0] + count == lattice.cells[0] + 1) close(1, count - 1, at[Space::up]);
  });
}

template <class Space>
SolveResult correct_volume(const Setup<Space>& setup, GridFields<Space>& grid, PressureSolver<Space>& solver,
                           Team& team) {
  const auto& lattice = setup.lattice;
  // water does not respond to a pressure gradient where it is held: at walls, at gates
  const auto closed = [&](int a, std::ptrdiff_t f) { return grid.water_response[a][f] == 0; };
  const double floor = 1e-6 * lattice.cell_volume() / (lattice.smallest_spacing() * lattice.smallest_spacing());
  by_spacing(lattice, [&]<bool graded>() {
    assemble<graded>(
        setup, grid, solver.matrix, team,
        [&](int a, std::ptrdiff_t f) { return closed(a, f) ? 0 : grid.porosity[a][f] * setup.bodies.open_face(a, f); },
        [](std::ptrdiff_t, std::ptrdiff_t) { return 0.5; }, [](std::ptrdiff_t, double) { return 0.0; });
    over_cell_rows(lattice, grid.rows, team, [&](std::ptrdiff_t first, int count, const std::array<int, 3>& place) {
      const RowMetric<Space, graded> metric(lattice, place);
      for (int i = 0; i < count; ++i) {
        const std::ptrdiff_t cell = first + i;
        grid.potential[cell] = solver.right_side[cell] = 0;
        if (!grid.wet[cell]) continue;
        if (solver.matrix.diagonal[cell] > 0) solver.matrix.diagonal[cell] += floor;
        double error = grid.fill[cell] - 1;
        if (!is_inside_water(setup, grid, cell, {place[0] + i, place[1], place[2]})) error = std::max(0.0, error);
        solver.right_side[cell] = setup.numerics.volume_correction * grid.cell_porosity[cell] * metric.volume(i) *
                                  setup.bodies.open_cell(cell) * std::clamp(error, -0.5, 0.5);
      }
    });
  });
  for (std::size_t cell = 0; setup.single_point && cell < grid.carried_volume.size(); ++cell)
    if (grid.carried_volume[cell] > 0)  // what soil carries does not move
      solver.right_side[cell] *= std::max(0.0, 1 - grid.carried_volume[cell] / grid.water_volume[cell]);
  for (const std::ptrdiff_t cell : grid.cavities)  // a void is not to be filled from around it
    solver.right_side[cell] = std::max(0.0, solver.right_side[cell]);
  const SolveResult result = solver.solve(grid.rows, grid.potential, 5e-3, 60, team, &grid.potential_trend);
  join_ends(grid.potential, setup.water_box, lattice);

  by_spacing(lattice, [&]<bool graded>() {
    for (int c = 0; c < Space::axes; ++c) {
      const std::ptrdiff_t s = lattice.stride[c];
      over_face_rows(lattice, grid.rows, c, team,
                     [&](std::ptrdiff_t first, int count, const std::array<int, 3>& place) {
                       const RowMetric<Space, graded> metric(lattice, place);
                       for (std::ptrdiff_t f = first; f < first + count; ++f) {
                         double d = 0;
                         if (grid.reached[c][f] && !closed(c, f)) {
                           if (grid.wet[f - s] && grid.wet[f])
                             d = grid.potential[f - s] - grid.potential[f];
                           else
                             d = grid.wet[f - s] ? 2 * grid.potential[f - s] : -2 * grid.potential[f];
                         }
                         const double h = metric.gap(c, static_cast<int>(f - first));
                         grid.shift[c][f] = std::clamp(d / h, -0.1 * h, 0.1 * h);
                       }
                     });
    }
  });
  extrapolate_water(setup, grid, grid.shift, false, grid.shift_layers, team);
  for (int c = 0; c < Space::axes; ++c) {
    over_face_rows(lattice, grid.rows, c, team, [&](std::ptrdiff_t first, int count, const auto&) {
      for (std::ptrdiff_t f = first; f < first + count; ++f)
        if (closed(c, f)) grid.shift[c][f] = 0;
    });
    reflect(grid.shift[c], c, true, setup.water_box, lattice);
  }
  return result;
}

template SolveResult project(const Setup<PlaneStrain>&, double, const std::vector<WellFlow>&, GridFields<PlaneStrain>&,
                             PressureSolver<PlaneStrain>&, Team&);
template SolveResult project(const Setup<Solid>&, double, const std::vector<WellFlow>&, GridFields<Solid>&,
                             PressureSolver<Solid>&, Team&);
template SolveResult correct_volume(const Setup<PlaneStrain>&, GridFields<PlaneStrain>&, PressureSolver<PlaneStrain>&,
                                    Team&);
template SolveResult correct_volume(const Setup<Solid>&, GridFields<Solid>&, PressureSolver<Solid>&, Team&);
template void extrapolate_soil(const Setup<PlaneStrain>&, GridFields<PlaneStrain>&, Team&);
template void extrapolate_soil(const Setup<Solid>&, GridFields<Solid>&, Team&);
template void extrapolate_water(const Setup<PlaneStrain>&, const GridFields<PlaneStrain>&, FaceField<PlaneStrain>&,
                                bool, Layers<PlaneStrain>&, Team&);
template void extrapolate_water(const Setup<Solid>&, const GridFields<Solid>&, FaceField<Solid>&, bool, Layers<Solid>&,
                                Team&);

}  // namespace polder
