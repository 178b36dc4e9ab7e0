#include "polder/step/soil_exchange.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "polder/math/random.hpp"
#include "polder/points/tiles.hpp"
#include "polder/step/cell_beside.hpp"
#include "polder/step/face_loop.hpp"
#include "polder/step/soil_volume.hpp"

namespace polder {

namespace {

constexpr double parcel = 0.125;      // × a nominal point: what changes hands at once
constexpr double least = 1e-9;        // × a nominal point: what is left of one that is taken whole
constexpr double mostly_soil = 0.75;  // of a cell's pores, carried by soil

/// The soil that carries water, as cells: which of them have neighbours without any, and what flows between them.
template <class Space>
class Saturated {
 public:
  Saturated(const Setup<Space>& setup, const GridFields<Space>& grid) : setup_(setup), grid_(grid) {
    Team alone(1);
    over_cell_rows(setup.lattice, grid.rows, alone, [&](std::ptrdiff_t first, int count, const auto&) {
      for (std::ptrdiff_t cell = first; cell < first + count; ++cell)
        if (carries_water(setup, grid, cell)) cells.push_back(cell);
    });
  }

  /// The cell beside this one on an axis (`way` −1 or 1), or −1 where nothing passes.
  std::ptrdiff_t beside(std::ptrdiff_t cell, int axis, int way) const {
    const auto& lattice = setup_.lattice;
    if (setup_.shut(axis, way > 0 ? cell + lattice.stride[axis] : cell)) return -1;
    return cell_beside(lattice, setup_.water_box, cell, axis, way);
  }

  /// Share of the water in a cell's pores that soil carries.
  double share(std::ptrdiff_t cell) const {
    const double pores = grid_.cell_porosity[cell] * setup_.lattice.cell_volume(cell) * setup_.bodies.open_cell(cell);
    return pores > 0 ? std::min(1.0, grid_.carried_volume[cell] / pores) : 0;
  }

  /// m³/s through the soil into a cell over this face. Beside it, where the surface passes, the two cells' soil meets
  /// on a part of the face only; over it soil stands on soil.
  double inflow(std::ptrdiff_t cell, int axis, int way) const {
    const std::ptrdiff_t other = beside(cell, axis, way);
    if (other < 0 || !carries_water(setup_, grid_, other)) return 0;
    const std::ptrdiff_t face = way > 0 ? cell + setup_.lattice.stride[axis] : cell;
    const double covered = axis == Space::up ? share(way > 0 ? cell : other) : std::min(share(cell), share(other));
    return -way * covered * grid_.discharge[axis][face] * setup_.lattice.face_area(axis, face) *
           setup_.bodies.open_face(axis, face);
  }

  bool inside(std::ptrdiff_t cell) const {
    for (int a = 0; a < Space::axes; ++a)
      for (const int way : {-1, 1}) {
        const std::ptrdiff_t other = beside(cell, a, way);
        if (other >= 0 && !carries_water(setup_, grid_, other)) return false;
      }
    return true;
  }

  std::vector<std::ptrdiff_t> cells;

 private:
  const Setup<Space>& setup_;
  const GridFields<Space>& grid_;
};

/// Books the change of what each point carries in its cell's account.
template <class Space>
void book_changes(const Setup<Space>& setup, GridFields<Space>& grid, SoilPoints<Space>& soil) {
  for (std::size_t p = 0; p < soil.size(); ++p) {
    if (!soil.saturated[p]) continue;
    const double now = soil.porosity[p] * bulk_volume(setup, soil, p);
    grid.spare[cell_at(setup.lattice, position_of(soil, p))] -= now - soil.water[p];
    soil.water[p] = now;
  }
}

/// Points of free water in the midst of saturated soil become part of what it gives.
template <class Space>
bool take_in(const Setup<Space>& setup, const Saturated<Space>& saturated, const std::vector<std::uint8_t>& inside,
             GridFields<Space>& grid, WaterPoints<Space>& water) {
  std::vector<std::uint8_t> leaves(water.size(), 0);
  bool any = false;
  for (std::size_t p = 0; p < water.size(); ++p) {
    const std::ptrdiff_t cell = cell_at(setup.lattice, position_of(water, p));
    if (!inside[cell] || saturated.share(cell) < mostly_soil) continue;
    grid.spare[cell] += water.volume[p];
    leaves[p] = 1;
    any = true;
  }
  if (any) remove_points(water, leaves);
  return any;
}

/// Moves what the accounts inside hold to the cells at the surface: to each what seeps into it, the rest in proportion.
template <class Space>
void move_to_surface(double dt, const Saturated<Space>& saturated, const std::vector<std::uint8_t>& inside,
                     GridFields<Space>& grid) {
  std::vector<std::pair<std::ptrdiff_t, double>> surface;  // and m³ that flow into it
  double rest = 0, most = 0;
  for (const std::ptrdiff_t cell : saturated.cells) {
    if (inside[cell]) {
      rest += grid.spare[cell];
      grid.spare[cell] = 0;
      continue;
    }
    double inflow = 0;
    for (int a = 0; a < Space::axes; ++a)
      for (const int way : {-1, 1}) inflow += dt * saturated.inflow(cell, a, way);
    surface.push_back({cell, inflow});
    most = std::max(most, std::abs(inflow));
  }
  if (surface.empty()) {
    if (!saturated.cells.empty()) grid.spare[saturated.cells.front()] = rest;
    return;
  }
  double weights = 0;
  const auto weight = [&](double inflow) { return most > 0 ? std::abs(inflow) + 1e-3 * most : 1; };
  for (const auto& [cell, inflow] : surface) {
    rest -= inflow;
    weights += weight(inflow);
  }
  for (const auto& [cell, inflow] : surface) grid.spare[cell] += inflow + rest * weight(inflow) / weights;
}

/// Settles the accounts that have grown to a parcel.
template <class Space>
class Settlement {
 public:
  Settlement(const Setup<Space>& setup, const Saturated<Space>& saturated, GridFields<Space>& grid,
             SoilPoints<Space>& soil, WaterPoints<Space>& water)
      : setup_(setup), saturated_(saturated), grid_(grid), soil_(soil), water_(water) {}

