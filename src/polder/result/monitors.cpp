#include "polder/result/monitors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "polder/case/geometry.hpp"
#include "polder/case/wall_motion.hpp"
#include "polder/result/ground_stress.hpp"
#include "polder/result/measures.hpp"
#include "polder/step/face_loop.hpp"
#include "polder/step/interior.hpp"

namespace polder {

namespace {

template <class Space>
double displacement(const SoilPoints<Space>& soil, std::size_t p) {
  double square = 0;
  for (int a = 0; a < Space::axes; ++a) {
    const double d = soil.position[a][p] - soil.reference[a][p];
    square += d * d;
  }
  return std::sqrt(square);
}

template <class Space>
double solid_volume(const Simulation<Space>& run, std::size_t p) {
  const auto& state = run.state();
  return state.soil.mass[p] / state.setup.materials[state.soil.material[p]].grain_density;
}

/// Index of the point nearest to `place` (of several, that of the lowest id); there must be at least one.
template <std::size_t N>
std::size_t nearest(const std::array<Array, N>& position, const AlignedVector<std::uint64_t>& id, const Point3& place) {
  std::size_t best = 0;
  double closest = 1e300;
  for (std::size_t p = 0; p < id.size(); ++p) {
    double square = 0;
    for (std::size_t a = 0; a < N; ++a) {
      const double d = position[a][p] - place[a];
      square += d * d;
    }
    if (square < closest || (square == closest && id[p] < id[best])) closest = square, best = p;
  }
  return best;
}

/// Discharge m³/s (per metre) or mean pressure through the section, a line snapped to the nearest faces.
template <class Space>
double section(const Simulation<Space>& run, const Monitor& monitor) {
  const auto& lattice = run.state().setup.lattice;
  const auto& grid = run.state().grid;
  const Point3 &from = monitor.at[0], &to = monitor.at[1];
  if (monitor.quantity == "uplift-length") return uplift_length(run, from, to);
  const int up = Space::up;
  const bool upright = std::abs(from[0] - to[0]) <= std::abs(from[up] - to[up]);
  const int axis = upright ? 0 : up, along = upright ? up : 0;
  const int face = lattice.axis[axis].nearest_edge(0.5 * (from[axis] + to[axis]));
  const double low = std::min(from[along], to[along]), high = std::max(from[along], to[along]);
  double flux = 0, pressure = 0;
  int wet = 0;
  for (int k = 0; k < (Space::axes == 3 ? lattice.cells[1] : 1); ++k)
    for (int s = 0; s < lattice.cells[along]; ++s) {
      const double middle = lattice.axis[along].centre(s);
      if (middle < low || middle > high) continue;
      std::array<int, 3> place{0, 0, 0};
      place[axis] = face;
      place[along] = s;
      if (Space::axes == 3) place[1] = k;
      const std::ptrdiff_t f = lattice.index(place[0], place[1], place[2]), before = f - lattice.stride[axis];
      if (run.state().unsaturated) {
        flux += grid.discharge[axis][f] * lattice.face_area(axis, place);
        pressure += 0.5 * (grid.pressure[f] + grid.pressure[before]);
        ++wet;
        continue;
      }
      if (!grid.reached[axis][f]) continue;
      const double n = grid.porosity[axis][f];
      flux += run.state().setup.bodies.open_face(axis, f) * n * flowing_share(run.state().setup, grid, axis, f) *
              grid.water_velocity[axis][f] * lattice.face_area(axis, place);
      pressure += 0.5 * (grid.pressure[f] + grid.pressure[before]);
      ++wet;
    }
  if (monitor.quantity == "discharge") return flux;
  return wet > 0 ? pressure / wet : 0;
}

/// Force on a body in the last step, or how far it has moved; along x and upwards. 0 where it is not there.
template <class Space>
Point2 of_wall(const Simulation<Space>& run, const Monitor& monitor) {
  const auto wall = static_cast<std::size_t>(monitor.wall);
  if (monitor.quantity == "displacement") return displacement_at(run.model().walls[wall], run.time());
  Point2 sum{0, 0};
  for (const BodyForce& force : run.state().body_force)
    for (std::size_t k = 0; force.wall == wall && k < 2; ++k)
      sum[k] += force.soil[k] + (monitor.quantity == "force" ? force.water[k] : 0);
  return sum;
}

struct Part {
  std::string suffix, unit;
};

/// The columns that one place of a monitor makes.
template <class Space>
std::vector<Part> parts_of(const Monitor& monitor) {
  const auto& q = monitor.quantity;
  const std::string up = Space::axes == 3 ? " z" : " y";
  if (q == "force" || q == "soil-force") {
    const char* unit = Space::axes == 3 ? "N" : "N/m";
    return {{" fx", unit}, {" f" + up.substr(1), unit}};
  }
  if (q == "displacement") return {{" ux", "m"}, {" u" + up.substr(1), "m"}};
  if (q == "velocity" || q == "water-velocity") return {{" vx", "m/s"}, {" v" + up.substr(1), "m/s"}};
  if (q == "effective-stress") return {{" sxx", "Pa"}, {" s" + up.substr(1) + up.substr(1), "Pa"}};
  if (q == "pressure" || q == "excess-pressure" || q == "total-stress") return {{"", "Pa"}};
  if (q == "wedge-angle") return {{"", "deg"}};
  if (q == "saturation") return {{"", ""}};
  if (q == "uplift-length") return {{"", "m"}};
  if (q == "porosity" || q == "largest-porosity") return {{"", ""}};
  if (q == "discharge") return {{"", Space::axes == 3 ? "m3/s" : "m2/s"}};
  if (q == "water-surface" || q == "soil-surface" || q == "settlement" || q == "largest-uplift" || q == "water-front" ||
      q == "soil-front")
    return {{"", "m"}};
  if (q == "kinetic-energy") return {{"", Space::axes == 3 ? "J" : "J/m"}};
  return {{"", Space::axes == 3 ? "m3" : "m2"}};
}

template <class Space>
void sample_point(const Simulation<Space>& run, const Monitor& monitor, const Point3& place, std::size_t p,
                  std::vector<double>& row) {
  const auto& state = run.state();
  const bool soil = state.soil.size() > 0;
  const auto& q = monitor.quantity;
  const auto value = [&](auto& array) { return soil ? array[p] : 0.0; };
  if (q == "pressure") {
    row.push_back(
        run.pressure_at(soil && monitor.follows_soil ? position_of(state.soil, p) : std::array<double, 3>(place)));
  } else if (q == "excess-pressure") {
    row.push_back(excess_pressure(run, soil && monitor.follows_soil ? Point3(position_of(state.soil, p)) : place));
  } else if (q == "wedge-angle") {
    row.push_back(wedge_angle(run, place));
  } else if (q == "total-stress") {
    row.push_back(total_vertical_stress(
        run, soil && monitor.follows_soil ? position_of(state.soil, p) : std::array<double, 3>(place)));
  } else if (q == "saturation") {
    row.push_back(soil ? point_saturation(run, p) : 0);
  } else if (q == "porosity") {
    row.push_back(value(state.soil.porosity));
  } else if (q == "displacement") {
    for (const int a : {0, Space::up}) row.push_back(soil ? state.soil.position[a][p] - state.soil.reference[a][p] : 0);
  } else if (q == "velocity") {
    for (const int a : {0, Space::up}) row.push_back(value(state.soil.velocity[a]));
  } else if (q == "effective-stress") {
    for (const int a : {0, Space::up}) row.push_back(value(state.soil.stress[a]));
  } else {  // water-velocity
    const bool water = state.water.size() > 0;
    const std::size_t w = water ? nearest(state.water.position, state.water.id, place) : 0;
    for (const int a : {0, Space::up}) row.push_back(water ? state.water.velocity[a][w] : 0);
  }
}

}  // namespace

template <class Space>
Energies energies(const Simulation<Space>& run) {
  const auto& state = run.state();
  const double g = state.setup.gravity, rho = state.setup.water.density;
  Energies e;
  for (std::size_t p = 0; p < state.soil.size(); ++p) {
    e.soil_kinetic += 0.5 * state.soil.mass[p] * speed_squared(state.soil, p);
    e.potential += state.soil.mass[p] * g * state.soil.position[Space::up][p];
  }
  for (std::size_t p = 0; p < state.water.size(); ++p) {
    e.water_kinetic += 0.5 * rho * state.water.volume[p] * speed_squared(state.water, p);
    e.potential += rho * state.water.volume[p] * g * state.water.position[Space::up][p];
  }
  return e;
}

template <class Space>
Monitors<Space>::Monitors(const Simulation<Space>& run, const std::vector<std::uint64_t>& followed)
    : model_(run.model()) {
  const std::uint64_t placed = first_placed_id(model_, run.state().setup.lattice);
  const std::string volume = Space::axes == 3 ? "m3" : "m2", energy = Space::axes == 3 ? "J" : "J/m";
  columns_ = {{"time step", "s"},
              {"soil kinetic energy", energy},
              {"water kinetic energy", energy},
              {"potential energy", energy},
              {"water volume", volume},
              {"largest pressure", "Pa"},
              {"pressure iterations per step", ""},
              {"overfilled cells", ""},
              {"water balance error", ""},
              {"flux balance error", ""}};
  const auto& soil = run.state().soil;
  if (soil.size() > 0) {
    columns_.push_back({"mean soil displacement", "m"});
    columns_.push_back({"soil outside outline", ""});
    columns_.push_back({"fluidised soil", volume});
    columns_.push_back({"largest porosity", ""});
  }
  for (const Monitor& monitor : model_.monitors) {
    if (monitor.kind != MonitorKind::point && monitor.kind != MonitorKind::surface) {
      members_.emplace_back();
      before_.emplace_back();
      if (monitor.quantity == "eroded-area") before_.back() = soil_columns(run, monitor.region, true);
      if (monitor.quantity == "settlement") {
        for (std::size_t p = 0; p < soil.size(); ++p)
          if (soil.id[p] < placed && inside<Space>(monitor.region, reference_of(soil, p)))
            members_.back().push_back(soil.id[p]);
        std::sort(members_.back().begin(), members_.back().end());
      }
      for (const auto& part : parts_of<Space>(monitor)) columns_.push_back({monitor.name + part.suffix, part.unit});
      followers_.push_back({&monitor, 0, members_.size() - 1, false});
      continue;
    }
    for (std::size_t i = 0; i < monitor.at.size(); ++i) {
      const bool point = monitor.kind == MonitorKind::point && soil.size() > 0;
      const std::size_t number_of = followers_.size();
      const std::uint64_t id = !point                        ? 0
                               : number_of < followed.size() ? followed[number_of]
                                                             : soil.id[nearest(soil.reference, soil.id, monitor.at[i])];
      followers_.push_back({&monitor, i, id, point && monitor.follows_soil});
      const std::string number = monitor.at.size() > 1 ? fmt::format(" {}", i + 1) : "";
      for (const auto& part : parts_of<Space>(monitor))
        columns_.push_back({monitor.name + number + part.suffix, part.unit});
    }
  }
}

template <class Space>
std::vector<std::uint64_t> Monitors<Space>::followed() const {
  std::vector<std::uint64_t> ids;
  for (const Follower& follower : followers_) ids.push_back(follower.soil_id);
  return ids;
}

template <class Space>
std::vector<double> Monitors<Space>::sample(const Simulation<Space>& run, double dt) const {
  const auto& state = run.state();
  const auto& soil = state.soil;
  const Energies e = energies(run);
  std::vector<double> row{dt, e.soil_kinetic, e.water_kinetic, e.potential, stored_water(state)};
  row.push_back(*std::max_element(state.grid.pressure.begin(), state.grid.pressure.end()));
  const Audit<Space>& audit = run.audit();
  row.push_back(audit.steps > 0 ? static_cast<double>(audit.pressure_iterations) / static_cast<double>(audit.steps)
                                : 0);
  row.push_back(audit.overfilled_now);
  row.push_back(audit.water_balance_error(state));
  row.push_back(audit.flux_balance_error());
  if (soil.size() > 0) {
    double moved = 0, outside = 0, total = 0, fluid = 0, loosest = 0;
    for (std::size_t p = 0; p < soil.size(); ++p) {
      const double v = solid_volume(run, p);
      total += v;
      moved += v * displacement(soil, p);
      const auto within = [&](const Region& region) { return inside<Space>(region, position_of(soil, p)); };
      const bool in = std::any_of(model_.soils.begin(), model_.soils.end(),
                                  [&](const SoilBody& body) { return within(body.region); }) ||
                      std::any_of(model_.changes.begin(), model_.changes.end(), [&](const GroundChange& change) {
                        return change.kind == ChangeKind::place && within(change.region);
                      });
      if (!in) outside += v;
      if (soil.fluid[p]) fluid += v / (1 - soil.porosity[p]);
      loosest = std::max(loosest, soil.porosity[p]);
    }
    row.insert(row.end(), {moved / total, outside / total, fluid, loosest});
  }
  std::vector<std::pair<std::uint64_t, std::size_t>> by_id;
  for (const Follower& follower : followers_)
    if (follower.follows && by_id.empty())
      for (std::size_t p = 0; p < soil.size(); ++p) by_id.emplace_back(soil.id[p], p);
  std::sort(by_id.begin(), by_id.end());
  for (const Follower& follower : followers_) {
    const Monitor& monitor = *follower.monitor;
    if (monitor.kind == MonitorKind::section) {
      row.push_back(section(run, monitor));
    } else if (monitor.kind == MonitorKind::wall) {
      for (const double v : of_wall(run, monitor)) row.push_back(v);
    } else if (monitor.kind == MonitorKind::surface) {
      const Point3& place = monitor.at[follower.place];
      row.push_back(monitor.quantity == "water-surface" ? water_surface(run, place) : soil_surface(run, place));
    } else if (monitor.kind == MonitorKind::integral) {
      double sum = 0, weight = 0;
      if (monitor.quantity == "settlement") {
        const auto& members = members_[follower.soil_id];
        for (std::size_t p = 0; p < soil.size(); ++p)
          if (std::binary_search(members.begin(), members.end(), soil.id[p])) {
            const double v = solid_volume(run, p);
            weight += v;
            sum += v * (soil.reference[Space::up][p] - soil.position[Space::up][p]);
          }
        sum = weight > 0 ? sum / weight : 0;
      } else if (monitor.quantity == "largest-porosity") {
        for (std::size_t p = 0; p < soil.size(); ++p)
          if (inside<Space>(monitor.region, position_of(soil, p))) sum = std::max(sum, soil.porosity[p]);
      } else if (monitor.quantity == "eroded-area") {
        sum = eroded_area(run, monitor.region, before_[follower.soil_id]);
      } else if (monitor.quantity == "largest-uplift") {
        sum = largest_uplift(run, monitor.region);
      } else if (monitor.quantity == "water-front") {
        sum = water_front(run);
      } else if (monitor.quantity == "soil-front") {
        sum = soil_front(run);
      }
      const bool kinetic = monitor.quantity == "kinetic-energy";
      const bool water = kinetic || monitor.quantity == "water-volume";
      const bool grains = kinetic || monitor.quantity == "soil-volume";
      if (water || grains) {
        if (water)
          for (std::size_t p = 0; p < state.water.size(); ++p)
            if (inside<Space>(monitor.region, position_of(state.water, p)))
              sum += state.water.volume[p] *
                     (kinetic ? 0.5 * state.setup.water.density * speed_squared(state.water, p) : 1);
        if (grains)
          for (std::size_t p = 0; p < soil.size(); ++p)
            if (inside<Space>(monitor.region, position_of(soil, p)))
              sum +=
                  kinetic ? 0.5 * soil.mass[p] * speed_squared(soil, p) : solid_volume(run, p) / (1 - soil.porosity[p]);
      }
      row.push_back(sum);
    } else {
      std::size_t p = 0;
      if (follower.follows) {
        const auto at = std::lower_bound(by_id.begin(), by_id.end(), std::pair{follower.soil_id, std::size_t{0}});
        if (at == by_id.end() || at->first != follower.soil_id) {  // it was excavated
          row.insert(row.end(), parts_of<Space>(monitor).size(), std::numeric_limits<double>::quiet_NaN());
          continue;
        }
        p = at->second;
      } else if (soil.size() > 0)
        p = nearest(soil.position, soil.id, monitor.at[follower.place]);
      sample_point(run, monitor, monitor.at[follower.place], p, row);
    }
  }
  return row;
}

template Energies energies(const Simulation<PlaneStrain>&);
template Energies energies(const Simulation<Solid>&);
template class Monitors<PlaneStrain>;
template class Monitors<Solid>;

}  // namespace polder
