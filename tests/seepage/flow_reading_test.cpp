#include "polder/seepage/flow_reading.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "polder/case/reader.hpp"
#include "polder/seepage/chain_sides.hpp"
#include "polder/seepage/model_flow.hpp"

namespace {

using namespace polder;

/// Saturated soil 4 m long and 1 m high between heads of 1.5 m (left) and 1.1 m (right), all its ground under water.
Model box() {
  Model model;
  model.size = {4, 2, 0};
  model.cell = {0.25, 0.25, 0.25};
  MaterialInput sand;
  sand.name = "sand";
  sand.permeability = std::array<double, 2>{1e-4, 1e-4};
  model.materials = {sand};
  SoilBody soil;
  soil.region.polygon = {{0, 0}, {4, 0}, {4, 1}, {0, 1}};
  soil.name = "box";
  model.soils = {soil};
  Monitor middle;
  middle.name = "middle";
  middle.kind = MonitorKind::section;
  middle.at = {{2, -0.5, 0}, {2, 1.5, 0}};
  Monitor gauge;
  gauge.name = "gauge";
  gauge.at = {{1, 0.5, 0}};
  model.monitors = {middle, gauge};
  return model;
}

SeepageInput between_two_heads() {
  using Kind = SeepageCondition::Kind;
  SeepageInput input;
  input.conditions = {{"left", Kind::head, {{0, 0}, {0, 1}}, Table::constant(1.5), {}, Table::constant(0)},
                      {"right", Kind::head, {{4, 0}, {4, 1}}, Table::constant(1.1), {}, Table::constant(0)},
                      {"top", Kind::closed, {{0, 1}, {4, 1}}, {}, {}, Table::constant(0)}};
  return input;
}

double value_of(const std::vector<FlowValue>& values, const std::string& quantity, const std::string& at) {
  const auto found = std::find_if(values.begin(), values.end(),
                                  [&](const FlowValue& v) { return v.quantity == quantity && v.at == at; });
  EXPECT_NE(found, values.end()) << quantity << " at " << at;
  return found == values.end() ? 0 : found->value;
}

TEST(FlowReading, UniformFlowIsReadExactly) {
  const Model model = box();
  const ModelFlow flow = model_flow(model, between_two_heads());
  const FlowSolver solver(flow.problem());
  const std::vector<FlowValue> values = read_flow(model, solver, solver.steady(0));
  const double q = 1e-4 * 0.4 / 4;  // m²/s through a height of 1 m
  EXPECT_NEAR(value_of(values, "inflow", "left"), q, 1e-6 * q);
  EXPECT_NEAR(value_of(values, "outflow", "right"), q, 1e-6 * q);
  EXPECT_NEAR(value_of(values, "discharge", "middle"), q, 1e-6 * q);
  EXPECT_NEAR(value_of(values, "head", "gauge (1, 0.5) m"), 1.4, 1e-9);
  const auto steepest =
      std::find_if(values.begin(), values.end(), [](const FlowValue& v) { return v.quantity == "exit gradient"; });
  ASSERT_NE(steepest, values.end());
  EXPECT_NEAR(steepest->value, 0.1, 1e-6);
}

TEST(FlowReading, HeadMayFallAlongABoundary) {
  SeepageInput input = between_two_heads();
  input.conditions.erase(input.conditions.begin(), input.conditions.begin() + 2);
  input.conditions.push_back({"base",
                              SeepageCondition::Kind::head,
                              {{0, 0}, {4, 0}},
                              Table::constant(1.5),
                              Table::constant(1.1),
                              Table::constant(0)});
  const Model model = box();
  const ModelFlow flow = model_flow(model, input);
  const FlowSolver solver(flow.problem());
  const FlowState state = solver.steady(0);
  for (std::size_t n = 0; n < flow.mesh.nodes.size(); ++n) {
    if (flow.mesh.nodes[n][1] != 0) continue;
    EXPECT_NEAR(state.head[n], 1.5 - 0.1 * flow.mesh.nodes[n][0], 1e-9);
  }
}

TEST(FlowReading, RetentionBelongsToItsMaterial) {
  SeepageInput input;
  input.retentions = {{"sand", LinearRetention{4e-7, 0}, ConstantConductivity{}}};
  const ModelFlow flow = model_flow(box(), input);
  ASSERT_EQ(flow.materials.size(), 1u);
  EXPECT_NEAR(saturation(flow.materials[0].retention, 1e5), 0.96, 1e-12);
}

TEST(FlowReading, TakesRetentionByTables) {
  const std::string path = testing::TempDir() + "/TakesRetentionByTables.toml";
  std::ofstream(path) << R"(
[model]
size = [1, 1]
cell = 0.1
formulation = "unsaturated"
[[material]]
name = "silt"
law = "linear-elastic"
young_modulus = "10 MPa"
grain_density = "2650 kg/m3"
porosity = 0.4
permeability = "1e-6 m/s"
[[soil]]
material = "silt"
box = [[0, 0], [1, 0.5]]
[[retention]]
material = "silt"
model = "table"
saturation = [["0 kPa", 1], ["5 kPa", 0.7], ["50 kPa", 0.25]]
conductivity = "table"
relative_conductivity = [[0.2, 0.001], [0.7, 0.2], [1, 1]]
[[stage]]
name = "rest"
duration = "1 s"
)";
  const ReadResult read = read_case(path);
  ASSERT_TRUE(read.ok()) << format(read.diagnostics);
  ASSERT_EQ(read.model.retentions.size(), 1u);
  const MaterialRetention& silt = read.model.retentions[0];
  EXPECT_NEAR(saturation(silt.retention, 2.5e3), 0.85, 1e-12);
  EXPECT_NEAR(saturation(silt.retention, 1e6), 0.25, 1e-12);
  EXPECT_NEAR(capacity(silt.retention, 1e4), 0.45 / 45e3, 1e-15);
  EXPECT_NEAR(relative_conductivity(silt.curve, silt.retention, 2.5e3), 0.6, 1e-12);
}

TEST(ChainSides, JoinsWhatFollowsAndKeepsGaps) {
  const auto chains = chain_sides({{{{2, 0}, {3, 0}}}, {{{0, 0}, {1, 0}}}, {{{1, 0}, {2, 0}}}, {{{5, 0}, {6, 0}}}});
  ASSERT_EQ(chains.size(), 2u);
  EXPECT_EQ(chains[0].size(), 4u);
  EXPECT_EQ(chains[1].size(), 2u);
}

}  // namespace
