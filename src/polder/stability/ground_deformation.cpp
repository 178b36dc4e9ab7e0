#include "polder/stability/ground_deformation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "polder/stability/ground_supports.hpp"
#include "polder/stability/section_from_model.hpp"

namespace polder {
namespace {

FemMaterial material_of(const Model& model, const MaterialInput& material, const Retention& retention) {
  const auto parameter = [&](const char* key) { return stability::law_parameter(material, key); };
  const auto friction = parameter("friction_angle"), young = parameter("young_modulus");
  if (!friction || !young)
    throw std::invalid_argument(
        fmt::format("seepage.deformation: the law \"{}\" of material '{}' has no friction angle or no Young's modulus; "
                    "use \"mohr-coulomb\"",
                    material.law, material.name));
  FemMaterial m;
  m.young_modulus = *young;
  m.poisson_ratio = parameter("poisson_ratio").value_or(0.3);
  m.cohesion = parameter("cohesion").value_or(0);
  m.friction_angle = *friction;
  m.dilation_angle = parameter("dilatancy_angle").value_or(0);
  m.dry_unit_weight = (1 - material.porosity) * material.grain_density * model.gravity;
  m.porosity = material.porosity;
  m.retention = retention;
  return m;
}

}  // namespace

GroundDeformation::GroundDeformation(const Model& model, const SeepageInput& input, const ModelFlow& flow)
    : mesh_(flow.mesh) {
  FemProblem problem;
  problem.mesh = &flow.mesh;
  problem.water_unit_weight = flow.unit_weight;
  problem.suction = true;
  for (std::size_t i = 0; i < model.soils.size(); ++i) {
    const MaterialInput& material = model.materials[model.soils[i].material];
    problem.materials.push_back(material_of(model, material, flow.materials[i].retention));
    void_ratio_.push_back(material.porosity / (1 - material.porosity));
    c_k_.push_back(material.permeability_change.value_or(0));
  }
  const double near = 1e-4 * (input.mesh_size > 0 ? input.mesh_size : std::max(model.cell[0], model.cell[1]));
  problem.supports = ground_supports(model, mesh_, near);
  if (problem.supports.empty())
    throw std::invalid_argument("seepage.deformation: nothing holds the ground; it touches no side of the model");
  solver_ = std::make_unique<FemSolver>(std::move(problem));
}

bool GroundDeformation::begin(const std::vector<double>& pore_pressure) {
  action_.pore_pressure = pore_pressure;
  const FemState start = solver_->k0(action_, [&](int region) {
    return 1 - std::sin(solver_->problem().materials[static_cast<std::size_t>(region)].friction_angle);
  });
  bool found = false;
  for (const bool associated : {false, true}) {
    if (found) break;
    action_.associated = associated;
    state_ = start;
    found = solver_->solve(state_, action_).converged;
  }
  action_.associated = false;
  std::fill(state_.displacement.begin(), state_.displacement.end(), 0.0);
  std::fill(state_.plastic_shear.begin(), state_.plastic_shear.end(), 0.0);
  return found;
}

bool GroundDeformation::follow(const std::vector<double>& pore_pressure) {
  action_.pore_pressure = pore_pressure;
  FemState next = state_;
  if (solver_->solve(next, action_).converged) {
    state_ = std::move(next);
    return true;
  }
  mechanism_.resize(next.displacement.size());
  for (std::size_t i = 0; i < mechanism_.size(); ++i) mechanism_[i] = next.displacement[i] - state_.displacement[i];
  return false;
}

std::vector<double> GroundDeformation::conductivity_scale() const {
  std::vector<double> scale(mesh_.triangles.size(), 1.0);
  for (std::size_t e = 0; e < scale.size(); ++e) {
    const auto region = static_cast<std::size_t>(mesh_.region[e]);
    if (c_k_[region] <= 0) continue;
    double volume = 0;
    for (std::size_t g = 3 * e; g < 3 * e + 3; ++g) {
      const Eigen::Vector3d change = polder::strain(solver_->points()[g], mesh_.triangles[e], state_.displacement);
      volume += (change[0] + change[1]) / 3;
    }
    scale[e] = conductivity_factor((1 + void_ratio_[region]) * volume, c_k_[region]);
  }
  return scale;
}

}  // namespace polder
