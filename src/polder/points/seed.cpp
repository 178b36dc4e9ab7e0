#include "polder/points/seed.hpp"

#include <algorithm>
#include <cmath>

#include "polder/case/geometry.hpp"
#include "polder/case/grid_sites.hpp"
#include "polder/case/wall_motion.hpp"
#include "polder/grid/bodies.hpp"
#include "polder/math/random.hpp"

namespace polder {

namespace {

constexpr double least_cell = 0.1;   // as in grid/bodies.cpp: such cells count as covered, where slivers are not merged
constexpr double least_site = 1e-4;  // open share of a site below which it gets no point

struct Site {
  std::uint64_t number;
  std::array<double, 3> x, width;  // m
  int soil;                        // body, or −1
  bool free, below;                // is free water; is below the water table
  double open;                     // share that no rigid body covers
};

/// body(site) over all sites in which there is something. A site that a rigid body covers in part has its point in the
/// middle of the rest.
template <class Space, class Body>
void over_sites(const Model& model, const std::array<GridAxis, 3>& grid, Body&& body) {
  constexpr int axes = Space::axes;
  std::array<SiteAxis, 3> sites;
  for (int a = 0; a < axes; ++a) sites[a] = SiteAxis(grid[a], model.points_per_axis);
  std::vector<BodySection> bodies;
  for (const WallInput& wall : model.walls)
    if (!wall.polygon.empty()) bodies.push_back({wall.polygon});
  const bool merges = model.unsaturated || any_body_moves(model);
  const auto covered = [&](const std::array<int, 3>& site) {  // the cell that the site is in
    Point2 low{}, high{};
    for (std::size_t part = 0; part < 2; ++part) {
      const std::size_t axis = part == 0 ? 0 : Space::up;
      const int cell = sites[axis].cell(site[axis]);
      low[part] = grid[axis].edge(cell);
      high[part] = low[part] + grid[axis].width(cell);
    }
    return !merges && open_part(bodies, low, high).first < least_cell;
  };
  std::uint64_t number = 0;
  for (int k = 0; k < sites[2].count(); ++k)
    for (int j = 0; j < sites[1].count(); ++j)
      for (int i = 0; i < sites[0].count(); ++i, ++number) {
        const std::array<int, 3> site{i, j, k};
        std::array<double, 3> x{0, 0, 0}, d{0, 0, 0};
        for (int a = 0; a < axes; ++a) x[a] = sites[a].middle(site[a]), d[a] = sites[a].width(site[a]);
        double open = 1;
        if (!bodies.empty()) {
          const Point2 half{0.5 * d[0], 0.5 * d[Space::up]};
          const auto [share, centre] =
              open_part(bodies, {x[0] - half[0], x[Space::up] - half[1]}, {x[0] + half[0], x[Space::up] + half[1]});
          if (share < least_site || covered(site)) continue;
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
        if (soil >= 0 || free) body(Site{number, x, d, soil, free, below, open});
      }
}

}  // namespace

template <class Space>
SeededPoints<Space> seed_points(const Model& model, const Lattice<Space>& lattice) {
  constexpr int axes = Space::axes;
  double volume = lattice.cell_volume();  // of a site, where not graded
  for (int a = 0; a < axes; ++a) volume /= model.points_per_axis;

  SeededPoints<Space> points;
  const auto place = [&](auto& set, std::size_t p, const Site& site, int phase) {
    set.id[p] = p;
    for (int a = 0; a < axes; ++a) {
      const double shift =
          model.numerics.jitter * site.width[a] * (2 * uniform(model.numerics.seed, site.number, 3 * phase + a) - 1);
      set.position[a][p] =
          std::clamp(site.x[a] + shift, 1e-6 * lattice.spacing[a], lattice.length(a) - 1e-6 * lattice.spacing[a]);
    }
  };
  over_sites<Space>(model, lattice.axis, [&](const Site& site) {
    if (lattice.graded) {
      volume = 1;
      for (int a = 0; a < axes; ++a) volume *= site.width[a];
    }
    double porosity = 1;
    if (site.soil >= 0) {
      const int material = model.soils[site.soil].material;
      const MaterialInput& input = model.materials[material];
      porosity = input.porosity;
      const std::size_t p = append_points(points.soil, 1);
      place(points.soil, p, site, 0);
      points.soil.mass[p] = (1 - porosity) * input.grain_density * volume * site.open;
      points.soil.porosity[p] = porosity;
      points.soil.material[p] = static_cast<std::uint8_t>(material);
      points.soil.saturated[p] = model.single_point && site.below;
      if (points.soil.saturated[p]) points.soil.water[p] = porosity * volume * site.open;
    }
    if (site.free || (site.soil >= 0 && site.below && !model.single_point)) {
      const std::size_t p = append_points(points.water, 1);
      place(points.water, p, site, 1);
      points.water.volume[p] = porosity * volume * site.open;
    }
  });
  for (int a = 0; a < axes; ++a) points.soil.reference[a] = points.soil.position[a];
  return points;
}

PointCount count_points(const Model& model) {
  PointCount count;
  const auto add = [&](const Site& site) {
    count.soil += site.soil >= 0;
    count.water += site.free || (site.soil >= 0 && site.below && !model.single_point);
  };
  const std::array<GridAxis, 3> grid{grid_axis(model, 0), grid_axis(model, 1), grid_axis(model, 2)};
  if (model.space == SpaceKind::solid)
    over_sites<Solid>(model, grid, add);
  else
    over_sites<PlaneStrain>(model, grid, add);
  return count;
}

template SeededPoints<PlaneStrain> seed_points(const Model&, const Lattice<PlaneStrain>&);
template SeededPoints<Solid> seed_points(const Model&, const Lattice<Solid>&);

}  // namespace polder
