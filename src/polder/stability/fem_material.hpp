#pragma once
// A stress point of the finite elements in plane strain: elastic–perfectly plastic Mohr–Coulomb, with its tangent.
//
// Stress xx, yy, zz, xy in Pa, tension positive; strain increments xx, yy and the engineering shear γxy.
#include <Eigen/Dense>
#include <array>

#include "polder/material/mohr_coulomb_return.hpp"

namespace polder {

struct FemStrength {
  Elasticity elasticity;
  MohrCoulombStrength strength;
  double dilation;  ///< (1 + sin ψ)/(1 − sin ψ)
  bool elastic;     ///< never yields
};

struct FemStress {
  std::array<double, 4> stress;
  Eigen::Matrix3d tangent;  ///< ∂(σxx, σyy, σxy)/∂(εxx, εyy, γxy) of this step
  bool yields;
};

/// The stress after a strain increment from `start`, and the tangent consistent with the return: the return is
/// piecewise linear in the principal trial stresses, so differences give its slopes exactly; the turning of the axes
/// adds the shear G (σ₁ − σ₂)/(σ₁ᵗ − σ₂ᵗ) (Clausen, Damkilde & Andersen 2007).
FemStress update_stress(const FemStrength& material, const std::array<double, 4>& start,
                        const Eigen::Vector3d& strain_increment);

}  // namespace polder
