#pragma once
// What the kernels are timed on: a saturated block of sand, 2 points of each phase per axis and cell, a little out of
// place, under its own weight and in slow motion. Two rows of cells stay free above it.
#include <cmath>
#include <numbers>
#include <random>
#include <string_view>

#include "polder/math/huge_pages.hpp"
#include "polder/step/face_predictor.hpp"
#include "polder/step/grid_to_points.hpp"
#include "polder/step/points_to_grid.hpp"
#include "polder/step/projection.hpp"

namespace polder {

/// A law with the values given, the rest as in its table.
inline std::shared_ptr<const SoilLaw> make_law(std::string_view name) {
  const LawDescription* law = find_soil_law(name);
  std::vector<double> values;
  for (const Parameter& p : law->parameters) {
    double value = p.standard;
    if (p.key == "young_modulus") value = 1e7;
    if (p.key == "friction_angle") value = 0.6;
    if (p.key == "cohesion") value = 1e3;
    values.push_back(value);
  }
  return law->make(values, {0.02, 0.4, 0.5});
}

template <class Space>
struct Block {
  static constexpr int axes = Space::axes;
  static constexpr double spacing = 0.02, porosity = 0.4, dt = 1e-5;

  Setup<Space> setup;
  SoilPoints<Space> soil;
  WaterPoints<Space> water;
  Tiling<Space> soil_tiling, water_tiling;
  Team team;
  StepControl control;
  GridFields<Space> grid;

  /// About `points` points of each phase.
  Block(double points, std::string_view law, int threads = 1)
      : setup(make(points, law)), team(threads), grid(setup.lattice) {
    seed();
    sort_points(setup.lattice, soil, soil_tiling, team);
    sort_points(setup.lattice, water, water_tiling, team);
    grid.activate(setup.lattice, rows_near(setup.lattice, soil.home, water.home, threads));
    use_huge_pages();
  }

  void to_grid() {
    soil_to_grid(setup, soil, soil_tiling, 0, grid, team);
    water_to_grid(setup, soil, soil_tiling, water, water_tiling, grid, team);
  }
  void predict() { predict_faces(setup, control, dt, grid, team); }
  /// A velocity field for grid_to_water() and grid_to_soil(), as after the pressure has acted.
  void move_grid() {
    to_grid();
    predict();
    for (int c = 0; c < axes; ++c)
      for (std::size_t f = 0; f < grid.discharge[c].size(); ++f) {
        grid.soil_velocity[c][f] *= 1e-3;
        grid.water_velocity[c][f] *= 1e-3;
        grid.discharge[c][f] = grid.porosity[c][f] * (grid.water_velocity[c][f] - grid.soil_velocity[c][f]);
      }
  }

 private:
  static Setup<Space> make(double points, std::string_view law) {
    Setup<Space> made;
    const int across = static_cast<int>(std::lround(std::pow(points, 1.0 / axes) / 2));
    std::array<int, 3> cells{across, across, axes == 3 ? across : 1};
    cells[Space::up] += 2;
    made.lattice = Lattice<Space>(cells, {spacing, spacing, spacing});
    for (PhaseBox* box : {&made.soil_box, &made.water_box})
      for (int a = 0; a < axes; ++a) box->high[a] = cells[a];
    SoilMaterial sand;
    sand.law = make_law(law);
    DragInput drag;
    drag.grain_diameter = 1e-3;
    for (Drag& d : sand.drag) d = make_drag(drag);
    made.materials.push_back(sand);
    return made;
  }

  void seed() {
    const auto& cells = setup.lattice.cells;
    std::array<int, 3> sites{2 * cells[0], 2 * cells[1], axes == 3 ? 2 * cells[2] : 1};
    sites[Space::up] -= 4;
    const std::size_t count = static_cast<std::size_t>(sites[0]) * sites[1] * sites[2];
    append_points(soil, count);
    append_points(water, count);
    std::mt19937 engine(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const double d = spacing / 2, height = d * sites[Space::up];
    const double share = setup.nominal_point_volume();
    for (std::size_t p = 0; p < count; ++p) {
      const std::size_t site[3] = {p % sites[0], p / sites[0] % sites[1], p / sites[0] / sites[1]};
      for (int a = 0; a < axes; ++a) {
        soil.position[a][p] = d * (static_cast<double>(site[a]) + 0.5 + 0.15 * uniform(engine));
        water.position[a][p] = d * (static_cast<double>(site[a]) + 0.5 + 0.15 * uniform(engine));
        soil.velocity[a][p] = water.velocity[a][p] = 1e-4 * uniform(engine);
      }
      soil.mass[p] = (1 - porosity) * 2650 * share;
      soil.porosity[p] = porosity;
      for (int a = 0; a < 3; ++a)
        soil.stress[a][p] = (a == Space::up ? -1e4 : -5e3) * (height - soil.position[Space::up][p]);
      water.volume[p] = porosity * share;
      soil.id[p] = water.id[p] = p;
    }
  }
};

}  // namespace polder
