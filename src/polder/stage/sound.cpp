#include "polder/stage/sound.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "polder/math/simd.hpp"

namespace polder {

namespace {

constexpr double largest = 1e300;  // beyond it nothing is finite for long
constexpr double least_content = 1e-300;

bool within(double v, double low, double high) { return v >= low && v <= high; }

template <class Space, class Points>
std::string place_of(const Points& points, std::size_t p, const char* phase) {
  std::string place = fmt::format("{} point {} at (", phase, points.id[p]);
  for (int a = 0; a < Space::axes; ++a) place += fmt::format("{}{:.4g}", a == 0 ? "" : ", ", points.position[a][p]);
  return place + ")";
}

/// Looks through one array; `what` says what is wrong with a value outside [low, high].
template <class Space, class Points>
std::string outside(const Points& points, const char* phase, const Array& values, double low, double high,
                    const char* what) {
  if (all_within(values.data(), static_cast<std::ptrdiff_t>(values.size()), low, high)) return {};
  const auto bad = std::find_if(values.begin(), values.end(), [&](double v) { return !within(v, low, high); });
  const auto p = static_cast<std::size_t>(bad - values.begin());
  return fmt::format("{}: {} ({:.4g})", place_of<Space>(points, p, phase), what, *bad);
}

struct Range {
  const Array* values;
  double low, high;
};

/// Whether all values of all arrays are in their ranges, looked through by all threads.
bool all_within_ranges(const std::vector<Range>& ranges, Team& team) {
  std::atomic<bool> good = true;
  team.run([&](int rank) {
    for (const Range& range : ranges) {
      const auto [begin, end] = team.part(static_cast<std::ptrdiff_t>(range.values->size()), rank);
      if (!all_within(range.values->data() + begin, end - begin, range.low, range.high)) good = false;
    }
  });
  return good;
}

template <class Space, class Points>
std::string escaped(const Lattice<Space>& lattice, const Points& points, const char* phase) {
  for (int a = 0; a < Space::axes; ++a) {
    std::string found = outside<Space>(points, phase, points.position[a], 0, lattice.length(a),
                                       "it has left the model, or its position is not finite");
    if (!found.empty()) return found;
  }
  return {};
}

template <class Space, class Points>
std::string unsound_motion(const Lattice<Space>& lattice, const Points& points, const char* phase) {
  for (const Array& v : points.velocity)
    if (auto found = outside<Space>(points, phase, v, -largest, largest, "its velocity is not finite"); !found.empty())
      return found;
  return escaped(lattice, points, phase);
}

template <class Space>
std::string unsound_volume(const WaterPoints<Space>& water) {
  return outside<Space>(water, "water", water.volume, least_content, largest, "its volume is not positive");
}

/// Cells of the points' homes must be in the grid, in ascending order, and near where the points are.
template <class Space, class Points>
std::string flaw_of_homes(const Lattice<Space>& lattice, const Points& points, const char* phase) {
  const std::int64_t homes = count_homes(lattice);
  for (std::size_t p = 0; p < points.size(); ++p) {
    bool good = points.home[p] >= 0 && points.home[p] < homes && (p == 0 || points.home[p] >= points.home[p - 1]);
    if (good) {
      const auto home = cell_of_home(lattice, points.home[p]);
      for (int a = 0; a < Space::axes; ++a)
        good = good && home[a] < lattice.cells[a] &&
               std::abs(lattice.axis[a].place(points.position[a][p]) - (home[a] + 0.5)) < 3;
    }
    if (!good) return fmt::format("the cell of {} point {} is not where the point is", phase, points.id[p]);
  }
  return {};
}

template <class Points>
std::string flaw_of_lengths(Points& points, const char* phase) {
  std::string flaw;
  points.each_array([&](const char* name, int, const auto& array) {
    if (array.size() != points.size()) flaw = fmt::format("'{}' of the {} has another length", name, phase);
  });
  return flaw;
}

template <class Space>
std::string flaw_of_indices(const Stepper<Space>& state) {
  const auto& soil = state.soil;
  for (std::size_t p = 0; p < soil.size(); ++p)
    if (soil.material[p] >= state.setup.materials.size() || soil.load[p] > state.setup.loads.size())
      return fmt::format("soil point {} has a material or a load that the case does not have", soil.id[p]);
  if (state.unsaturated && !state.unsaturated->knows_conditions(state.setup))
    return "the ground of a column is under a condition that the case does not have";
  return {};
}

}  // namespace

template <class Space>
std::string escaped_point(const Stepper<Space>& state) {
  std::string found = escaped(state.setup.lattice, state.soil, "soil");
  return found.empty() ? escaped(state.setup.lattice, state.water, "water") : found;
}

template <class Space>
std::string unsound_point(const Stepper<Space>& state) {
  const auto& soil = state.soil;
  const auto& water = state.water;
  std::string found = unsound_motion(state.setup.lattice, soil, "soil");
  if (found.empty()) found = unsound_motion(state.setup.lattice, water, "water");
  if (found.empty())
    found = outside<Space>(soil, "soil", soil.porosity, possible_porosity[0], possible_porosity[1],
                           "its porosity is not between 0 and 1");
  for (const Array& s : soil.stress)
    if (found.empty()) found = outside<Space>(soil, "soil", s, -largest, largest, "its stress is not finite");
  if (found.empty())
    found = outside<Space>(soil, "soil", soil.mass, least_content, largest, "its mass is not positive");
  return found.empty() ? unsound_volume<Space>(water) : found;
}

template <class Space>
std::string unsound_point_after_step(const Stepper<Space>& state, Team& team) {
  if (state.unsaturated || !state.motion.sound) return unsound_point(state);
  std::vector<Range> ranges{{&state.water.volume, least_content, largest}};
  for (int a = 0; a < Space::axes; ++a)
    for (const Array* x : {&state.soil.position[a], &state.water.position[a]})
      ranges.push_back({x, 0, state.setup.lattice.length(a)});
  return all_within_ranges(ranges, team) ? std::string{} : unsound_point(state);
}

template <class Space>
std::string flaw_of(Stepper<Space>& state, bool sorted) {
  const auto& soil = state.soil;
  const auto& water = state.water;
  std::string flaw = flaw_of_lengths(state.soil, "soil");
  if (flaw.empty()) flaw = flaw_of_lengths(state.water, "water");
  if (flaw.empty()) flaw = unsound_point(state);
  if (flaw.empty()) flaw = flaw_of_indices(state);
  for (const Array& e : water.elongation)
    if (flaw.empty()) flaw = outside<Space>(water, "water", e, -1, 1e3, "its box has no such shape");
  if (flaw.empty() && sorted) flaw = flaw_of_homes(state.setup.lattice, soil, "soil");
  if (flaw.empty() && sorted) flaw = flaw_of_homes(state.setup.lattice, water, "water");
  return flaw;
}

template std::string escaped_point(const Stepper<PlaneStrain>&);
template std::string escaped_point(const Stepper<Solid>&);
template std::string unsound_point(const Stepper<PlaneStrain>&);
template std::string unsound_point(const Stepper<Solid>&);
template std::string unsound_point_after_step(const Stepper<PlaneStrain>&, Team&);
template std::string unsound_point_after_step(const Stepper<Solid>&, Team&);
template std::string flaw_of(Stepper<PlaneStrain>&, bool);
template std::string flaw_of(Stepper<Solid>&, bool);

}  // namespace polder
