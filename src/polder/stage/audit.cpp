#include "polder/stage/audit.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>

#include "polder/math/simd.hpp"
#include "polder/step/face_loop.hpp"
#include "polder/step/interior.hpp"

namespace polder {

namespace {

/// With what each addition rounds off kept beside it (Knuth's TwoSum): the audit must see round-off of the run, not its
/// own, in whatever order the points lie.
template <class Number>
struct CompensatedSum {
  Number sum{}, rounded{};

  void operator+=(Number v) {
    const Number next = sum + v, taken = next - sum;
    rounded += (sum - (next - taken)) + (v - taken);
    sum = next;
  }
};

double compensated_sum(const Array& values) {
  CompensatedSum<Vec4> four;
  const std::ptrdiff_t n = static_cast<std::ptrdiff_t>(values.size()), whole = n / 4 * 4;
  for (std::ptrdiff_t i = 0; i < whole; i += 4) four += load4(values.data() + i);
  CompensatedSum<double> all;
  for (int lane = 0; lane < 4; ++lane) {
    all += four.sum[lane];
    all += four.rounded[lane];
  }
  for (std::ptrdiff_t i = whole; i < n; ++i) all += values[static_cast<std::size_t>(i)];
  return all.sum + all.rounded;
}

}  // namespace

template <class Space>
double stored_water(const Stepper<Space>& state) {
  const double free = compensated_sum(state.water.volume);
  if (!state.setup.single_point) return free;
  const double all = free + compensated_sum(state.soil.water);
  if (state.open_water) return all + state.open_water->booked();
  return std::accumulate(state.grid.spare.begin(), state.grid.spare.end(), all);
}
template double stored_water(const Stepper<PlaneStrain>&);
template double stored_water(const Stepper<Solid>&);

template <class Space>
Audit<Space>::Audit(const Model& model, const Stepper<Space>& state) {
  solid_at_start_ = compensated_sum(state.soil.mass);
  water_at_start_ = stored_water(state);
  const auto& lattice = state.setup.lattice;
  if (state.setup.single_point) return;  // no points of water to compare a flux with
  if (state.setup.periodic) return;      // no section that water passes once
  for (const auto& boundary : model.boundaries) {
    if (boundary.side || boundary.line.size() != 2 || boundary.water != WaterCondition::open) continue;
    const bool upright = std::abs(boundary.line[0][0] - boundary.line[1][0]) < 1e-9 * lattice.length(0);
    const int axis = upright ? 0 : Space::up;
    const int face = lattice.axis[axis].nearest_edge(boundary.line[0][upright ? 0 : 1]);
    sections_.push_back({axis, face, lattice.axis[axis].edge(face)});
  }
  if (sections_.empty()) sections_.push_back({0, lattice.cells[0] / 2, lattice.axis[0].edge(lattice.cells[0] / 2)});
}

/// Water in a row of cells past the section, as the points' boxes fill them at the start of the last step.
template <class Space>
double Audit<Space>::water_beyond(const Stepper<Space>& state, const Section& section, std::ptrdiff_t first, int count,
                                  const std::array<int, 3>& place) const {
  if (section.axis != 0 && place[section.axis] < section.face) return 0;
  double sum = 0;
  for (int i = section.axis == 0 ? std::max(0, section.face - place[0]) : 0; i < count; ++i)
    sum += state.grid.water_volume[first + i];
  return sum;
}

/// Counts the wet cells of a row.
template <class Space>
auto Audit<Space>::count_cells(const Stepper<Space>& state, std::ptrdiff_t first, int count,
                               const std::array<int, 3>& place) const -> CellCounts {
  const auto& grid = state.grid;
  CellCounts counts;
  for (int i = 0; i < count; ++i) {
    if (i + 8 <= count && eight(grid.wet.data() + first + i) == 0) {
      i += 7;
      continue;
    }
    const std::ptrdiff_t cell = first + i;
    if (!grid.wet[cell]) continue;
    const bool interior = is_inside_water(state.setup, grid, cell, {place[0] + i, place[1], place[2]});
    counts += {1, grid.fill[cell] > 1.05, interior, interior && grid.fill[cell] < 0.95};
  }
  return counts;
}

/// Looks through the cells.
template <class Space>
auto Audit<Space>::look_through(const Stepper<Space>& state, Team& team) -> CellCounts {
  const auto& lattice = state.setup.lattice;
  const std::size_t sections = sections_.size();
  beyond_.assign(static_cast<std::size_t>(lattice.row_count()) * sections, 0.0);
  CellCounts all;
  std::mutex mutex;  // taken once a thread; what is counted does not depend on the order
  share_rows(state.grid.rows, team, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    CellCounts own;
    visit_cell_rows(lattice, state.grid.rows, begin, end,
                    [&](std::ptrdiff_t first, int count, const std::array<int, 3>& place) {
                      own += count_cells(state, first, count, place);
                      const auto row = static_cast<std::size_t>(place[1] + std::ptrdiff_t{place[2]} * lattice.cells[1]);
                      for (std::size_t s = 0; s < sections; ++s)
                        beyond_[row * sections + s] = water_beyond(state, sections_[s], first, count, place);
                    });
    const std::lock_guard lock(mutex);
    all += own;
  });
  return all;
}

