// What holds for any model: its mirror image moves as the mirror image, and the pressure leaves no divergence.
#include <algorithm>
#include <cmath>

#include "random_models.hpp"

namespace polder {
namespace {

/// Left becomes right.
Model mirrored(Model model) {
  const double length = model.size[0];
  const auto turn = [&](std::vector<Point2>& line) {
    for (Point2& p : line) p[0] = length - p[0];
    std::reverse(line.begin(), line.end());
  };
  for (SoilBody& s : model.soils) turn(s.region.polygon);
  for (FreeWaterBody& w : model.free_water) turn(w.region.polygon);
  for (WallInput& w : model.walls) turn(w.line);
  turn(model.water_table);
  return model;
}

/// Whether mirrored() knows all that the model has, and its water is in points.
bool has_a_mirror(const Model& model) {
  const bool closed = std::all_of(model.boundaries.begin(), model.boundaries.end(),
                                  [](const Boundary& b) { return b.water == WaterCondition::closed; });
  return closed && model.loads.empty() && !model.unsaturated;
}

/// Plane models that are read from seeds; the pressure solved to round-off, nothing drawn by lot.
std::vector<Model> plane_models(int number) {
  std::vector<Model> models;
  for (std::uint64_t seed = 5000; static_cast<int>(models.size()) < number; ++seed) {
    const RandomModel random = ModelGenerator(seed).make();
    if (random.solid) continue;
    Model model = read_text(random.text);
    if (!has_a_mirror(model)) continue;
    model.name = fmt::format("model {}", seed);
    model.numerics.pressure_tolerance = 1e-13;
    model.numerics.volume_correction = 0;
    model.numerics.split_water = false;
    models.push_back(std::move(model));
  }
  return models;
}

TEST(MirrorImage, OfARandomModelMovesAsItsMirrorImage) {
  for (const Model& model : plane_models(12)) {
    SCOPED_TRACE(model.name);
    Simulation<PlaneStrain> one(model, 1), other(mirrored(model), 1);
    ASSERT_EQ(one.state().soil.size(), other.state().soil.size());
    for (int step = 0; step < 30 && !one.finished() && !other.finished(); ++step) one.advance(), other.advance();
    EXPECT_NEAR(one.time(), other.time(), 1e-9);
    const auto& lattice = one.state().setup.lattice;
    double speed = 0, off = 0, pressure = 0, pressure_off = 0;
    over_all_cells(lattice, [&](std::ptrdiff_t cell, const std::array<int, 3>& at) {
      const std::ptrdiff_t image = lattice.index(lattice.cells[0] - 1 - at[0], at[1]);
      const auto &a = one.state().grid, &b = other.state().grid;
      pressure = std::max(pressure, std::abs(a.pressure[cell]));
      pressure_off = std::max(pressure_off, std::abs(a.pressure[cell] - b.pressure[image]));
      for (const auto& [u, v] :
           {std::pair{&a.soil_velocity, &b.soil_velocity}, {&a.water_velocity, &b.water_velocity}}) {
        speed = std::max({speed, std::abs((*u)[0][cell]), std::abs((*u)[1][cell])});
        off = std::max({off, std::abs((*u)[0][cell] + (*v)[0][image + 1]), std::abs((*u)[1][cell] - (*v)[1][image])});
      }
    });
    EXPECT_LE(off, 1e-9 * speed + 1e-11 * std::sqrt(9.81 * model.size[1]));
    EXPECT_LE(pressure_off, 1e-9 * pressure);
  }
}

TEST(Projection, LeavesNoDivergenceBeyondTheSolversTolerance) {
  for (Model& model : plane_models(12)) {
    SCOPED_TRACE(model.name);
    model.numerics.pressure_tolerance = 1e-6;
    for (Stage& stage : model.stages) stage.local_damping = 0;
    Simulation<PlaneStrain> run(model, 1);
    for (int step = 0; step < 30 && !run.finished(); ++step) {
      const Array before = run.state().grid.pressure;
      const StepReport report = run.advance();
      const auto& grid = run.state().grid;
      const auto& lattice = run.state().setup.lattice;
      double left = 0, given = 0;
      over_all_cells(lattice, [&](std::ptrdiff_t cell, const std::array<int, 3>& place) {
        if (!grid.wet[cell]) return;
        const double volume = lattice.cell_volume(place);
        const double storage = volume / (model.water.bulk_modulus * report.dt) * grid.cell_porosity[cell];
        double sum = storage * (grid.pressure[cell] - before[cell]), size = std::abs(storage * before[cell]);
        for (int a = 0; a < 2; ++a) {
          const auto flux = [&](std::ptrdiff_t f, const FaceField<PlaneStrain>& w, const FaceField<PlaneStrain>& s) {
            const double n = grid.porosity[a][f];
            return lattice.face_area(a, place) * (n * w[a][f] + (1 - n) * s[a][f]);
          };
          const std::ptrdiff_t high = cell + lattice.stride[a];
          sum +=
              flux(high, grid.water_velocity, grid.soil_velocity) - flux(cell, grid.water_velocity, grid.soil_velocity);
          // what the step's forces alone would do in it: gravity over the step, and the velocities before
          size += std::abs(flux(high, grid.water_before, grid.soil_before)) +
                  std::abs(flux(cell, grid.water_before, grid.soil_before)) +
                  lattice.face_area(a, place) * model.gravity * report.dt;
        }
        left += sum * sum;
        given += size * size;
      });
      ASSERT_LE(std::sqrt(left), 2e-6 * std::sqrt(given)) << "step " << step;
    }
  }
}

}  // namespace
}  // namespace polder
