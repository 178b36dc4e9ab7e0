#include "polder/stage/ground_changes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "polder/case/geometry.hpp"
#include "polder/case/grid_sites.hpp"
#include "polder/points/seed.hpp"
#include "polder/stage/initial.hpp"
#include "polder/stage/stress_at_rest.hpp"
#include "polder/step/pore_curves.hpp"
#include "polder/step/soil_volume.hpp"

namespace polder {

namespace {

/// The lattice on which points are seeded.
template <class Space>
struct Sites {
  std::array<SiteAxis, 3> axis;
  Sites(const Model& model, const Lattice<Space>& lattice) {
    for (int a = 0; a < Space::axes; ++a) axis[a] = SiteAxis(lattice.axis[a], model.points_per_axis);
  }
  using Site = std::array<long, 3>;
  Site of(const std::array<double, 3>& x) const {
    Site site{0, 0, 0};
    for (int a = 0; a < Space::axes; ++a) site[a] = axis[a].site_at(x[a]);
    return site;
  }
};

template <class Space>
bool in_region(const Region& region, const std::array<double, 3>& x) {
  return contains(region, x[0], Space::axes == 3 ? x[1] : 0, x[Space::up]);
}

/// Soil points that go, by site, so that the water between their grains can be told from free water above them.
template <class Space>
class Pores {
 public:
  Pores(const Sites<Space>& sites, const SoilPoints<Space>& soil, const std::vector<std::uint8_t>& goes)
      : sites_(sites), soil_(soil) {
    for (std::size_t p = 0; p < soil.size(); ++p)
      if (goes[p]) by_site_.emplace(sites.of(position_of(soil, p)), p);
  }
  /// A soil point that goes is less than three quarters of a site away on each axis.
  bool contain(const std::array<double, 3>& x) const {
    constexpr double near = 0.75;
    const auto site = sites_.of(x);
    const int depth = Space::axes == 3 ? 1 : 0;
    for (int k = -depth; k <= depth; ++k)
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
          const auto [low, high] = by_site_.equal_range({site[0] + i, site[1] + j, site[2] + k});
          for (auto at = low; at != high; ++at) {
            bool close = true;
            for (int a = 0; a < Space::axes; ++a)
              close = close && std::abs(soil_.position[a][at->second] - x[a]) <= near * sites_.axis[a].width(site[a]);
            if (close) return true;
          }
        }
    return false;
  }

