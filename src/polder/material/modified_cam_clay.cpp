// Modified Cam Clay: F = q²/M² + P(P − P_c) ≤ 0, associated flow, hardening by plastic volume change.
//   Roscoe and Burland (1968), in Engineering Plasticity; implicit step after Borja (1991), CMAME 86, solved anew here.
// Pressures are shifted, P = p + a (p compression positive): the attraction a, small, keeps a stiffness and an order of
// things at p = 0, where water may bring the soil. With the specific volume v = 1/(1 − n):
//   elastic  P = P₀ exp(v ε_v/κ), G = 3(1 − 2ν)/(2(1 + ν)) K;   hardening  P_c = P_c0 exp(v ε_v^p/(λ − κ)).
// A step, with x the plastic volume change (compression positive): p(x), P_c(x) are known, q from F = 0, and the flow
// rule leaves one equation,  g(x) = 6Gx q/M² − (q_trial − q)(2P − P_c) = 0,
// whose root lies between the points where 2P = P_c (critical state) and where x = 0 or P = P_c (isotropic), both
// known: Newton kept inside that bracket cannot fail.
#include "polder/material/elasticity.hpp"
#include "polder/material/mohr_coulomb_points.hpp"

namespace polder {
namespace {

enum : std::size_t { lambda, kappa, nu, friction, ratio, preconsolidation, attraction };
constexpr std::array parameters{
    Parameter{"compression_index", "λ", "ratio", true, 0, 1e-4, 2,
              "Slope of the virgin line, specific volume over ln p'"},
    Parameter{"swelling_index", "κ", "ratio", true, 0, 1e-5, 1, "Slope of the unloading line"},
    poisson_ratio_parameter,
    Parameter{"friction_angle", "φ'_cs", "angle", true, 0, 0.05, 1.2,
              "Friction angle at the critical state in triaxial compression, M = 6 sin φ'/(3 − sin φ')"},
    Parameter{"overconsolidation_ratio", "OCR", "ratio", false, 1, 1, 1e3,
              "Size of the yield surface over the one through the initial stress at K0 = 1 − sin φ'"},
    Parameter{"preconsolidation_pressure", "p'_c", "pressure", false, std::numeric_limits<double>::quiet_NaN(), 1, 1e9,
              "Isotropic yield pressure at the start, in place of the overconsolidation ratio"},
    Parameter{"attraction", "a", "pressure", false, 100, 1, 1e6,
              "Shift of the pressure that keeps the soil stiff at zero stress; small against the stresses of interest"},
};

struct Clay {
  double lambda, kappa, nu, M, ratio, preconsolidation, attraction, initial_volume;
};

/// Where one step takes a point: from shifted pressures and the trial deviator.
struct Returned {
  double pressure, deviator, yield_pressure;
};

Returned cam_clay_return(const Clay& clay, double volume, double shear, double trial_pressure, double trial_deviator,
                         double yield_pressure) {
  const double M2 = clay.M * clay.M;
  const double soften = volume / clay.kappa, harden = volume / (clay.lambda - clay.kappa);
  const double critical = std::log(2 * trial_pressure / yield_pressure) / (soften + harden);
  const double isotropic = std::log(trial_pressure / yield_pressure) / (soften + harden);
  double low = critical > 0 ? std::max(0.0, isotropic) : critical;
  double high = critical > 0 ? critical : 0.0;
  const auto state_at = [&](double x) {
    const double P = trial_pressure * std::exp(-soften * x), Pc = yield_pressure * std::exp(harden * x);
    return Returned{P, clay.M * std::sqrt(std::max(P * (Pc - P), 0.0)), Pc};
  };
  if (trial_deviator <= 1e-12 * yield_pressure) {  // isotropic compression
    const double P = trial_pressure * std::exp(-soften * isotropic);
    return {P, 0, P};
  }
  // g < 0 at `low`, g > 0 at `high`, on either side of the critical state.
  const double stiff = 6 * shear / M2;
  double x = 0.5 * (low + high);
  Returned at = state_at(x);
  for (int iteration = 0; iteration < 100; ++iteration) {
    const double lean = 2 * at.pressure - at.yield_pressure, gap = trial_deviator - at.deviator;
    const double g = stiff * x * at.deviator - gap * lean;
    (g < 0 ? low : high) = x;
    // dq/dx from q² = M² P(P_c − P); dP/dx = −P·soften, dP_c/dx = P_c·harden.
    const double dq = 0.5 * M2 / std::max(at.deviator, 1e-300) *
                      (at.pressure * at.yield_pressure * (harden - soften) + 2 * at.pressure * at.pressure * soften);
    const double slope =
        stiff * (at.deviator + x * dq) + dq * lean + gap * (2 * at.pressure * soften + at.yield_pressure * harden);
    double next = x - g / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const bool settled = std::abs(next - x) <= 1e-15 + 1e-13 * std::abs(next);
    x = next;
    at = state_at(x);
    if (settled) break;
  }
  return at;
}

class ModifiedCamClay final : public SoilLaw {
 public:
  explicit ModifiedCamClay(const Clay& clay) : clay_(clay) {}
  void update(StressBatch<4>& batch) const override { update_points(batch); }
  void update(StressBatch<6>& batch) const override { update_points(batch); }
  /// The stiffness grows with the pressure: twice the present one is allowed for.
  double constrained_modulus(double mean_pressure) const override {
    const double K = clay_.initial_volume * (2 * std::max(mean_pressure, 0.0) + clay_.attraction) / clay_.kappa;
    return K * 3 * (1 - clay_.nu) / (1 + clay_.nu);
  }
  std::vector<std::string> state_names() const override { return {"preconsolidation_pressure"}; }
  void initial_state(double mean_pressure, double, std::span<double> state) const override {
    const double sine = 3 * clay_.M / (6 + clay_.M), k0 = 1 - sine;
    const double eta = 3 * (1 - k0) / (1 + 2 * k0) / clay_.M;
    const double P = std::max(mean_pressure, 0.0) + clay_.attraction;
    state[0] = std::isnan(clay_.preconsolidation) ? clay_.ratio * P * (1 + eta * eta) - clay_.attraction
                                                  : clay_.preconsolidation;
  }

