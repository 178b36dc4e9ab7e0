// Ground that deforms as its water table moves, against one-dimensional compression.
#include "polder/stability/ground_deformation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "polder/material/law.hpp"
#include "polder/seepage/flow_results.hpp"
#include "polder/stability/sliding_area.hpp"

namespace {

using namespace polder;

constexpr double height = 4, young = 10e6, poisson = 0.25, porosity = 0.4, c_k = 0.2;

/// A column of soil that nothing but its weight and its water loads.
Model column() {
  Model model;
  model.size = {1, 5, 0};
  model.cell = {0.25, 0.25, 0.25};
  MaterialInput soil;
  soil.name = "soil";
  soil.law = "mohr-coulomb";
  const LawDescription* law = find_soil_law(soil.law);
  for (const Parameter& p : law->parameters) {
    const std::string key(p.key);
    soil.law_parameters.push_back(key == "young_modulus"    ? young
                                  : key == "poisson_ratio"  ? poisson
                                  : key == "cohesion"       ? 100e3
                                  : key == "friction_angle" ? 0.5
                                                            : p.standard);
  }
  soil.porosity = porosity;
  soil.permeability = std::array{1e-4, 1e-4};
  soil.permeability_change = c_k;
  model.materials = {soil};
  model.soils.push_back({0, {{{0, 0}, {1, 0}, {1, height}, {0, height}}}, "column"});
  return model;
}

SeepageInput curve() {
  SeepageInput input;
  MaterialRetention retention;
  retention.material = "soil";
  retention.retention = van_genuchten(2, 2, 0.05, 1, 9810);
  input.retentions = {retention};
  return input;
}

TEST(GroundDeformation, ColumnSettlesAsItsWaterTableFalls) {
  const Model model = column();
  const SeepageInput input = curve();
  const ModelFlow flow = model_flow(model, input);
  const FlowSolver solver(flow.problem());
  GroundDeformation ground(model, input, flow);
  ASSERT_TRUE(ground.begin(pore_pressure(solver, solver.hydrostatic(height))));
  ASSERT_TRUE(ground.follow(pore_pressure(solver, solver.hydrostatic(1))));

  // σ'v = weight above − S p, its change over M, summed from the top down.
  const Retention& r = input.retentions[0].retention;
  const double modulus = young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson));
  const auto carried = [&](double y, double table) {
    const double p = 9810 * (table - y);
    return p > 0 ? p : saturation(r, -p) * p;
  };
  const int parts = 4000;
  double settlement = 0, lighter = 0;
  for (int i = 0; i < parts; ++i) {
    const double dy = height / parts, y = height - (i + 0.5) * dy;
    const double lost = porosity * 9810 * (1 - saturation(r, 9810 * (y - 1))) * dy;
    settlement += (carried(y, height) - carried(y, 1) - lighter - lost / 2) / modulus * dy;
    lighter += lost;
  }
  double top = 0;
  for (std::size_t n = 0; n < flow.mesh.nodes.size(); ++n)
    if (flow.mesh.nodes[n][1] > height - 1e-9) top = -ground.state().displacement[2 * n + 1];
  EXPECT_NEAR(top, settlement, 2e-3 * settlement);

  // log10 k/k0 = Δe/c_k, and Δe = (1 + e0) Δε: its mean over the column is the settlement's.
  const std::vector<double> scale = ground.conductivity_scale();
  double mean = 0;
  for (std::size_t e = 0; e < scale.size(); ++e) mean += std::log10(scale[e]) * area(flow.mesh, static_cast<int>(e));
  EXPECT_NEAR(mean / height, -settlement / height / (1 - porosity) / c_k, 5e-3 * settlement / height / 0.6 / c_k);
}

TEST(GroundDeformation, SaysWhichLawItCannotTake) {
  Model model = column();
  model.materials[0].law = "linear-elastic";
  model.materials[0].law_parameters = {1e7, 0.3};
  const SeepageInput input = curve();
  const ModelFlow flow = model_flow(model, input);
  EXPECT_THROW(GroundDeformation(model, input, flow), std::invalid_argument);
}

TEST(SlidingArea, IsThatOfABlockOnItsBand) {
  // The upper 3 m move by 1, the lower 1 m by a tenth of it.
  const Model model = column();
  const ModelFlow flow = model_flow(model, curve());
  std::vector<double> displacement(2 * flow.mesh.nodes.size(), 0.0);
  for (std::size_t n = 0; n < flow.mesh.nodes.size(); ++n) displacement[2 * n] = flow.mesh.nodes[n][1] > 0.99 ? 1 : 0.1;
  EXPECT_NEAR(sliding_area(flow.mesh, displacement), 3, 0.25);
}

}  // namespace
