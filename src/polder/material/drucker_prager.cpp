// Linear elastic, perfectly plastic Drucker–Prager with a limit on mean tension:
//   F = √J₂ + 3α m − k ≤ 0,  m ≤ T,  potential √J₂ + 3α_ψ m  (m mean stress, tension positive).
// α and k make the cone meet Mohr–Coulomb's surface, by choice,
//   compression, extension   at its outer or inner corners: α = 2 sin φ/(√3(3 ∓ sin φ)), k = 6c cos φ/(√3(3 ∓ sin φ))
//   plane-strain             where plane-strain flow ends, for any ψ: there s_z = −2α_ψ√J₂, so that with
//                            D = √(1 − 3α_ψ²) + α_ψ sin φ,  α = sin φ/(3D), k = c cos φ/D,  α_ψ = sin ψ/√(9 + 3 sin²ψ)
// Return: radial, √J₂ and m reduced by G and 3Kα_ψ per multiplier; else to the limit of mean tension or the corner with
// it. α_ψ fades with the porosity in proportion to tan ψ (dilatancy.hpp); α and k are those of the initial ψ.
#include "polder/material/mohr_coulomb_points.hpp"

namespace polder {
namespace {

enum : std::size_t { E, nu, cohesion, friction, match, dilation, tension, rule, critical, band };
constexpr std::array parameters{
    young_modulus_parameter,
    poisson_ratio_parameter,
    Parameter{"cohesion", "c'", "pressure", false, 0, 0, 1e9, "Effective cohesion"},
    Parameter{"friction_angle", "φ'", "angle", true, 0, 0.01, 1.2, "Effective friction angle"},
    Parameter{"match", "", "choice:plane-strain|compression|extension", false, 0, 0, 2,
              "Where the cone has the strength of Mohr–Coulomb with these c' and φ'"},
    dilatancy_angle_parameter,
    Parameter{"tension_strength", "σ_t", "pressure", false, std::numeric_limits<double>::quiet_NaN(), 0, 1e9,
              "Largest mean tension that the skeleton bears. Left out: the apex"},
    dilatancy_parameter,
    critical_porosity_parameter,
    band_width_parameter,
};

struct Cone {
  double slope;     ///< 3α
  double offset;    ///< k, Pa
  double tension;   ///< T, Pa
  double dilation;  ///< 3α_ψ of the initial state
};

Cone make_cone(std::span<const double> v) {
  const double sine = std::sin(v[friction]), cosine = std::cos(v[friction]), sine_psi = std::sin(v[dilation]);
  Cone cone{};
  if (v[match] == 0) {
    const double flow = sine_psi / std::sqrt(9 + 3 * sine_psi * sine_psi);
    const double d = std::sqrt(1 - 3 * flow * flow) + flow * sine;
    cone = {sine / d, v[cohesion] * cosine / d, 0, 3 * flow};
  } else {
    const double corner = v[match] == 1 ? -1 : 1, root = std::sqrt(3.0);
    cone = {6 * sine / (root * (3 + corner * sine)), 6 * v[cohesion] * cosine / (root * (3 + corner * sine)), 0,
            6 * sine_psi / (root * (3 + corner * sine_psi))};
  }
  const double apex = cone.offset / cone.slope;
  cone.tension = std::isnan(v[tension]) ? apex : std::min(apex, v[tension]);
  return cone;
}

class DruckerPrager final : public SoilLaw {
 public:
  DruckerPrager(const Elasticity& elasticity, const Cone& cone, const Dilatancy& dilatancy)
      : elasticity_(elasticity), cone_(cone), dilatancy_(dilatancy) {}
  void update(StressBatch<4>& batch) const override { update_points(batch); }
  void update(StressBatch<6>& batch) const override { update_points(batch); }
  double constrained_modulus(double) const override { return elasticity_.constrained(); }

 private:
  template <int N>
  void update_points(StressBatch<N>& batch) const {
    add_elastic_stress(elasticity_, batch);
    const double K = elasticity_.bulk(), G = elasticity_.shear;
    for (int i = 0; i < batch.count; ++i) {
      const Tensor s = tensor_at(batch, i);
      const double mean = (s.xx + s.yy + s.zz) * (1.0 / 3.0);
      const double xx = s.xx - mean, yy = s.yy - mean, zz = s.zz - mean;
      const double root =  // √J₂
          std::sqrt(0.5 * (xx * xx + yy * yy + zz * zz) + s.xy * s.xy + s.yz * s.yz + s.zx * s.zx);
      const double flow = cone_.dilation * dilatancy_.share(batch.porosity[i]);
      const double excess = root + cone_.slope * mean - cone_.offset;
      const double step = excess / (G + K * cone_.slope * flow);
      const double cone_mean = mean - step * K * flow, cone_root = root - step * G;
      const double corner = cone_.offset - cone_.slope * cone_.tension;
      const bool shear = excess > 0, on_cone = shear & (cone_mean <= cone_.tension);
      const bool yielding = shear | (mean > cone_.tension);
      const double new_mean = on_cone ? cone_mean : cone_.tension;
      const double new_root = on_cone ? cone_root : (root < corner ? root : corner);
      const double keep = yielding ? new_root / (root > 1e-100 ? root : 1.0) : 1.0;
      const double plastic = (1 - keep) * principal_span(s) / (2 * G);
      const double m = yielding ? new_mean : mean;
      batch.stress[0][i] = yielding ? m + keep * xx : s.xx;
      batch.stress[1][i] = yielding ? m + keep * yy : s.yy;
      batch.stress[2][i] = yielding ? m + keep * zz : s.zz;
      for (int k = 3; k < N; ++k) batch.stress[k][i] *= keep;
      batch.state[0][i] += plastic;
    }
  }

  Elasticity elasticity_;
  Cone cone_;
  Dilatancy dilatancy_;
};

std::unique_ptr<SoilLaw> make(std::span<const double> v, const LawContext& context) {
  return std::make_unique<DruckerPrager>(Elasticity::from_young(v[E], v[nu]), make_cone(v),
                                         make_dilatancy(static_cast<DilatancyRule>(static_cast<int>(v[rule])),
                                                        v[dilation], v[critical], v[band], context));
}

std::vector<Complaint> check(std::span<const double> v, const LawContext& context) {
  std::vector<Complaint> complaints;
  complain_about_dilatancy(v[friction], v[dilation], v[critical], context, complaints);
  return complaints;
}

}  // namespace

LawDescription drucker_prager_law() {
  return {"drucker-prager", "Linear elastic, perfectly plastic Drucker–Prager cone", parameters, make, check};
}

}  // namespace polder
