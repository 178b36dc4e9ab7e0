#include "polder/points/resample.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "polder/math/random.hpp"
#include "polder/points/tiles.hpp"

namespace polder {

namespace {

constexpr double split_distance = 0.35;  // × edge of the point's bulk box, to either side

/// What a point of water is measured by where it is.
struct Surroundings {
  double porosity;  // of its cell; 1: free water
  double nominal;   // m³, bulk volume of a point at the start there
};

template <class Space>
Surroundings surroundings_of(const Lattice<Space>& lattice, const Array& cell_porosity, const ResampleRules& rules,
                             const WaterPoints<Space>& water, std::size_t p) {
  const auto cell = cell_of(lattice, position_of(water, p));
  return {cell_porosity[lattice.index(cell[0], cell[1], cell[2])],
          lattice.graded ? rules.nominal * lattice.cell_volume(cell) / lattice.cell_volume() : rules.nominal};
}

/// Edges of a point's box in free water, in cells.
template <class Space>
std::array<double, 3> edges_of(const Lattice<Space>& lattice, const WaterPoints<Space>& water, std::size_t p) {
  const double share = water.volume[p] / lattice.cell_volume(cell_of(lattice, position_of(water, p)));
  const double edge = Space::axes == 2 ? std::sqrt(share) : std::cbrt(share);
  std::array<double, 3> edges{0, 0, 0};
  for (int a = 0; a < Space::axes; ++a) edges[a] = edge * (1 + water.elongation[a][p]);
  return edges;
}

struct Split {
  std::size_t point;
  int axis;  // along which its box is too long; −1: its bulk volume is too large
};

/// Those of points [begin, end) that are to be split.
template <class Space>
std::vector<Split> large_points(const Lattice<Space>& lattice, const Array& cell_porosity, const ResampleRules& rules,
                                const WaterPoints<Space>& water, std::size_t begin, std::size_t end) {
  std::vector<Split> large;
  const auto overlong_axis = [&](std::size_t p) {
    const auto edges = edges_of(lattice, water, p);
    const auto longest = std::max_element(edges.begin(), edges.begin() + Space::axes);
    return *longest > rules.split_edge ? static_cast<int>(longest - edges.begin()) : -1;
  };
  for (std::size_t p = begin; p < end; ++p) {
    const auto [porosity, nominal] = surroundings_of(lattice, cell_porosity, rules, water, p);
    const bool stretches = rules.split_edge > 0 && porosity >= 1 && water.volume[p] >= rules.least * nominal;
    const int axis = stretches ? overlong_axis(p) : -1;
    if (axis >= 0 || water.volume[p] / porosity >= rules.split_at * nominal) large.push_back({p, axis});
  }
  return large;
}

template <class Space>
std::array<double, 3> direction_of(const WaterPoints<Space>& water, std::size_t p, std::uint64_t seed,
                                   std::uint64_t step) {
  std::array<double, 3> e{0, 0, 0};
  double square = 0;
  for (int a = 0; a < Space::axes; ++a) {
    e[a] = water.velocity[a][p];
    square += e[a] * e[a];
  }
  if (square < 1e-18) {
    const double angle = 2 * std::numbers::pi * uniform(seed, water.id[p], step);
    const double up = Space::axes == 3 ? 2 * uniform(seed, water.id[p], step + (1ULL << 62)) - 1 : 0;
    const double level = std::sqrt(1 - up * up);
    return {level * std::cos(angle), level * std::sin(angle), up};
  }
  for (double& component : e) component /= std::sqrt(square);
  return e;
}

/// Where a half of a point at `from` comes to lie: `shift` away, or less far where that would be in a body, past a
/// thin wall or out of the model.
template <class Space>
std::array<double, 3> place_of_half(const Lattice<Space>& lattice, const ThinWalls<Space>& walls,
                                    const Bodies<Space>& bodies, const std::array<double, 3>& from,
                                    const std::array<double, 3>& shift) {
  for (const double share : {1.0, 0.5, 0.25, 0.125}) {
    std::array<double, 3> to{0, 0, 0};
    for (int a = 0; a < Space::axes; ++a) {
      const GridAxis& axis = lattice.axis[a];
      to[a] = std::clamp(from[a] + share * shift[a], wall_gap * axis.width(0),
                         axis.length() - wall_gap * axis.width(axis.cells() - 1));
    }
    if (bodies.any() && bodies.contact({to[0], to[Space::up]}).distance <= 0) continue;
    if (walls.any()) stop_at_walls(lattice, walls, from, to);
    return to;
  }
  return from;
}

}  // namespace

template <class Space>
std::size_t split_water(const Lattice<Space>& lattice, const Array& cell_porosity, const ResampleRules& rules,
                        std::uint64_t step, std::uint64_t& next_id, WaterPoints<Space>& water, Team& team,
                        const ThinWalls<Space>& walls, const Bodies<Space>& bodies) {
  constexpr std::size_t block = 2048;  // of points, looked through at once
  std::vector<std::vector<Split>> by_block((water.size() + block - 1) / block);
  team.each(static_cast<std::ptrdiff_t>(by_block.size()), [&](std::ptrdiff_t i) {
    const std::size_t begin = static_cast<std::size_t>(i) * block;
    by_block[static_cast<std::size_t>(i)] =
        large_points(lattice, cell_porosity, rules, water, begin, std::min(begin + block, water.size()));
  });
  std::vector<Split> large;
  for (const auto& part : by_block) large.insert(large.end(), part.begin(), part.end());
  std::size_t half = append_points(water, large.size());
  for (const auto& [p, axis] : large) {
    std::array<double, 3> shift{0, 0, 0};  // m, of the halves
    if (axis >= 0) {
      shift[axis] = 0.25 * edges_of(lattice, water, p)[axis] *
                    lattice.axis[axis].width(cell_of(lattice, position_of(water, p))[axis]);
      const double wider = Space::axes == 2 ? std::numbers::sqrt2 : std::cbrt(2.0);
      for (int a = 0; a < Space::axes; ++a)
        water.elongation[a][p] = (1 + water.elongation[a][p]) * (a == axis ? 0.5 : 1) * wider - 1;
    } else {
      const double bulk = water.volume[p] / surroundings_of(lattice, cell_porosity, rules, water, p).porosity;
      const double edge = Space::axes == 2 ? std::sqrt(bulk) : std::cbrt(bulk);
      shift = direction_of(water, p, rules.seed, step);
      for (double& component : shift) component *= split_distance * edge;
    }
    water.volume[p] *= 0.5;
    water.each_array([half, p = p](const char*, int, auto& array) { array[half] = array[p]; });
    water.id[half] = next_id++;
    const auto from = position_of(water, p);
    const std::array<double, 3> back{-shift[0], -shift[1], -shift[2]};
    const auto one = place_of_half(lattice, walls, bodies, from, shift);
    const auto other = place_of_half(lattice, walls, bodies, from, back);
    for (int a = 0; a < Space::axes; ++a) water.position[a][p] = one[a], water.position[a][half] = other[a];
    ++half;
  }
  return large.size();
}

namespace {

/// Gives `keep` the shape of a box with the second moments of both boxes together.
template <class Space>
void merge_boxes(const Lattice<Space>& lattice, std::size_t keep, std::size_t lose, double share,
                 WaterPoints<Space>& water) {
  const auto one = edges_of(lattice, water, keep), other = edges_of(lattice, water, lose);
  const auto cell = cell_of(lattice, position_of(water, keep));
  std::array<double, 3> edge{1, 1, 1};
  double product = 1;
  for (int a = 0; a < Space::axes; ++a) {
    const double apart = (water.position[a][keep] - water.position[a][lose]) / lattice.axis[a].width(cell[a]);
    edge[a] = std::sqrt((1 - share) * one[a] * one[a] + share * other[a] * other[a] +
                        12 * share * (1 - share) * apart * apart);
    product *= edge[a];
  }
  const double mean = Space::axes == 2 ? std::sqrt(product) : std::cbrt(product);
  for (int a = 0; a < Space::axes; ++a) water.elongation[a][keep] = edge[a] / mean - 1;
}

}  // namespace

template <class Space>
std::size_t merge_water(const Lattice<Space>& lattice, const Array& cell_porosity, const ResampleRules& rules,
                        WaterPoints<Space>& water) {
  const std::size_t n = water.size();
  const std::size_t crowd = static_cast<std::size_t>(rules.crowded * rules.points_per_cell);
  std::vector<std::uint8_t> gone;
  std::size_t merged = 0;
  for (std::size_t first = 0, last = 0; first < n; first = last) {
    while (last < n && water.home[last] == water.home[first]) ++last;
    if (last - first <= crowd) continue;
    if (gone.empty()) gone.assign(n, 0);
    const auto is_small = [&](std::size_t p) {
      const auto [porosity, nominal] = surroundings_of(lattice, cell_porosity, rules, water, p);
      return water.volume[p] / porosity < rules.merge_below * nominal;
    };
    std::vector<std::size_t> small;
    for (std::size_t p = first; p < last; ++p)
      if (is_small(p)) small.push_back(p);
    for (std::size_t left = last - first; left > crowd && small.size() > 1; --left) {
      std::size_t a = 0, b = 1;
      double closest = 1e300;
      for (std::size_t i = 0; i < small.size(); ++i)
        for (std::size_t j = i + 1; j < small.size(); ++j) {
          double square = 0;
          for (int axis = 0; axis < Space::axes; ++axis) {
            const double d = water.position[axis][small[i]] - water.position[axis][small[j]];
            square += d * d;
          }
          if (square < closest) closest = square, a = i, b = j;
        }
      const std::size_t keep = small[a], lose = small[b];
      const double total = water.volume[keep] + water.volume[lose], share = water.volume[lose] / total;
      if (rules.split_edge > 0 && surroundings_of(lattice, cell_porosity, rules, water, keep).porosity >= 1)
        merge_boxes(lattice, keep, lose, share, water);
      const auto blend = [&](auto& arrays) {
        for (auto& array : arrays) array[keep] += share * (array[lose] - array[keep]);
      };
      blend(water.position);
      blend(water.velocity);
      blend(water.affine);
      water.volume[keep] = total;
      gone[lose] = 1;
      ++merged;
      small.erase(small.begin() + static_cast<std::ptrdiff_t>(b));
      if (!is_small(keep)) small.erase(small.begin() + static_cast<std::ptrdiff_t>(a));
    }
  }
  if (merged > 0) remove_points(water, gone);
  return merged;
}

template std::size_t split_water(const Lattice<PlaneStrain>&, const Array&, const ResampleRules&, std::uint64_t,
                                 std::uint64_t&, WaterPoints<PlaneStrain>&, Team&, const ThinWalls<PlaneStrain>&,
                                 const Bodies<PlaneStrain>&);
template std::size_t split_water(const Lattice<Solid>&, const Array&, const ResampleRules&, std::uint64_t,
                                 std::uint64_t&, WaterPoints<Solid>&, Team&, const ThinWalls<Solid>&,
                                 const Bodies<Solid>&);
template std::size_t merge_water(const Lattice<PlaneStrain>&, const Array&, const ResampleRules&,
                                 WaterPoints<PlaneStrain>&);
template std::size_t merge_water(const Lattice<Solid>&, const Array&, const ResampleRules&, WaterPoints<Solid>&);

}  // namespace polder
