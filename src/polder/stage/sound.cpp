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

/// What the values of an array must lie between.
struct Bounds {
  const Array* values;
  double low, high;
  bool of_soil;
  const char* what;  ///< it says of a point outside
};

template <class Space>
std::vector<Bounds> bounds_of_positions(const Stepper<Space>& state) {
  std::vector<Bounds> all;
  for (const bool soil : {true, false})
    for (int a = 0; a < Space::axes; ++a)
      all.push_back({soil ? &state.soil.position[a] : &state.water.position[a], 0, state.setup.lattice.length(a), soil,
                     "it has left the model, or its position is not finite"});
  return all;
}

/// Those that the step does not look at itself while it moves the points.
template <class Space>
std::vector<Bounds> bounds_after_step(const Stepper<Space>& state) {
  std::vector<Bounds> all = bounds_of_positions(state);
  all.push_back({&state.water.volume, least_content, largest, false, "its volume is not positive"});
  return all;
}

template <class Space>
std::vector<Bounds> all_bounds(const Stepper<Space>& state) {
  const auto& soil = state.soil;
  std::vector<Bounds> all;
  for (int a = 0; a < Space::axes; ++a) {
    all.push_back({&soil.velocity[a], -largest, largest, true, "its velocity is not finite"});
    all.push_back({&state.water.velocity[a], -largest, largest, false, "its velocity is not finite"});
  }
  all.push_back(
      {&soil.porosity, possible_porosity[0], possible_porosity[1], true, "its porosity is not between 0 and 1"});
  for (const Array& s : soil.stress) all.push_back({&s, -largest, largest, true, "its stress is not finite"});
  all.push_back({&soil.mass, least_content, largest, true, "its mass is not positive"});
  for (const Bounds& bounds : bounds_after_step(state)) all.push_back(bounds);
  return all;
}

/// The first point whose values are not within the bounds, as a text; empty if there is none.
template <class Points>
std::string outside(const Points& points, const Bounds& bounds) {
  const Array& values = *bounds.values;
  if (all_within(values.data(), static_cast<std::ptrdiff_t>(values.size()), bounds.low, bounds.high)) return {};
  const auto bad =
      std::find_if(values.begin(), values.end(), [&](double v) { return !(v >= bounds.low && v <= bounds.high); });
  const auto p = static_cast<std::size_t>(bad - values.begin());
  std::string place;
  for (const Array& x : points.position) place += fmt::format("{}{:.4g}", place.empty() ? "" : ", ", x[p]);
  return fmt::format("{} point {} at ({}): {} ({:.4g})", bounds.of_soil ? "soil" : "water", points.id[p], place,
                     bounds.what, *bad);
}

template <class Space>
std::string first_outside(const Stepper<Space>& state, const std::vector<Bounds>& all) {
  for (const Bounds& bounds : all) {
    std::string found = bounds.of_soil ? outside(state.soil, bounds) : outside(state.water, bounds);
    if (!found.empty()) return found;
  }
  return {};
}

/// Whether everything is within its bounds, looked through by all threads.
bool all_within_bounds(const std::vector<Bounds>& all, Team& team) {
  std::atomic<bool> good = true;
  team.run([&](int rank) {
    for (const Bounds& bounds : all) {
      const auto [begin, end] = team.part(static_cast<std::ptrdiff_t>(bounds.values->size()), rank);
      if (!all_within(bounds.values->data() + begin, end - begin, bounds.low, bounds.high)) good = false;
    }
  });
  return good;
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
  return first_outside(state, bounds_of_positions(state));
}

template <class Space>
std::string unsound_point(const Stepper<Space>& state) {
  return first_outside(state, all_bounds(state));
}

template <class Space>
std::string unsound_point_after_step(const Stepper<Space>& state, Team& team) {
  const bool looked_at = !state.unsaturated && state.motion.sound;
  const bool good = all_within_bounds(looked_at ? bounds_after_step(state) : all_bounds(state), team);
  return good ? std::string{} : unsound_point(state);
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
    if (flaw.empty()) flaw = outside(water, {&e, -1, 1e3, false, "its box has no such shape"});
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