 private:
  const Sites<Space>& sites_;
  const SoilPoints<Space>& soil_;
  std::multimap<typename Sites<Space>::Site, std::size_t> by_site_;
};

template <class Space>
void excavate(const Model& model, const GroundChange& change, Stepper<Space>& state, ChangedMass& changed) {
  const auto& lattice = state.setup.lattice;
  auto& soil = state.soil;
  auto& water = state.water;
  std::vector<std::uint8_t> goes(soil.size(), 0), drained(water.size(), 0);
  for (std::size_t p = 0; p < soil.size(); ++p) {
    goes[p] = in_region<Space>(change.region, position_of(soil, p));
    if (goes[p]) changed.solid_out += soil.mass[p];
    if (goes[p] && state.setup.single_point)
      changed.water.push_back({cell_at(lattice, position_of(soil, p)), -soil.water[p]});
  }
  if (change.water != ExcavatedWater::leave) {
    const Sites<Space> sites(model, lattice);
    const Pores<Space> pores(sites, soil, goes);
    for (std::size_t p = 0; p < water.size(); ++p) {
      const auto x = position_of(water, p);
      if (!in_region<Space>(change.region, x) || !pores.contain(x)) continue;
      const std::ptrdiff_t cell = cell_at(lattice, x);
      if (change.water == ExcavatedWater::take) {
        drained[p] = 1;
        changed.water.push_back({cell, -water.volume[p]});
      } else {
        const double more = water.volume[p] * (1 / state.grid.cell_porosity[cell] - 1);
        water.volume[p] += more;
        changed.water.push_back({cell, more});
      }
    }
    remove_points(water, drained);
  }
  remove_points(soil, goes);
}

template <class Space>
void place(const Model& model, const GroundChange& change, std::uint64_t first_id, Stepper<Space>& state,
           ChangedMass& changed) {
  const auto& lattice = state.setup.lattice;
  Model only = model;  // this soil and nothing else
  only.soils = {SoilBody{change.material, change.region, {}}};
  only.free_water.clear();
  SoilPoints<Space> placed = seed_points<Space>(only, lattice).soil;
  const Sites<Space> sites(model, lattice);
  std::set<typename Sites<Space>::Site> taken, filled;
  for (std::size_t p = 0; p < state.soil.size(); ++p) taken.insert(sites.of(position_of(state.soil, p)));
  std::vector<std::uint8_t> no_room(placed.size(), 0);
  for (std::size_t p = 0; p < placed.size(); ++p) {
    placed.id[p] = first_id + p;
    const auto site = sites.of(position_of(placed, p));
    no_room[p] = taken.contains(site);
    if (!no_room[p]) filled.insert(site);
  }
  remove_points(placed, no_room);
  auto& water = state.water;
  const double porosity = model.materials[static_cast<std::size_t>(change.material)].porosity;
  double level = 0;  // m, of the water that is there
  std::vector<std::uint8_t> displaced(water.size(), 0);
  for (std::size_t p = 0; p < water.size(); ++p) {
    const auto x = position_of(water, p);
    if (!filled.contains(sites.of(x))) continue;
    level = std::max(level, x[Space::up] + 0.5 * sites.axis[Space::up].width(sites.of(x)[Space::up]));
    const double kept = model.single_point ? 0 : porosity;
    changed.water.push_back({cell_at(lattice, x), -(1 - kept) * water.volume[p]});
    water.volume[p] *= kept;
    displaced[p] = model.single_point;
  }
  remove_points(water, displaced);

  if (level > 0) only.water_table = {{0, level}, {lattice.length(0), level}};
  set_stress_at_rest(only, state.setup, placed, true);
  start_law_state(state.setup, 0, placed);
  for (std::size_t p = 0; state.unsaturated && p < placed.size();
       ++p) {  // as moist as soil at this height at the start
    const double p_water = pressure_at_start(state.setup, placed.position[0][p], placed.position[Space::up][p]);
    const auto& pores = state.setup.pores[placed.material[p]];
    placed.water[p] = water_ratio(pores, p_water, model.water.bulk_modulus).value * placed.porosity[p] *
                      bulk_volume(state.setup, placed, p);
  }
  for (std::size_t p = 0; state.setup.single_point && p < placed.size(); ++p)
    changed.water.push_back({cell_at(lattice, position_of(placed, p)), placed.water[p]});
  auto& soil = state.soil;
  const std::size_t first = append_points(soil, placed.size());
  const auto copy = [&](auto& to, const auto& from) { std::copy(from.begin(), from.end(), to.begin() + first); };
  for (int a = 0; a < Space::axes; ++a) {
    copy(soil.position[a], placed.position[a]);
    copy(soil.reference[a], placed.reference[a]);
  }
  for (std::size_t s = 0; s < soil.stress.size(); ++s) copy(soil.stress[s], placed.stress[s]);
  for (std::size_t s = 0; s < soil.state.size(); ++s) copy(soil.state[s], placed.state[s]);
  copy(soil.mass, placed.mass);
  copy(soil.porosity, placed.porosity);
  copy(soil.id, placed.id);
  copy(soil.material, placed.material);
  copy(soil.saturated, placed.saturated);
  copy(soil.water, placed.water);
  for (const double m : placed.mass) changed.solid_in += m;
}

template <class Space>
void convert(const GroundChange& change, Stepper<Space>& state, ChangedMass& changed) {
  auto& soil = state.soil;
  const auto material = static_cast<std::uint8_t>(change.material);
  for (std::size_t p = 0; p < soil.size(); ++p) {
    if (soil.material[p] == material || !in_region<Space>(change.region, position_of(soil, p))) continue;
    if (state.unsaturated) {  // under the suction that it is under, the pores hold what the new material's do
      const auto& unsaturated = *state.unsaturated;
      const double more = (unsaturated.filled_by(state.setup, soil, p, material, state.grid) -
                           unsaturated.filled_by(state.setup, soil, p, soil.material[p], state.grid)) *
                          soil.porosity[p] * bulk_volume(state.setup, soil, p);
      soil.water[p] += more;
      changed.water.push_back({cell_at(state.setup.lattice, position_of(soil, p)), more});
    }
    const double before = soil.mass[p];
    soil.mass[p] *=
        state.setup.materials[material].grain_density / state.setup.materials[soil.material[p]].grain_density;
    soil.material[p] = material;
    for (auto& s : soil.state) s[p] = 0;
    SoilPoints<Space> one;
    append_points(one, 1);
    for (std::size_t s = 0; s < soil.stress.size(); ++s) one.stress[s][0] = soil.stress[s][p];
    one.porosity[0] = soil.porosity[p];
    one.material[0] = material;
    start_law_state(state.setup, 0, one);
    for (std::size_t s = 1; s < soil.state.size(); ++s) soil.state[s][p] = one.state[s][0];
    (soil.mass[p] > before ? changed.solid_in : changed.solid_out) += std::abs(soil.mass[p] - before);
  }
}

}  // namespace

