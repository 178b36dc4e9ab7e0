// Linear elastic, perfectly plastic Tresca: s₁ − s₃ ≤ 2 s_u, flow at constant volume. For clay that has no time to
// drain, in total stress (the water must then not be modelled as well), and for verification.
#include "polder/material/mohr_coulomb_points.hpp"

namespace polder {
namespace {

enum : std::size_t { E, nu, strength, tension };
constexpr std::array parameters{
    young_modulus_parameter,
    poisson_ratio_parameter,
    Parameter{"undrained_shear_strength", "s_u", "pressure", true, 0, 1, 1e9, "Undrained shear strength"},
    Parameter{"tension_strength", "σ_t", "pressure", false, std::numeric_limits<double>::quiet_NaN(), 0, 1e9,
              "Largest tension that the soil bears. Left out: no limit"},
};

class Tresca final : public SoilLaw {
 public:
  Tresca(const Elasticity& elasticity, const MohrCoulombStrength& limit) : elasticity_(elasticity), limit_(limit) {}
  void update(StressBatch<4>& batch) const override { update_points(batch); }
  void update(StressBatch<6>& batch) const override { update_points(batch); }
  double constrained_modulus(double) const override { return elasticity_.constrained(); }

 private:
  template <int N>
  void update_points(StressBatch<N>& batch) const {
    update_mohr_coulomb(batch, elasticity_, no_dilatancy, [this](int) { return limit_; });
  }

  Elasticity elasticity_;
  MohrCoulombStrength limit_;
};

std::unique_ptr<SoilLaw> make(std::span<const double> v, const LawContext&) {
  return std::make_unique<Tresca>(Elasticity::from_young(v[E], v[nu]),
                                  mohr_coulomb_strength(v[strength], 0, v[tension]));
}

}  // namespace

LawDescription tresca_law() {
  return {"tresca", "Linear elastic, perfectly plastic Tresca for undrained clay in total stress", parameters, make};
}

}  // namespace polder