template <class Space>
void Audit<Space>::take(const Stepper<Space>& state, double dt, Team& team) {
  const auto& lattice = state.setup.lattice;
  const auto& grid = state.grid;
  ++steps;
  const CellCounts cells = look_through(state, team);
  for (std::size_t s = 0; s < sections_.size(); ++s) {
    Section& section = sections_[s];
    double beyond = 0;
    for (std::size_t at = s; at < beyond_.size(); at += sections_.size()) beyond += beyond_[at];
    if (steps == 1) section.beyond_at_start = beyond;
    section.moved = beyond - section.beyond_at_start - section.exchanged;
    section.passed_before = section.passed;
    double flux = 0;  // m³/s
    const int ny = lattice.cells[1], nz = Space::axes == 3 ? lattice.cells[2] : 1;
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < ny; ++j)
        for (int i = 0; i < lattice.cells[0]; ++i) {
          const int at[3] = {i, j, k};
          if (section.axis == 0 ? i != 0 : at[section.axis] != section.face) continue;
          const std::ptrdiff_t f = section.axis == 0 ? lattice.index(section.face, j, k) : lattice.index(i, j, k);
          // between cells the projection balances n v_w; where none is wet, water flies with the mass it has
          const bool balanced = grid.reached[section.axis][f];
          const double full_of_water = state.setup.water.density * lattice.cell_volume(f);
          const double area = balanced
                                  ? grid.porosity[section.axis][f] * flowing_share(state.setup, grid, section.axis, f)
                                  : grid.water_mass[section.axis][f] / full_of_water;
          flux += area * state.setup.bodies.open_face(section.axis, f) * grid.water_velocity[section.axis][f] *
                  lattice.face_area(section.axis, f);
          if (section.axis == 0) break;
        }
    section.passed += flux * dt;
    section.most = std::max(section.most, std::abs(section.passed));
  }

  for (const Exchange& exchange : state.exchanged) book(state, exchange);
  for (const BodyForce& force : state.body_force) {
    displaced += force.displaced * dt;
    body_work += force.power * dt;
  }

  const auto share = [](std::uint64_t part, std::uint64_t whole) {
    return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0;
  };
  overfilled_now = share(cells.over, cells.wet);
  underfilled_now = share(cells.under, cells.inside);
  overfilled_most = std::max(overfilled_most, overfilled_now);
  underfilled_most = std::max(underfilled_most, underfilled_now);
}

template <class Space>
void Audit<Space>::take(const Stepper<Space>& state, const ChangedMass& changed) {
  solid_in += changed.solid_in;
  solid_out += changed.solid_out;
  for (const Exchange& exchange : changed.water) book(state, exchange);
}

/// Sections count what is beyond them from their first step on.
template <class Space>
void Audit<Space>::book(const Stepper<Space>& state, const Exchange& exchange) {
  (exchange.volume > 0 ? water_in : water_out) += std::abs(exchange.volume);
  for (auto& section : sections_)
    if (steps > 0 && state.setup.lattice.place(exchange.cell, section.axis) >= section.face)
      section.exchanged += exchange.volume;
}

template <class Space>
double Audit<Space>::solid_mass_error(const Stepper<Space>& state) const {
  const double mass = compensated_sum(state.soil.mass), most = solid_at_start_ + solid_in;
  return most > 0 ? std::abs(mass - solid_at_start_ - solid_in + solid_out) / most : 0;
}

template <class Space>
double Audit<Space>::water_balance_error(const Stepper<Space>& state) const {
  const double stored = stored_water(state);
  return water_at_start_ > 0 ? std::abs(stored - water_at_start_ - water_in + water_out) / water_at_start_ : 0;
}

template <class Space>
FluxError Audit<Space>::worst_flux() const {
  FluxError worst;
  for (const auto& section : sections_) {
    const double scale = std::max(section.most, 1e-3 * water_at_start_);
    if (scale <= 0) continue;
    const double error = std::abs(section.passed_before - section.moved) / scale;
    if (error > worst.error)
      worst = {error, section.axis, section.at, water_at_start_ > 0 ? section.most / water_at_start_ : 1};
  }
  return worst;
}

template class Audit<PlaneStrain>;
template class Audit<Solid>;

}  // namespace polder