template <class Space>
void start_law_state(const Setup<Space>& setup, std::size_t first, SoilPoints<Space>& soil) {
  for (std::size_t p = first; p < soil.size(); ++p) {
    std::array<double, StressBatch<4>::max_state> state{};
    const double mean = -(soil.stress[0][p] + soil.stress[1][p] + soil.stress[2][p]) / 3;
    setup.materials[soil.material[p]].law->initial_state(mean, soil.porosity[p], std::span(state).subspan(1));
    for (std::size_t s = 1; s < state.size(); ++s) soil.state[s][p] = state[s];
  }
}

template <class Space>
std::uint64_t first_placed_id(const Model& model, const Lattice<Space>& lattice) {
  std::uint64_t sites = static_cast<std::uint64_t>(lattice.cell_count());
  for (int a = 0; a < Space::axes; ++a) sites *= static_cast<std::uint64_t>(model.points_per_axis);
  return sites;
}

template <class Space>
ChangedMass change_ground(const Model& model, std::size_t stage, Stepper<Space>& state) {
  ChangedMass changed;
  const std::uint64_t sites = first_placed_id(model, state.setup.lattice);
  for (std::size_t k = 0; k < model.changes.size(); ++k) {
    const GroundChange& change = model.changes[k];
    if (change.stage != static_cast<int>(stage)) continue;
    if (change.kind == ChangeKind::excavate) excavate(model, change, state, changed);
    if (change.kind == ChangeKind::place) place(model, change, sites * (1 + k), state, changed);
    if (change.kind == ChangeKind::convert) convert(change, state, changed);
    state.points_changed();
  }
  if (state.unsaturated) state.unsaturated->ground_changed(state.setup, state.soil);
  return changed;
}

template void start_law_state(const Setup<PlaneStrain>&, std::size_t, SoilPoints<PlaneStrain>&);
template void start_law_state(const Setup<Solid>&, std::size_t, SoilPoints<Solid>&);
template std::uint64_t first_placed_id(const Model&, const Lattice<PlaneStrain>&);
template std::uint64_t first_placed_id(const Model&, const Lattice<Solid>&);
template ChangedMass change_ground(const Model&, std::size_t, Stepper<PlaneStrain>&);
template ChangedMass change_ground(const Model&, std::size_t, Stepper<Solid>&);

}  // namespace polder