 private:
  template <int N>
  void update_points(StressBatch<N>& batch) const {
    for (int i = 0; i < batch.count; ++i) update_point(batch, i);
  }

  template <int N>
  void update_point(StressBatch<N>& batch, int i) const {
    const double v = 1 / (1 - batch.porosity[i]);
    const Tensor s = tensor_at(batch, i);
    const double P0 = std::max(-(s.xx + s.yy + s.zz) / 3 + clay_.attraction, 1e-3 * clay_.attraction);
    const double compression = -(batch.strain[0][i] + batch.strain[1][i] + batch.strain[2][i]);
    const double K = v * P0 / clay_.kappa, G = K * 1.5 * (1 - 2 * clay_.nu) / (1 + clay_.nu);
    const double P = P0 * std::exp(v * compression / clay_.kappa);

    const double mean = (s.xx + s.yy + s.zz) / 3;
    double deviator[N];
    for (int k = 0; k < N; ++k)
      deviator[k] =
          batch.stress[k][i] - (k < 3 ? mean : 0) + 2 * G * (batch.strain[k][i] + (k < 3 ? compression / 3 : 0));
    double square = 0;
    for (int k = 0; k < N; ++k) square += (k < 3 ? 1.5 : 3.0) * deviator[k] * deviator[k];
    const double q = std::sqrt(square);

    const double Pc = batch.state[1][i] + clay_.attraction;
    double new_P = P, keep = 1;
    if (q * q > clay_.M * clay_.M * P * (Pc - P)) {
      const Returned r = cam_clay_return(clay_, v, G, P, q, Pc);
      new_P = r.pressure;
      keep = q > 0 ? std::min(1.0, r.deviator / q) : 1.0;
      batch.state[1][i] = r.yield_pressure - clay_.attraction;
      batch.state[0][i] += (1 - keep) * deviator_span(deviator) / (2 * G);
    }
    for (int k = 0; k < N; ++k) batch.stress[k][i] = keep * deviator[k] - (k < 3 ? new_P - clay_.attraction : 0);
  }

  static double deviator_span(const double (&d)[4]) { return principal_span({d[0], d[1], d[2], d[3], 0, 0}); }
  static double deviator_span(const double (&d)[6]) { return principal_span({d[0], d[1], d[2], d[3], d[4], d[5]}); }

  Clay clay_;
};

std::unique_ptr<SoilLaw> make(std::span<const double> v, const LawContext& context) {
  const double sine = std::sin(v[friction]);
  return std::make_unique<ModifiedCamClay>(Clay{v[lambda], v[kappa], v[nu], 6 * sine / (3 - sine), v[ratio],
                                                v[preconsolidation], v[attraction],
                                                1 / (1 - context.initial_porosity)});
}

std::vector<Complaint> check(std::span<const double> v, const LawContext&) {
  std::vector<Complaint> complaints;
  if (v[kappa] >= v[lambda])
    complaints.push_back({"swelling_index",
                          "not below compression_index; unloading is stiffer than virgin compression "
                          "(commonly a fifth to a tenth of it)"});
  return complaints;
}

}  // namespace

LawDescription modified_cam_clay_law() {
  return {"modified-cam-clay", "Modified Cam Clay: elliptic yield surface, hardening by compaction", parameters, make,
          check};
}

}  // namespace polder
