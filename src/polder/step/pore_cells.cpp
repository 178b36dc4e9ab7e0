// The cells' side of pore_flow.hpp: what is in them and who stands for whom.
#include <algorithm>
#include <cmath>

#include "polder/step/cut_cells.hpp"
#include "polder/step/face_loop.hpp"
#include "polder/step/pore_curves.hpp"
#include "polder/step/pore_flow.hpp"

namespace polder {

namespace {

constexpr double hardly = 1e-3;  // of a cell's volume: no soil

/// From the centre of one cell to that of another, in smallest cells.
double cells_between(const GridAxis& axis, int from, int to) {
  return axis.graded() ? (axis.centre(to) - axis.centre(from)) / axis.least() : to - from;
}

/// Brings a place beyond the ends of a periodic model to the other end; false: it is in no cell.
template <class Space>
bool inside(const Setup<Space>& setup, std::array<int, 3>& place) {
  for (int a = 0; a < Space::axes; ++a) {
    const int n = setup.lattice.cells[a];
    if (setup.soil_box.periodic(a)) place[a] = (place[a] + n) % n;
    if (place[a] < 0 || place[a] >= n) return false;
  }
  return true;
}

/// From the centre of one cell along x to that of another, in smallest cells; the shorter way in a periodic model.
template <class Space>
double way_along(const Setup<Space>& setup, int from, int to) {
  const double way = cells_between(setup.lattice.axis[0], from, to), round = setup.lattice.cells[0];
  return setup.periodic && 2 * std::abs(way) > round ? way - std::copysign(round, way) : way;
}

/// Where soil is all around, two cells deep, a cell's own volume is the weight: sums over points would scatter as these
/// cross cells.
template <class Space>
void smooth_weights(const Setup<Space>& setup, PoreFields<Space>& pores) {
  const auto& lattice = setup.lattice;
  std::vector<std::uint8_t> full(static_cast<std::size_t>(lattice.size), 0), next;
  over_all_cells(lattice, [&](std::ptrdiff_t cell, const std::array<int, 3>& place) {
    full[cell] = setup.bodies.covered(cell) ||
                 pores.yielding[cell] > 0.9 * lattice.cell_volume(place) * setup.bodies.open_cell(cell);
  });
  for (int a = 0; a < Space::axes; ++a) {
    const bool joined = setup.soil_box.periodic(a);
    const int n = lattice.cells[a];
    next = full;
    over_all_cells(lattice, [&](std::ptrdiff_t cell, const std::array<int, 3>& place) {
      for (int d = -2; d <= 2; ++d) {
        const int at = joined ? (place[a] + d + n) % n : place[a] + d;
        if (at >= 0 && at < n) next[cell] &= full[cell + (at - place[a]) * lattice.stride[a]];
      }
    });
    full.swap(next);
  }
  for (int a = 0; a < Space::axes; ++a)
    over_all_cells(lattice, [&](std::ptrdiff_t cell, const std::array<int, 3>& place) {
      if (full[cell]) pores.weight[a][cell] = full_weight(lattice, a, place);
    });
}

/// The nearest cell with soil: below, at the side, above.
template <class Space>
std::ptrdiff_t host_of(const Setup<Space>& setup, const PoreFields<Space>& pores, std::ptrdiff_t cell,
                       const std::array<int, 3>& place) {
  const auto& lattice = setup.lattice;
  const auto walled = [&](std::ptrdiff_t from, std::ptrdiff_t step, int d, int a) {  // between it and d steps on
    for (int k = 0; k < d; ++k)
      if (setup.walls.blocked(a, step > 0 ? from + (k + 1) * step : from + k * step)) return true;
    return false;
  };
  for (int d = 1; d <= 3; ++d)
    for (const int sign : {-1, 1})
      for (int turn = 0; turn < Space::axes; ++turn) {
        const int a = (Space::up + turn) % Space::axes;
        std::array<int, 3> at = place;
        at[a] += sign * d;
        if (!inside(setup, at)) continue;
        const std::ptrdiff_t other = cell + (at[a] - place[a]) * lattice.stride[a];
        if (pores.bulk[other] > hardly * lattice.cell_volume(at) && !walled(cell, sign * lattice.stride[a], d, a))
          return other;
      }
  return -1;
}

/// Faces that no soil's own strain reaches follow the next one that has some, along their axis. The first and the last
/// face of a periodic model are one, which is decided for at the high end.
template <class Space>
void choose_leaders(const Setup<Space>& setup, GridFields<Space>& grid, PoreFields<Space>& pores,
                    const FaceField<Space>& raw) {
  const auto& lattice = setup.lattice;
  for (int c = 0; c < Space::axes; ++c) {
    const std::ptrdiff_t s = lattice.stride[c];
    const double least = 1e-6 * lattice.cell_volume();
    auto& leader = pores.leader[c];
    const auto borne = [&](std::ptrdiff_t f) { return grid.soil_mass[c][f] > 0 && raw[c][f - s] + raw[c][f] > least; };
    const bool joined = setup.soil_box.periodic(c);
    const int last = lattice.cells[c];
    const auto each = [&](auto&& body) {
      std::array<int, 3> n{1, 1, 1};
      for (int a = 0; a < Space::axes; ++a) n[a] = lattice.cells[a] + (a == c);
      for (int k = 0; k < n[2]; ++k)
        for (int j = 0; j < n[1]; ++j)
          for (int i = joined ? 1 : 0; i < n[0]; ++i) body(lattice.index(i, j, k), c == 0 ? i : c == 1 ? j : k);
    };
    const auto below = [&](std::ptrdiff_t f, int place) { return joined && place == 1 ? f + (last - 1) * s : f - s; };
    const auto above = [&](std::ptrdiff_t f, int place) {
      return joined && place == last ? f - (last - 1) * s : f + s;
    };
    each([&](std::ptrdiff_t f, int place) {
      leader[f] = static_cast<std::int8_t>(Leader::itself);
      if (grid.soil_mass[c][f] <= 0 && grid.soil_force[c][f] != 0 && borne(below(f, place))) {  // a load on the surface
        grid.soil_force[c][below(f, place)] += grid.soil_force[c][f];
        grid.soil_force[c][f] = 0;
      }
      if (grid.soil_mass[c][f] <= 0 || borne(f)) return;
      leader[f] = static_cast<std::int8_t>((joined || place > 0) && borne(below(f, place))      ? Leader::below
                                           : (joined || place < last) && borne(above(f, place)) ? Leader::above
                                                                                                : Leader::none);
    });
    each([&](std::ptrdiff_t f, int place) {
      const auto who = static_cast<Leader>(leader[f]);
      if (who != Leader::below && who != Leader::above) return;
      const std::ptrdiff_t to = who == Leader::below ? below(f, place) : above(f, place);
      for (auto* field : {&grid.soil_mass[c], &grid.soil_velocity[c], &grid.soil_force[c], &pores.held_mass[c]})
        (*field)[to] += (*field)[f];
    });
    detail::over_joined(c, setup.soil_box, lattice, {}, [&](std::ptrdiff_t low, std::ptrdiff_t high) {
      leader[low] = leader[high];
      for (auto* field : {&grid.soil_mass[c], &grid.soil_velocity[c], &grid.soil_force[c], &pores.held_mass[c]})
        (*field)[low] = (*field)[high];
    });
  }
}

/// The pressure of a cell that a body cuts acts on the body, too, as if the soil filled the cell: what is left of it
/// moves as the faces do that the body does not hold. A cell that is covered has no pressure: what is beside it is
/// pressed against the body.
template <class Space>
void complete_weights(const Setup<Space>& setup, PoreFields<Space>& pores) {
  over_all_cells(setup.lattice, [&](std::ptrdiff_t cell, const std::array<int, 3>& place) {
    const double body = 1 - setup.bodies.own_share(cell);
    for (int a = 0; a < Space::axes; ++a) {
      double& w = pores.weight[a][cell];
      const double full = full_weight(setup.lattice, a, place);
      if (setup.bodies.covered(cell))
        w = 0;
      else if (body > 0 && w > hardly * full) {
        const double across = lies_across(setup.bodies, setup.lattice, a, cell);
        w = w == full ? full * (1 - body * (1 - across)) : std::min(full, w + across * body * full);
      }
    }
  });
}

}  // namespace

template <class Space>
void prepare_cells(const Setup<Space>& setup, GridFields<Space>& grid, PoreFields<Space>& pores) {
  const auto& lattice = setup.lattice;
  const double least = hardly * lattice.cell_volume();  // of weights
  choose_leaders(setup, grid, pores, pores.weight);
  smooth_weights(setup, pores);
  if (setup.bodies.any()) complete_weights(setup, pores);
  const AlignedVector<std::uint8_t> before = pores.active;
  over_all_cells(lattice, [&](std::ptrdiff_t cell, const std::array<int, 3>& place) {
    bool active = pores.bulk[cell] > hardly * lattice.cell_volume(place);
    pores.host[cell] = -1;
    if (active) {
      for (auto& r : pores.resistance) r[cell] /= pores.bulk[cell];
    } else {
      for (const auto& w : pores.weight) active = active || w[cell] > least;
      const std::ptrdiff_t host = active ? host_of(setup, pores, cell, place) : -1;
      active = host >= 0;
      if (active) pores.host[cell] = static_cast<std::int32_t>(host);
    }
    if (!active)
      for (auto& w : pores.weight) w[cell] = 0;
    pores.active[cell] = active;
  });
  join_ends(pores.active, setup.soil_box, lattice);
  over_all_cells(lattice, [&](std::ptrdiff_t cell, const std::array<int, 3>& place) {
    const std::ptrdiff_t host = pores.host[cell];
    for (std::size_t d = 0; d < 2 && host >= 0; ++d) pores.resistance[d][cell] = pores.resistance[d][host];
    if (!pores.active[cell]) {
      grid.pressure[cell] = 0;
    } else if (host >= 0) {  // its host's, as still water
      const double rise = cells_between(lattice.axis[Space::up], lattice.place(host, Space::up), place[Space::up]);
      grid.pressure[cell] =
          grid.pressure[host] + rise * setup.water.density * setup.pull(Space::up) * lattice.spacing[Space::up];
      if (setup.tilt != 0)
        grid.pressure[cell] += setup.water.density * setup.pull(0) * lattice.spacing[0] *
                               way_along(setup, lattice.place(host, 0), place[0]);
    } else if (!before[cell]) {  // as still water from a neighbour that has had a pressure
      for (int turn = 0; turn < Space::axes; ++turn) {
        const int a = (Space::up + turn) % Space::axes;
        const std::ptrdiff_t s = lattice.stride[a];
        const bool joined = setup.soil_box.periodic(a);
        const auto fall = [&](int face) {
          const double weight = setup.water.density * setup.pull(a);
          return weight != 0 ? weight * lattice.axis[a].gap(face) : 0;
        };
        if ((place[a] > 0 || joined) && pores.active[cell - s] && (before[cell - s] || a == Space::up) &&
            !setup.walls.blocked(a, cell)) {
          grid.pressure[cell] = grid.pressure[cell - s] + fall(place[a]);
          break;
        }
        if ((place[a] < lattice.cells[a] - 1 || joined) && pores.active[cell + s] && before[cell + s] &&
            !setup.walls.blocked(a, cell + s)) {
          grid.pressure[cell] = grid.pressure[cell + s] - fall(place[a] + 1);
          break;
        }
      }
    }
  });
  join_ends(pores.host, setup.soil_box, lattice);
  join_ends(grid.pressure, setup.soil_box, lattice);
  for (Array* field : {&pores.resistance[0], &pores.resistance[1]}) join_ends(*field, setup.soil_box, lattice);
  for (auto& weight : pores.weight) join_ends(weight, setup.soil_box, lattice);
}

template <class Space>
void fill_pores(const Setup<Space>& setup, const GridFields<Space>& grid, PoreFields<Space>& pores, Team& team) {
  const auto& lattice = setup.lattice;
  over_cell_rows(lattice, grid.rows, team, [&](std::ptrdiff_t first, int count, const auto&) {
    for (std::ptrdiff_t cell = first; cell < first + count; ++cell) {
      double held = 0, slope = 0, wet = 0, conducts = 0, all = 0;
      const double p = grid.pressure[cell];
      const std::ptrdiff_t like = pores.host[cell] >= 0 ? pores.host[cell] : cell;
      for (std::size_t m = 0; m < setup.pores.size(); ++m) {
        const double own = pores.composition[m][cell], v = pores.composition[m][like];
        if (own == 0 && v == 0) continue;
        const PoreSpace& space = setup.pores[m];
        const WaterRatio ratio = water_ratio(space, p, setup.water.bulk_modulus);
        pores.ratio[m][cell] = ratio.value;
        held += own * ratio.value;
        slope += own * ratio.slope;
        wet += v * saturation(space.retention, -grid.pressure[like]);
        conducts += v * relative_conductivity(space.curve, space.retention, -p);
        all += v;
      }
      pores.content[cell] = held;
      pores.storage[cell] = slope;
      pores.saturation[cell] = all > 0 ? wet / all : 0;
      pores.relative[cell] = all > 0 ? conducts / all : 0;
    }
  });
  for (Array* field : {&pores.saturation, &pores.relative}) join_ends(*field, setup.soil_box, lattice);
  for (Array& ratio : pores.ratio) join_ends(ratio, setup.soil_box, lattice);
}

template <class Space>
void set_volume_change(const Setup<Space>& setup, const GridFields<Space>& grid, PoreFields<Space>& pores, Team& team) {
  const auto& lattice = setup.lattice;
  over_cell_rows(lattice, grid.rows, team, [&](std::ptrdiff_t first, int count, std::array<int, 3> place) {
    for (std::ptrdiff_t cell = first; cell < first + count; ++cell, ++place[0]) {
      double change = 0;
      for (int a = 0; a < Space::axes; ++a)
        change += pores.weight[a][cell] * true_area(lattice, a, place) *
                  (grid.soil_velocity[a][cell + lattice.stride[a]] - grid.soil_velocity[a][cell]) / lattice.spacing[a];
      pores.volume_change[cell] = pores.active[cell] ? change : 0;
    }
  });
  over_hosted(lattice, pores, [&](std::ptrdiff_t cell, std::ptrdiff_t host) {
    pores.volume_change[host] += pores.volume_change[cell];
    pores.volume_change[cell] = 0;
  });
}

#define POLDER_PORE_CELLS(Space)                                                                      \
  template void prepare_cells(const Setup<Space>&, GridFields<Space>&, PoreFields<Space>&);           \
  template void fill_pores(const Setup<Space>&, const GridFields<Space>&, PoreFields<Space>&, Team&); \
  template void set_volume_change(const Setup<Space>&, const GridFields<Space>&, PoreFields<Space>&, Team&);
POLDER_PORE_CELLS(PlaneStrain)
POLDER_PORE_CELLS(Solid)
#undef POLDER_PORE_CELLS

}  // namespace polder
