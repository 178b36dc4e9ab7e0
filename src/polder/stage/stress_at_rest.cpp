#include "polder/stage/stress_at_rest.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "polder/case/geometry.hpp"
#include "polder/seepage/model_flow.hpp"
#include "polder/stability/fem_solver.hpp"
#include "polder/stability/ground_supports.hpp"
#include "polder/stage/initial.hpp"
#include "polder/stage/unsaturated_start.hpp"
#include "polder/step/unsaturated_step.hpp"

namespace polder {

namespace {

constexpr double most_triangles = 20000;   // finer cells are not followed: stress at rest is smooth
constexpr double least_confinement = 1e3;  // Pa
constexpr double all_dry = -1e3;           // Pa, in a model without a water table

/// As large as a cell, or as the ground allows.
double mesh_size(const Model& model) {
  double ground = 0;  // m²
  for (const SoilBody& soil : model.soils) ground += area(soil.region.polygon);
  const double side = std::sqrt(ground / most_triangles * 4 / std::sqrt(3.0));  // of an even-sided triangle
  return std::max({model.cell[0], model.cell[1], side});
}

/// Pa, where the ground is at rest. Where pores are full or empty, soil with a pressure below zero is dry.
double pore_pressure_at(const Model& model, const Setup<PlaneStrain>& setup, const Point2& at) {
  if (!model.unsaturated && setup.water_table.empty()) return all_dry;
  return pressure_at_start(setup, at[0], at[1]);
}

/// Mean confinement of each material by the stresses as they are, Pa.
std::vector<double> confinement(const SoilPoints<PlaneStrain>& soil, std::size_t materials) {
  std::vector<double> sum(materials, 0.0), count(materials, 0.0);
  for (std::size_t p = 0; p < soil.size(); ++p) {
    sum[soil.material[p]] -= (soil.stress[0][p] + soil.stress[1][p] + soil.stress[2][p]) / 3;
    ++count[soil.material[p]];
  }
  for (std::size_t m = 0; m < materials; ++m)
    sum[m] = count[m] > 0 ? std::max(least_confinement, sum[m] / count[m]) : least_confinement;
  return sum;
}

FemMaterial elastic_at_rest(const Model& model, const Setup<PlaneStrain>& setup, std::size_t number,
                            double mean_pressure) {
  const MaterialInput& material = model.materials[number];
  const double k0 = model.k0.value_or(earth_pressure_at_rest(material)), nu = k0 / (1 + k0);
  FemMaterial m;
  m.elastic = true;
  m.poisson_ratio = nu;
  m.young_modulus =
      setup.materials[number].law->constrained_modulus(mean_pressure) * (1 + nu) * (1 - 2 * nu) / (1 - nu);
  m.dry_unit_weight = (1 - material.porosity) * material.grain_density * model.gravity;
  m.porosity = material.porosity;
  if (model.unsaturated) m.retention = setup.pores[number].retention;
  return m;
}

/// Stress at a place in a triangle: linear between its three Gauss points, as the strains of quadratic triangles are.
std::array<double, 4> stress_at(const FemSolver& solver, const FemState& state, const MeshLocator::Place& place) {
  Eigen::Matrix3d weights;
  const auto first = 3 * static_cast<std::size_t>(place.triangle);
  for (int g = 0; g < 3; ++g)
    for (int k = 0; k < 3; ++k) weights(k, g) = solver.points()[first + static_cast<std::size_t>(g)].weight[k];
  const Eigen::Vector3d share = weights.inverse() * Eigen::Vector3d(place.weight[0], place.weight[1], place.weight[2]);
  std::array<double, 4> stress{};
  for (std::size_t g = 0; g < 3; ++g)
    for (std::size_t s = 0; s < 4; ++s) stress[s] += share[static_cast<Eigen::Index>(g)] * state.stress[first + g][s];
  return stress;
}

}  // namespace

void set_sloping_k0_stress(const Model& model, const Setup<PlaneStrain>& setup, SoilPoints<PlaneStrain>& soil) {
  const Mesh mesh = make_mesh(ground_outlines(model, mesh_size(model)));
  const std::vector<double> confined = confinement(soil, model.materials.size());
  FemProblem problem;
  problem.mesh = &mesh;
  problem.water_unit_weight = model.water.density * model.gravity;
  problem.suction = model.unsaturated;
  for (const SoilBody& body : model.soils)
    problem.materials.push_back(elastic_at_rest(model, setup, body.material, confined[body.material]));
  problem.supports = ground_supports(model, mesh, 1e-4 * std::max(model.cell[0], model.cell[1]));
  if (problem.supports.empty())
    throw std::invalid_argument("initial.stress: nothing holds the ground; it touches no side of the model");
  const FemSolver solver(std::move(problem));

  FemAction action;
  for (const Point2& node : mesh.nodes) action.pore_pressure.push_back(pore_pressure_at(model, setup, node));
  FemState state = solver.unstressed();
  if (!solver.solve(state, action).converged)
    throw std::invalid_argument("initial.stress: no elastic equilibrium was found for the ground at rest");
  const MeshLocator locator(mesh);
  for (std::size_t p = 0; p < soil.size(); ++p) {
    const MeshLocator::Place place = locator.find({soil.position[0][p], soil.position[1][p]});
    if (place.triangle < 0) continue;  // the columns' stress stays
    const std::array<double, 4> stress = stress_at(solver, state, place);
    for (std::size_t s = 0; s < 4; ++s) soil.stress[s][p] = stress[s];
  }
}

template <class Space>
void set_stress_at_rest(const Model& model, const Setup<Space>& setup, SoilPoints<Space>& soil, bool placed) {
  if (!is_by_k0(model.initial_stress)) return;
  if (model.unsaturated)
    set_unsaturated_k0_stress(model, setup, soil);
  else
    set_k0_stress(model, setup, soil);
  if constexpr (Space::axes == 2)
    if (model.initial_stress == InitialStress::k0_slope && !placed && soil.size() > 0)
      set_sloping_k0_stress(model, setup, soil);
}

template void set_stress_at_rest(const Model&, const Setup<PlaneStrain>&, SoilPoints<PlaneStrain>&, bool);
template void set_stress_at_rest(const Model&, const Setup<Solid>&, SoilPoints<Solid>&, bool);

}  // namespace polder