  bool run(std::uint64_t& next_id) {
    Team alone(1);
    std::vector<std::ptrdiff_t> due;
    over_cell_rows(setup_.lattice, grid_.rows, alone, [&](std::ptrdiff_t first, int count, const auto&) {
      for (std::ptrdiff_t cell = first; cell < first + count; ++cell)
        if (std::abs(grid_.spare[cell]) >= parcel * setup_.nominal_point_volume(cell)) due.push_back(cell);
    });
    if (due.empty()) return false;
    find_points(due);
    leaves_.assign(water_.size(), 0);
    const std::size_t before = water_.size();
    for (const std::ptrdiff_t cell : due) grid_.spare[cell] > 0 ? give(cell, next_id) : take(cell);
    const bool taken = std::find(leaves_.begin(), leaves_.end(), 1) != leaves_.end();
    const bool given = water_.size() > before;
    leaves_.resize(water_.size(), 0);
    if (taken) remove_points(water_, leaves_);
    return taken || given;
  }

 private:
  struct Contents {
    std::vector<std::size_t> soil, water;
  };

  /// A cell and those that water can pass to from it, the one above first.
  std::vector<std::ptrdiff_t> with_around(std::ptrdiff_t cell) const {
    std::vector<std::ptrdiff_t> cells{cell};
    const auto add = [&](int axis, int way) {
      if (const std::ptrdiff_t other = saturated_.beside(cell, axis, way); other >= 0) cells.push_back(other);
    };
    add(Space::up, 1);
    for (int a = 0; a < Space::up; ++a) add(a, -1), add(a, 1);
    add(Space::up, -1);
    return cells;
  }

  void find_points(const std::vector<std::ptrdiff_t>& due) {
    for (const std::ptrdiff_t cell : due)
      for (const std::ptrdiff_t at : with_around(cell)) contents_.try_emplace(at);
    const auto list = [&](const auto& points, std::vector<std::size_t> Contents::*where) {
      for (std::size_t p = 0; p < points.size(); ++p) {
        const auto found = contents_.find(cell_at(setup_.lattice, position_of(points, p)));
        if (found != contents_.end()) (found->second.*where).push_back(p);
      }
    };
    list(soil_, &Contents::soil);
    list(water_, &Contents::water);
  }

  /// Dry soil first, from below; then into a point of free water.
  void give(std::ptrdiff_t cell, std::uint64_t& next_id) {
    double& spare = grid_.spare[cell];
    std::vector<std::size_t> dry;
    for (const std::ptrdiff_t at : with_around(cell)) {
      const std::vector<std::size_t> points = soil_points(at, 0);
      dry.insert(dry.end(), points.begin(), points.end());
    }
    if (dry.empty()) return emit(cell, next_id);
    std::sort(dry.begin(), dry.end(), [&](std::size_t a, std::size_t b) { return is_lower(a, b); });
    for (const std::size_t p : dry) {
      const double pores = soil_.porosity[p] * bulk_volume(setup_, soil_, p);
      if (pores > spare) return;
      soil_.saturated[p] = 1;
      soil_.water[p] = pores;
      spare -= pores;
    }
  }

