#include "polder/result/measures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "polder/case/geometry.hpp"

namespace polder {

namespace {

template <class Space>
std::size_t columns_of(const Lattice<Space>& lattice) {
  return static_cast<std::size_t>(lattice.cells[0]) * static_cast<std::size_t>(Space::axes == 3 ? lattice.cells[1] : 1);
}

/// Horizontal area of a column of cells, m² (its width in plane strain).
template <class Space>
double column_area(const Lattice<Space>& lattice, std::size_t column) {
  const auto along = static_cast<std::size_t>(lattice.cells[0]);
  return lattice.axis[0].width(static_cast<int>(column % along)) *
         (Space::axes == 3 ? lattice.axis[1].width(static_cast<int>(column / along)) : 1);
}

constexpr double grains_deep = 2.5;  // the thinnest layer of soil that is one

/// Where a profile along x, column by column, last falls below `level`, or below half a cell if that is more.
template <class Space>
double front_of(const Lattice<Space>& lattice, const std::vector<double>& height, double level) {
  level = std::max(level, 0.5 * lattice.spacing[Space::up]);
  const auto along = static_cast<std::size_t>(lattice.cells[0]);
  double front = 0;
  for (std::size_t row = 0; row < height.size(); row += along)
    for (std::size_t i = along; i-- > 0;) {
      const double here = height[row + i];
      if (here < level) continue;
      const double next = i + 1 < along ? height[row + i + 1] : here;
      const double share = next < level ? (here - level) / (here - next) : 0.5;
      front = std::max(front, lattice.axis[0].at_place(static_cast<double>(i) + 0.5 + share));
      break;
    }
  return front;
}

}  // namespace

template <class Space>
double water_surface(const Simulation<Space>& run, const Point3& place) {
  const auto& lattice = run.state().setup.lattice;
  const auto& grid = run.state().grid;
  const auto cell = cell_of(lattice, {place[0], place[1], place[2]});
  std::array<int, 3> at = cell;
  for (int level = lattice.cells[Space::up] - 1; level >= 0; --level) {
    at[Space::up] = level;
    const std::ptrdiff_t c = lattice.index(at[0], at[1], at[2]);
    if (!grid.wet[c]) continue;
    // the fill of the uppermost cells together: one alone scatters by the size of a point
    const std::ptrdiff_t s = lattice.stride[Space::up];
    const int deep = std::min(level, 4);
    double filled = grid.fill[c + s];
    for (int d = 0; d <= deep; ++d) filled += grid.fill[c - d * s];
    return lattice.axis[Space::up].at_place(level - deep + filled);
  }
  return 0;
}

template <class Space>
double soil_surface(const Simulation<Space>& run, const Point3& place) {
  const auto& lattice = run.state().setup.lattice;
  const auto& soil = run.state().soil;
  const auto cell = cell_of(lattice, {place[0], place[1], place[2]});
  double top = 0;
  for (std::size_t p = 0; p < soil.size(); ++p) {
    bool over = !soil.fluid[p];
    for (int a = 0; a < Space::axes; ++a)
      if (a != Space::up)
        over = over && std::abs(soil.position[a][p] - place[a]) < 0.5 * lattice.axis[a].width(cell[a]);
    if (!over) continue;
    double volume = soil.mass[p] / run.state().setup.materials[soil.material[p]].grain_density / (1 - soil.porosity[p]);
    for (int a = 0; a < Space::axes; ++a)
      volume /= a == Space::up ? 1 : lattice.axis[a].width(cell[a]) / run.model().points_per_axis;
    top = std::max(top, soil.position[Space::up][p] + 0.5 * volume);
  }
  return top;
}

template <class Space>
std::vector<double> soil_columns(const Simulation<Space>& run, const Region& region, bool at_start) {
  const auto& lattice = run.state().setup.lattice;
  const auto& soil = run.state().soil;
  std::vector<double> height(columns_of(lattice), 0.0);
  for (std::size_t p = 0; p < soil.size(); ++p) {
    const auto x = at_start ? reference_of(soil, p) : position_of(soil, p);
    if ((!at_start && soil.fluid[p]) || !inside<Space>(region, x)) continue;
    const auto cell = cell_of(lattice, x);
    const SoilMaterial& material = run.state().setup.materials[soil.material[p]];
    const std::size_t column = cell[0] + (Space::axes == 3 ? static_cast<std::size_t>(cell[1]) * lattice.cells[0] : 0);
    height[column] +=
        soil.mass[p] / material.grain_density / (1 - material.initial_porosity) / column_area(lattice, column);
  }
  return height;
}

template <class Space>
double eroded_area(const Simulation<Space>& run, const Region& region, const std::vector<double>& before) {
  const std::vector<double> now = soil_columns(run, region, false);
  double lost = 0;
  for (std::size_t i = 0; i < now.size(); ++i)
    lost += std::max(0.0, before[i] - now[i]) * column_area(run.state().setup.lattice, i);
  return lost;
}

template <class Space>
double water_front(const Simulation<Space>& run) {
  const auto& lattice = run.state().setup.lattice;
  const auto& grid = run.state().grid;
  std::vector<double> depth(columns_of(lattice), 0.0);
  for (int level = 0; level < lattice.cells[Space::up]; ++level)
    for (std::size_t column = 0; column < depth.size(); ++column) {
      const int i = static_cast<int>(column) % lattice.cells[0], j = static_cast<int>(column) / lattice.cells[0];
      const std::ptrdiff_t cell = Space::axes == 3 ? lattice.index(i, j, level) : lattice.index(i, level);
      depth[column] += grid.fill[cell] * lattice.axis[Space::up].width(level);
    }
  return front_of(lattice, depth, 0);
}

template <class Space>
double soil_front(const Simulation<Space>& run) {
  double grain = 0;
  for (const MaterialInput& material : run.model().materials) grain = std::max(grain, material.grain_diameter);
  return front_of(run.state().setup.lattice, soil_columns(run, {}, false), grains_deep * grain);
}

template <class Space>
double largest_uplift(const Simulation<Space>& run, const Region& region) {
  const auto& soil = run.state().soil;
  double most = 0;
  for (std::size_t p = 0; p < soil.size(); ++p)
    if (inside<Space>(region, reference_of(soil, p)))
      most = std::max(most, soil.position[Space::up][p] - soil.reference[Space::up][p]);
  return most;
}

template <class Space>
double excess_pressure(const Simulation<Space>& run, const Point3& place) {
  const auto& lattice = run.state().setup.lattice;
  const auto& grid = run.state().grid;
  std::array<int, 3> low{0, 0, 0};
  std::array<double, 3> share{0, 0, 0};
  for (int a = 0; a < Space::axes; ++a) {
    const double at =
        std::clamp(lattice.axis[a].place(place[a]) - 0.5, 0.0, static_cast<double>(lattice.cells[a] - 1) - 1e-9);
    low[a] = static_cast<int>(at);
    share[a] = at - low[a];
    if (lattice.graded)
      share[a] = std::clamp((place[a] - lattice.axis[a].centre(low[a])) / lattice.axis[a].gap(low[a] + 1), 0.0, 1.0);
  }
  const double weight = -run.state().setup.water.density * run.state().setup.pull(Space::up);
  const auto at_rest = [&](double x, double height) {
    const auto& table = run.model().water_table;
    return table.empty() ? 0 : weight * std::max(0.0, height_at(table, x) - height);
  };
  double sum = 0, total = 0;
  for (int corner = 0; corner < (1 << Space::axes); ++corner) {
    double part = 1;
    std::array<int, 3> cell = low;
    for (int a = 0; a < Space::axes; ++a) {
      const int high = corner >> a & 1;
      cell[a] = std::min(low[a] + high, lattice.cells[a] - 1);
      part *= high ? share[a] : 1 - share[a];
    }
    const std::ptrdiff_t c = lattice.index(cell[0], cell[1], cell[2]);
    if (!grid.wet[c]) continue;
    const auto x = lattice.centre(cell);
    sum += part * (grid.pressure[c] - at_rest(x[0], x[Space::up]));
    total += part;
  }
  return total > 0 ? sum / total : 0;
}

template <class Space>
double wedge_angle(const Simulation<Space>& run, const Point3& edge) {
  constexpr double lifted = 0.1;  // of the layer's largest displacement
  constexpr int up = Space::up;
  const auto& soil = run.state().soil;
  const double layer = run.state().setup.lattice.spacing[up];
  struct Layer {
    double most = 0, reach = 0;
  };
  std::vector<Layer> layers(static_cast<std::size_t>(run.state().setup.lattice.cells[up]));
  const auto each = [&](auto&& body) {
    for (std::size_t p = 0; p < soil.size(); ++p) {
      const double above = soil.reference[up][p] - edge[up];
      if (above < 0) continue;
      body(layers[std::min(static_cast<std::size_t>(above / layer), layers.size() - 1)],
           soil.position[up][p] - soil.reference[up][p], soil.reference[0][p] - edge[0]);
    }
  };
  each([](Layer& at, double uplift, double) { at.most = std::max(at.most, uplift); });
  each([&](Layer& at, double uplift, double beside) {
    if (uplift > lifted * at.most) at.reach = std::max(at.reach, beside);
  });
  double along = 0, square = 0;  // least squares of reach = height / tan(angle)
  for (std::size_t k = 0; k < layers.size(); ++k) {
    if (layers[k].most <= 0) continue;
    const double height = (static_cast<double>(k) + 0.5) * layer;
    along += height * layers[k].reach;
    square += height * height;
  }
  if (square == 0) return 0;
  return std::atan2(square, along) * 180 / std::numbers::pi;
}

#define POLDER_MEASURES(Space)                                                                      \
  template double water_surface(const Simulation<Space>&, const Point3&);                           \
  template double soil_surface(const Simulation<Space>&, const Point3&);                            \
  template std::vector<double> soil_columns(const Simulation<Space>&, const Region&, bool);         \
  template double eroded_area(const Simulation<Space>&, const Region&, const std::vector<double>&); \
  template double water_front(const Simulation<Space>&);                                            \
  template double soil_front(const Simulation<Space>&);                                             \
  template double largest_uplift(const Simulation<Space>&, const Region&);                          \
  template double excess_pressure(const Simulation<Space>&, const Point3&);                         \
  template double wedge_angle(const Simulation<Space>&, const Point3&);
POLDER_MEASURES(PlaneStrain)
POLDER_MEASURES(Solid)
#undef POLDER_MEASURES

}  // namespace polder
