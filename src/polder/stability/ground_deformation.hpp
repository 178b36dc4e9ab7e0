#pragma once
// Ground that deforms while water flows through it: elastic–plastic, small strains, one instant after the other. Flow
// gives the pressures, equilibrium under them the strains, and the strains the void ratio, with which the conductivity
// changes as 10^(Δe/c_k) (Taylor 1948) where the material has a c_k. The volume that strains give or take is not put
// into the flow: that is for ground which drains faster than it is loaded.
#include <memory>
#include <vector>

#include "polder/case/seepage_input.hpp"
#include "polder/seepage/model_flow.hpp"
#include "polder/stability/fem_solver.hpp"

namespace polder {

class GroundDeformation {
 public:
  /// `flow` has to stay where it is. Throws std::invalid_argument where a material has no strength or stiffness that
  /// the finite elements can take, or nothing holds the ground.
  GroundDeformation(const Model& model, const SeepageInput& input, const ModelFlow& flow);

  /// Equilibrium under the weight and these pressures (Pa, at the nodes); displacements count from here.
  bool begin(const std::vector<double>& pore_pressure);
  /// Equilibrium under other pressures. Where there is none the ground keeps its displacements, and `mechanism` is what
  /// moved in the attempt.
  bool follow(const std::vector<double>& pore_pressure);

  const FemState& state() const { return state_; }
  /// Displacements (x, y per node) of the last attempt that found no equilibrium; empty: none yet.
  const std::vector<double>& mechanism() const { return mechanism_; }
  /// Deviatoric strain per Gauss point under displacements, such as those of the state or of the mechanism.
  std::vector<double> strain(const std::vector<double>& displacement) const {
    return solver_->deviatoric_strain(displacement);
  }
  /// Conductivity over that of the material, per triangle.
  std::vector<double> conductivity_scale() const;

 private:
  const Mesh& mesh_;
  std::vector<double> void_ratio_, c_k_;  ///< per region; c_k 0: the conductivity stays
  std::unique_ptr<FemSolver> solver_;
  FemState state_;
  FemAction action_;
  std::vector<double> mechanism_;
};

}  // namespace polder
