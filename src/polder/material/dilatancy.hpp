#pragma once
// How dilation ends. The default fades towards the critical state with a band whose total dilation, not its porosity,
// is fixed, so that the motion does not depend on the grid (docs/theory.md, "Dilatancy"):
//   tan ψ = tan ψ₀ · clamp((n_ch − n)/(n_ch − n₀), 0, 1),   n_ch = n₀ + (n_c − n₀) · min(1, w_b/(4h)),
// since a shear band on the grid is about 4 cells wide whatever the cell h, while a real one has the width w_b.
// The constant rule, ψ = ψ₀ always, is the one of the published studies; it turns every shear band liquid in time.
#include <algorithm>
#include <cmath>
#include <limits>

#include "polder/material/law.hpp"
#include "polder/material/principal.hpp"

namespace polder {

enum class DilatancyRule { critical_state, constant };

/// tan ψ = tangent · clamp(start − slope n, 0, 1).
struct Dilatancy {
  double tangent, start, slope;

  /// tan ψ/tan ψ₀ at porosity n.
  POLDER_INLINE double share(double porosity) const {
    const double line = start - slope * porosity;
    return line < 0 ? 0.0 : (line > 1 ? 1.0 : line);
  }
  /// m = (1 + sin ψ)/(1 − sin ψ) = (√(1 + tan²ψ) + tan ψ)² at porosity n.
  POLDER_INLINE double ratio(double porosity) const {
    const double t = tangent * share(porosity);
    const double root = std::sqrt(1 + t * t) + t;
    return root * root;
  }
};

inline constexpr Dilatancy no_dilatancy{0, 1, 0};

/// Cells across a shear band on the grid (measured: 3.5–4.8).
inline constexpr double band_cells = 4;

inline double critical_porosity_or_standard(double critical_porosity, const LawContext& context) {
  return std::isnan(critical_porosity)
             ? context.initial_porosity + 0.5 * (context.max_porosity - context.initial_porosity)
             : critical_porosity;
}

inline Dilatancy make_dilatancy(DilatancyRule rule, double angle, double critical_porosity, double band_width,
                                const LawContext& context) {
  if (rule == DilatancyRule::constant) return {std::tan(angle), 1, 0};
  const double n0 = context.initial_porosity;
  const double room = critical_porosity_or_standard(critical_porosity, context) - n0;
  if (room <= 0) return no_dilatancy;  // as loose as the critical state from the start: nothing left to dilate
  const double band = context.cell_size > 0 ? std::min(1.0, band_width / (band_cells * context.cell_size)) : 1.0;
  const double reach = room * band;
  return {std::tan(angle), (n0 + reach) / reach, 1 / reach};
}

inline constexpr Parameter dilatancy_angle_parameter{
    "dilatancy_angle", "ψ", "angle", false, 0, 0, 1.2, "Dilatancy angle in the initial state"};
inline constexpr Parameter dilatancy_parameter{
    "dilatancy",
    "",
    "choice:critical-state|constant",
    false,
    0,
    0,
    1,
    "critical-state: dilation fades as the porosity approaches the critical one; constant: it never ends"};
inline constexpr Parameter critical_porosity_parameter{
    "critical_porosity",
    "n_c",
    "ratio",
    false,
    std::numeric_limits<double>::quiet_NaN(),
    0.05,
    0.95,
    "Porosity at which shear no longer dilates; below max_porosity. Left out: half-way from porosity to max_porosity"};
inline constexpr Parameter band_width_parameter{
    "band_width",
    "w_b",
    "length",
    false,
    0.1,
    1e-6,
    1e3,
    "Width of a shear band in nature (10 to 20 grain diameters; wider bands dilate more in all). With the critical "
    "porosity it fixes how far a band opens, w_b (n_c − n_0), on any grid; of effect where 4 cells are wider than it"};

/// What is wrong with the dilatancy's parameters taken together.
inline void complain_about_dilatancy(double friction_angle, double dilatancy_angle, double critical_porosity,
                                     const LawContext& context, std::vector<Complaint>& complaints) {
  if (dilatancy_angle > friction_angle)
    complaints.push_back({"dilatancy_angle",
                          "larger than the friction angle, which would create energy in shear; give at most "
                          "friction_angle (commonly friction_angle − 30 deg for sand)"});
  if (!std::isnan(critical_porosity) && critical_porosity >= context.max_porosity)
    complaints.push_back({"critical_porosity",
                          "not below max_porosity, so that shear alone could part the grains; give a value between "
                          "porosity and max_porosity"});
}

}  // namespace polder
