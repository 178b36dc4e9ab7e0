// Linear elastic, perfectly plastic Mohr–Coulomb with a tension cut-off and dilation that fades at the critical state.
// Row 0 of the state is the plastic shear strain γ_p: the sum over the steps of the largest minus the smallest
// principal plastic strain, [(e₁ − e₃) − (s₁ − s₃)]/2G for trial e and returned s (in simple shear, the plastic part
// of the engineering shear strain).
#include "polder/material/mohr_coulomb_points.hpp"

namespace polder {
namespace {

enum : std::size_t { E, nu, cohesion, friction, dilation, tension, rule, critical, band };
constexpr std::array parameters{
    young_modulus_parameter,
    poisson_ratio_parameter,
    Parameter{"cohesion", "c'", "pressure", false, 0, 0, 1e9, "Effective cohesion"},
    Parameter{"friction_angle", "φ'", "angle", true, 0, 0, 1.2, "Effective friction angle"},
    dilatancy_angle_parameter,
    tension_strength_parameter,
    dilatancy_parameter,
    critical_porosity_parameter,
    band_width_parameter,
};

class MohrCoulomb final : public SoilLaw {
 public:
  MohrCoulomb(const Elasticity& elasticity, const MohrCoulombStrength& strength, const Dilatancy& dilatancy)
      : elasticity_(elasticity), strength_(strength), dilatancy_(dilatancy) {}
  void update(StressBatch<4>& batch) const override { update_points(batch); }
  void update(StressBatch<6>& batch) const override { update_points(batch); }
  double constrained_modulus(double) const override { return elasticity_.constrained(); }

 private:
  template <int N>
  void update_points(StressBatch<N>& batch) const {
    update_mohr_coulomb(batch, elasticity_, dilatancy_, [this](int) { return strength_; });
  }

  Elasticity elasticity_;
  MohrCoulombStrength strength_;
  Dilatancy dilatancy_;
};

std::unique_ptr<SoilLaw> make(std::span<const double> v, const LawContext& context) {
  return std::make_unique<MohrCoulomb>(Elasticity::from_young(v[E], v[nu]),
                                       mohr_coulomb_strength(v[cohesion], v[friction], v[tension]),
                                       make_dilatancy(static_cast<DilatancyRule>(static_cast<int>(v[rule])),
                                                      v[dilation], v[critical], v[band], context));
}

std::vector<Complaint> check(std::span<const double> v, const LawContext& context) {
  std::vector<Complaint> complaints;
  complain_about_dilatancy(v[friction], v[dilation], v[critical], context, complaints);
  return complaints;
}

}  // namespace

LawDescription mohr_coulomb_law() {
  return {"mohr-coulomb", "Linear elastic, perfectly plastic Mohr–Coulomb with a tension cut-off", parameters, make,
          check};
}

}  // namespace polder
