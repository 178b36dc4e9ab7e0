#include "polder/seepage/model_flow.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "polder/seepage/flow_results.hpp"

namespace {

using namespace polder;

/// A block of soil 4 m long on the model's base, a reservoir 1 m deep on its left, air on its right.
Model block() {
  Model model;
  model.size = {7, 2, 0};
  model.cell = {0.2, 0.2, 0.2};
  MaterialInput sand;
  sand.name = "sand";
  sand.grain_diameter = 2e-3;
  model.materials = {sand};
  model.soils.push_back({0, {{{2, 0}, {6, 0}, {6, 1.2}, {2, 1.2}}}, "block"});
  model.free_water.push_back({{{{0, 0}, {2, 0}, {2, 1}, {0, 1}}}, "reservoir"});
  return model;
}

TEST(ModelFlow, TakesHeadsFromWaterAndSeepsIntoAir) {
  Model model = block();
  model.water.viscosity = 8.905e-4;
  const ModelFlow flow = model_flow(model);
  EXPECT_NEAR(flow.materials[0].conductivity[0], 0.0522, 5e-4);  // Kozeny–Carman of the dike study: 5.2–5.3 cm/s
  std::map<std::string, double> length;
  for (const auto& b : flow.boundaries)
    for (std::size_t i = 0; i + 1 < b.line.size(); ++i)
      length[b.name] += std::hypot(b.line[i + 1][0] - b.line[i][0], b.line[i + 1][1] - b.line[i][1]);
  EXPECT_NEAR(length["reservoir"], 1.0, 0.11);                                     // to within half a side
  EXPECT_NEAR(length["reservoir"] + length["seepage face"], 1.2 + 4 + 1.2, 1e-9);  // the base is closed
}

TEST(ModelFlow, TakesAGmshFileInPlaceOfItsOwnMesh) {
  const Model model = block();
  SeepageInput input;
  input.mesh_size = 0.1;
  const ModelFlow own = model_flow(model, input);
  std::string text = fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", own.mesh.nodes.size());
  for (std::size_t i = 0; i < own.mesh.nodes.size(); ++i)
    text += fmt::format("{} {:.16g} {:.16g} 0\n", i + 1, own.mesh.nodes[i][0], own.mesh.nodes[i][1]);
  text += fmt::format("$EndNodes\n$Elements\n{}\n", own.mesh.triangles.size());
  for (std::size_t t = 0; t < own.mesh.triangles.size(); ++t) {
    const auto& n = own.mesh.triangles[t];
    text += fmt::format("{} 9 2 1 1 {} {} {} {} {} {}\n", t + 1, n[0] + 1, n[1] + 1, n[2] + 1, n[3] + 1, n[4] + 1,
                        n[5] + 1);
  }
  input.mesh_size = 0;
  input.mesh_file = testing::TempDir() + fmt::format("polder-flow-{}.msh", getpid());
  std::ofstream(input.mesh_file) << text << "$EndElements\n";
  const ModelFlow read = model_flow(model, input);
  const auto table = [](const ModelFlow& flow) {
    const FlowSolver solver(flow.problem());
    return phreatic_height(solver, solver.steady(0), 4).value_or(-1);
  };
  EXPECT_GT(table(own), 0.5);
  EXPECT_NEAR(table(read), table(own), 1e-6);
  std::filesystem::remove(input.mesh_file);
}

TEST(ModelFlow, StartsFromTheWaterTable) {
  Model model = block();
  model.water_table = {{2, 1}, {6, 0}};
  const ModelFlow flow = model_flow(model);
  const FlowSolver solver(flow.problem());
  const FlowState state = initial_flow(model, solver);
  EXPECT_NEAR(*phreatic_height(solver, state, 4), 0.5, 0.02);
}

TEST(ModelFlow, AsksForAPermeability) {
  Model model = block();
  model.materials[0].grain_diameter = 0;
  EXPECT_THROW(model_flow(model), std::invalid_argument);
}

}  // namespace
