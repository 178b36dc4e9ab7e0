// Mohr–Coulomb whose cohesion and friction fall from peak to residual with plastic shear strain (brittle clay, dense or
// cemented soil):  c = c_p + (c_r − c_p) s,  tan φ = tan φ_p + (tan φ_r − tan φ_p) s,  s = min(1, γ_p/γ_r).
//
// What a soil has is a slip δ over which a shear band loses its strength; what the grid gives the band is a width of
// about 4 cells. So γ_r = δ/max(w_b, 4h): the energy spent per area of slip surface, and with it the answer, does not
// depend on the grid as long as 4h ≥ w_b (crack band: Bažant and Oh (1983), Mater. Struct. 16).
// The strength of a step is that of its start: the steps of the method are small against γ_r.
#include "polder/material/mohr_coulomb_points.hpp"

namespace polder {
namespace {

enum : std::size_t {
  E,
  nu,
  cohesion,
  friction,
  cohesion_end,
  friction_end,
  slip,
  dilation,
  tension,
  rule,
  critical,
  band
};
constexpr std::array parameters{
    young_modulus_parameter,
    poisson_ratio_parameter,
    Parameter{"cohesion", "c'_p", "pressure", false, 0, 0, 1e9, "Peak effective cohesion"},
    Parameter{"friction_angle", "φ'_p", "angle", true, 0, 0, 1.2, "Peak effective friction angle"},
    Parameter{"residual_cohesion", "c'_r", "pressure", false, 0, 0, 1e9, "Residual effective cohesion"},
    Parameter{"residual_friction_angle", "φ'_r", "angle", true, 0, 0, 1.2, "Residual effective friction angle"},
    Parameter{"softening_slip", "δ", "length", true, 0, 1e-6, 1e3,
              "Slip across a shear band over which the strength falls from peak to residual"},
    dilatancy_angle_parameter,
    tension_strength_parameter,
    dilatancy_parameter,
    critical_porosity_parameter,
    band_width_parameter,
};

/// Strength along the way: linear in γ_p/γ_r.
struct Softening {
  double cohesion, cohesion_drop;
  double tangent, tangent_drop;
  double tension;  ///< Pa, at peak; falls with the cohesion
  double rate;     ///< 1/γ_r

  POLDER_INLINE MohrCoulombStrength at(double plastic_shear_strain) const {
    const double way = rate * plastic_shear_strain, s = way > 1 ? 1.0 : way;
    const double c = cohesion - cohesion_drop * s, t = tangent - tangent_drop * s;
    const double root = std::sqrt(1 + t * t) + t;  // √k
    const double apex = c / (t > 1e-12 ? t : 1e-12);
    const double cut_off = tension * c / (cohesion > 0 ? cohesion : 1.0);
    return {root * root, 2 * c * root, cut_off < apex ? cut_off : apex};
  }
};

class SofteningMohrCoulomb final : public SoilLaw {
 public:
  SofteningMohrCoulomb(const Elasticity& elasticity, const Softening& softening, const Dilatancy& dilatancy)
      : elasticity_(elasticity), softening_(softening), dilatancy_(dilatancy) {}
  void update(StressBatch<4>& batch) const override { update_points(batch); }
  void update(StressBatch<6>& batch) const override { update_points(batch); }
  double constrained_modulus(double) const override { return elasticity_.constrained(); }

 private:
  template <int N>
  void update_points(StressBatch<N>& batch) const {
    update_mohr_coulomb(batch, elasticity_, dilatancy_,
                        [this, &batch](int i) { return softening_.at(batch.state[0][i]); });
  }

  Elasticity elasticity_;
  Softening softening_;
  Dilatancy dilatancy_;
};

std::unique_ptr<SoilLaw> make(std::span<const double> v, const LawContext& context) {
  const double width = std::max(v[band], band_cells * context.cell_size);
  const double tangent = std::tan(v[friction]);
  const Softening softening{v[cohesion],
                            v[cohesion] - v[cohesion_end],
                            tangent,
                            tangent - std::tan(v[friction_end]),
                            std::isnan(v[tension]) ? no_tension_limit : v[tension],
                            width / v[slip]};
  return std::make_unique<SofteningMohrCoulomb>(Elasticity::from_young(v[E], v[nu]), softening,
                                                make_dilatancy(static_cast<DilatancyRule>(static_cast<int>(v[rule])),
                                                               v[dilation], v[critical], v[band], context));
}

std::vector<Complaint> check(std::span<const double> v, const LawContext& context) {
  std::vector<Complaint> complaints;
  complain_about_dilatancy(v[friction], v[dilation], v[critical], context, complaints);
  if (v[friction_end] > v[friction])
    complaints.push_back(
        {"residual_friction_angle", "larger than the peak friction angle; give at most friction_angle"});
  if (v[cohesion_end] > v[cohesion])
    complaints.push_back({"residual_cohesion", "larger than the peak cohesion; give at most cohesion"});
  return complaints;
}

}  // namespace

LawDescription softening_mohr_coulomb_law() {
  return {"softening-mohr-coulomb",
          "Mohr–Coulomb whose strength falls from peak to residual over a given slip, whatever the grid", parameters,
          make, check};
}

}  // namespace polder