  void emit(std::ptrdiff_t cell, std::uint64_t& next_id) {
    const auto& lattice = setup_.lattice;
    std::ptrdiff_t target = cell;
    int along = -1, way = 0;
    if (saturated_.share(cell) > mostly_soil) {
      double most = 0;
      for (int a = 0; a < Space::axes; ++a)
        for (const int w : {-1, 1}) {
          const std::ptrdiff_t other = saturated_.beside(cell, a, w);
          if (other < 0 || carries_water(setup_, grid_, other)) continue;
          const double out = w * grid_.discharge[a][w > 0 ? cell + lattice.stride[a] : cell];
          if (along >= 0 && out <= most) continue;
          most = out, along = a, way = w, target = other;
        }
    }
    const std::size_t p = append_points(water_, 1);
    water_.id[p] = next_id++;
    water_.volume[p] = std::min(grid_.spare[cell], setup_.nominal_point_volume(target));
    grid_.spare[cell] -= water_.volume[p];
    const double soil = along < 0 ? soil_height(cell) : 0;
    for (int a = 0; a < Space::axes; ++a) {
      double share = uniform(setup_.numerics.seed, water_.id[p], static_cast<std::uint64_t>(a));
      if (a == along) share = way > 0 ? 0.125 : 0.875;
      if (a == Space::up && along < 0) share = std::min(0.95, soil + 0.25 * (1 - soil));
      water_.position[a][p] = lattice.axis[a].at_place(lattice.place(target, a) + share);
      const Array& v = grid_.water_velocity[a];
      const std::ptrdiff_t next = cell + lattice.stride[a];
      const bool out = a == (along < 0 ? Space::up : along);  // that of the face which it comes from
      water_.velocity[a][p] = out ? v[way > 0 ? next : cell] : 0.5 * (v[cell] + v[next]);
    }
  }

  /// From free water here and beside; where there is none, from the soil's uppermost points.
  void take(std::ptrdiff_t cell) {
    double& spare = grid_.spare[cell];
    for (const std::ptrdiff_t at : with_around(cell)) {
      std::vector<std::size_t>& points = contents_[at].water;
      std::sort(points.begin(), points.end(), [&](std::size_t a, std::size_t b) {
        return std::pair{water_.volume[a], water_.id[a]} < std::pair{water_.volume[b], water_.id[b]};
      });
      const double crumb = least * setup_.nominal_point_volume(cell);
      for (const std::size_t p : points) {
        if (spare >= 0) return;
        if (leaves_[p]) continue;
        const double taken = -spare < water_.volume[p] - crumb ? -spare : water_.volume[p];
        water_.volume[p] -= taken;
        spare += taken;
        leaves_[p] = water_.volume[p] <= 0;
      }
    }
    for (const std::ptrdiff_t at : with_around(cell)) {
      std::vector<std::size_t> points = soil_points(at, 1);
      std::sort(points.begin(), points.end(), [&](std::size_t a, std::size_t b) { return is_lower(b, a); });
      for (const std::size_t p : points) {
        if (spare > -soil_.water[p]) return;
        spare += soil_.water[p];
        soil_.water[p] = 0;
        soil_.saturated[p] = 0;
      }
      if (!points.empty()) return;
    }
  }

  std::vector<std::size_t> soil_points(std::ptrdiff_t cell, std::uint8_t saturated) const {
    std::vector<std::size_t> points;
    for (const std::size_t p : contents_.at(cell).soil)
      if (soil_.saturated[p] == saturated) points.push_back(p);
    return points;
  }
  bool is_lower(std::size_t a, std::size_t b) const {
    const Array& y = soil_.position[Space::up];
    return std::pair{y[a], soil_.id[a]} < std::pair{y[b], soil_.id[b]};
  }
  /// Share of a cell's height that saturated soil takes.
  double soil_height(std::ptrdiff_t cell) const {
    return std::min(1.0, (grid_.carried_volume[cell] + grid_.saturated_solid[cell]) /
                             (setup_.lattice.cell_volume(cell) * std::max(0.05, setup_.bodies.open_cell(cell))));
  }

  const Setup<Space>& setup_;
  const Saturated<Space>& saturated_;
  GridFields<Space>& grid_;
  SoilPoints<Space>& soil_;
  WaterPoints<Space>& water_;
  std::map<std::ptrdiff_t, Contents> contents_;
  std::vector<std::uint8_t> leaves_;
};

}  // namespace

template <class Space>
bool exchange_with_soil(const Setup<Space>& setup, double dt, GridFields<Space>& grid, std::uint64_t& next_id,
                        SoilPoints<Space>& soil, WaterPoints<Space>& water) {
  book_changes(setup, grid, soil);
  const Saturated<Space> saturated(setup, grid);
  std::vector<std::uint8_t> inside(static_cast<std::size_t>(setup.lattice.size), 0);
  for (const std::ptrdiff_t cell : saturated.cells) inside[cell] = saturated.inside(cell);
  const bool taken = take_in(setup, saturated, inside, grid, water);
  move_to_surface(dt, saturated, inside, grid);
  return Settlement<Space>(setup, saturated, grid, soil, water).run(next_id) || taken;
}

template bool exchange_with_soil(const Setup<PlaneStrain>&, double, GridFields<PlaneStrain>&, std::uint64_t&,
                                 SoilPoints<PlaneStrain>&, WaterPoints<PlaneStrain>&);
template bool exchange_with_soil(const Setup<Solid>&, double, GridFields<Solid>&, std::uint64_t&, SoilPoints<Solid>&,
                                 WaterPoints<Solid>&);

}  // namespace polder
