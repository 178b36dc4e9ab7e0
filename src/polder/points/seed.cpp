#include "polder/points/seed.hpp"

#include <algorithm>
#include <cmath>

#include "polder/case/geometry.hpp"
#include "polder/grid/bodies.hpp"
#include "polder/math/random.hpp"

namespace polder {

namespace {

constexpr double least_cell = 0.1;   // as in grid/bodies.cpp: such cells count as covered
constexpr double least_site = 1e-4;  // open share of a site below which it gets no point

/// body(site number, position (x, y, height), soil body or −1, is free water, is below the water table, open share)
/// over the lattice of sites. A site that a rigid body covers in part has its point in the middle of the rest.
template <class Space, class Body>
void over_sites(const Model& model, const std::array<int, 3>& cells, const std::array<double, 3>& spacing,
                Body&& body) {
  constexpr int axes = Space::axes;
  std::array<int, 3> sites{1, 1, 1};
  std::array<double, 3> d{0, 0, 0};
  for (int a = 0; a < axes; ++a) {
    sites[a] = cells[a] * model.points_per_axis;
    d[a] = spacing[a] / model.points_per_axis;
  }
  std::vector<BodySection> bodies;
  for (const WallInput& wall : model.walls)
    if (!wall.polygon.empty()) bodies.push_back({wall.polygon});
  const auto covered = [&](const std::array<int, 3>& site) {  // the cell that the site is in
    Point2 low{}, high{};
    for (std::size_t part = 0; part < 2; ++part) {
      const std::size_t axis = part == 0 ? 0 : Space::up;
      const int cell = site[axis] / model.points_per_axis;
      low[part] = cell * spacing[axis];
      high[part] = low[part] + spacing[axis];
    }
    return open_part(bodies, low, high).first < least_cell;
  };
  std::uint64_t number = 0;
  for (int k = 0; k < sites[2]; ++k)
    for (int j = 0; j < sites[1]; ++j)
      for (int i = 0; i < sites[0]; ++i, ++number) {
        std::array<double, 3> x{(i + 0.5) * d[0], (j + 0.5) * d[1], axes == 3 ? (k + 0.5) * d[2] : 0};
        double open = 1;
        if (!bodies.empty()) {
          const Point2 half{0.5 * d[0], 0.5 * d[Space::up]};
          const auto [share, centre] =
              open_part(bodies, {x[0] - half[0], x[Space::up] - half[1]}, {x[0] + half[0], x[Space::up] + half[1]});
          if (share < least_site || covered(std::array{i, j, k})) continue;
          open = share;
          if (open < 1) x[0] = centre[0], x[Space::up] = centre[1];
        }
        const double height = x[Space::up], across = axes == 3 ? x[1] : 0;
        int soil = -1;
        for (std::size_t s = 0; s < model.soils.size(); ++s)
          if (contains(model.soils[s].region, x[0], across, height)) soil = static_cast<int>(s);
        const bool free = soil < 0 && std::any_of(model.free_water.begin(), model.free_water.end(), [&](const auto& w) {
                            return contains(w.region, x[0], across, height);
                          });
        const bool below = !model.water_table.empty() && height < height_at(model.water_table, x[0]);
        if (soil >= 0 || free) body(number, x, soil, free, below, open);
      }
}

}  // namespace

template <class Space>
SeededPoints<Space> seed_points(const Model& model, const Lattice<Space>& lattice) {
  constexpr int axes = Space::axes;
  double volume = lattice.cell_volume();
  for (int a = 0; a < axes; ++a) volume /= model.points_per_axis;

  SeededPoints<Space> points;
  const auto place = [&](auto& set, std::size_t p, std::uint64_t site, const std::array<double, 3>& x, int phase) {
    set.id[p] = p;
    for (int a = 0; a < axes; ++a) {
      const double d = lattice.spacing[a] / model.points_per_axis;
      const double shift = model.numerics.jitter * d * (2 * uniform(model.numerics.seed, site, 3 * phase + a) - 1);
      set.position[a][p] =
          std::clamp(x[a] + shift, 1e-6 * lattice.spacing[a], lattice.length(a) - 1e-6 * lattice.spacing[a]);
    }
  };
  over_sites<Space>(
      model, lattice.cells, lattice.spacing,
      [&](std::uint64_t site, const std::array<double, 3>& x, int soil, bool free, bool below, double open) {
        double porosity = 1;
        if (soil >= 0) {
          const int material = model.soils[soil].material;
          const MaterialInput& input = model.materials[material];
          porosity = input.porosity;
          const std::size_t p = append_points(points.soil, 1);
          place(points.soil, p, site, x, 0);
          points.soil.mass[p] = (1 - porosity) * input.grain_density * volume * open;
          points.soil.porosity[p] = porosity;
          points.soil.material[p] = static_cast<std::uint8_t>(material);
          points.soil.saturated[p] = model.single_point && below;
        }
        if (free || (soil >= 0 && below && !model.single_point)) {
          const std::size_t p = append_points(points.water, 1);
          place(points.water, p, site, x, 1);
          points.water.volume[p] = porosity * volume * open;
        }
      });
  for (int a = 0; a < axes; ++a) points.soil.reference[a] = points.soil.position[a];
  return points;
}

PointCount count_points(const Model& model) {
  PointCount count;
  std::array<int, 3> cells{1, 1, 1};
  const int axes = model.space == SpaceKind::solid ? 3 : 2;
  for (int a = 0; a < axes; ++a) cells[a] = static_cast<int>(std::lround(model.size[a] / model.cell[a]));
  const auto add = [&](std::uint64_t, const std::array<double, 3>&, int soil, bool free, bool below, double) {
    count.soil += soil >= 0;
    count.water += free || (soil >= 0 && below && !model.single_point);
  };
  if (axes == 3)
    over_sites<Solid>(model, cells, model.cell, add);
  else
    over_sites<PlaneStrain>(model, cells, model.cell, add);
  return count;
}

template SeededPoints<PlaneStrain> seed_points(const Model&, const Lattice<PlaneStrain>&);
template SeededPoints<Solid> seed_points(const Model&, const Lattice<Solid>&);

}  // namespace polder
