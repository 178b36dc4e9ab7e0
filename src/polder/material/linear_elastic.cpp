// Linear elasticity: σ̇ = λ tr(ε̇) I + 2G ε̇, no strength. For verification, and for what never yields.
#include "polder/material/elasticity.hpp"

namespace polder {
namespace {

constexpr std::array parameters{young_modulus_parameter, poisson_ratio_parameter};

class LinearElastic final : public SoilLaw {
 public:
  explicit LinearElastic(const Elasticity& elasticity) : elasticity_(elasticity) {}
  void update(StressBatch<4>& batch) const override { add_elastic_stress(elasticity_, batch); }
  void update(StressBatch<6>& batch) const override { add_elastic_stress(elasticity_, batch); }
  double constrained_modulus(double) const override { return elasticity_.constrained(); }

 private:
  Elasticity elasticity_;
};

std::unique_ptr<SoilLaw> make(std::span<const double> values, const LawContext&) {
  return std::make_unique<LinearElastic>(Elasticity::from_young(values[0], values[1]));
}

}  // namespace

LawDescription linear_elastic_law() {
  return {"linear-elastic", "Linear elasticity without strength", parameters, make};
}

}  // namespace polder
