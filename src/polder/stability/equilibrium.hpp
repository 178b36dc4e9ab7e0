#pragma once
// Factors of safety of one slip surface by the methods of slices. F divides the strength: τ = (c + σ'n tan φ) / F.
#include <string>
#include <vector>

#include "polder/stability/slices.hpp"

namespace polder::stability {

struct Equilibrium {
  double factor = 0;  ///< factor of safety; 0 where there is none
  double lambda = 0;  ///< Spencer, Morgenstern–Price: X = λ f(x) E
  int iterations = 0;
  std::string problem;       ///< why there is no answer; empty: converged
  double thrust_inside = 1;  ///< share of the slice sides with the line of thrust between base and ground
  explicit operator bool() const { return problem.empty(); }
};

/// Bishop (1955), simplified: vertical equilibrium of each slice, moments about the centre of the circle.
Equilibrium bishop(const Slices& slices, const Circle& circle);

/// Van (2001), Uplift-Van: moments of the active circle and of the passive circle, horizontal forces of the plane
/// between them; the forces on the two verticals are level and act at a third of their height.
Equilibrium uplift_van(const Slices& slices, const UpliftVanPlane& plane);

enum class Interslice { constant, half_sine };

/// Force and moment equilibrium of every slice with X = λ f(x) E: Spencer (1967) with f = 1, Morgenstern–Price (1965)
/// with f a half sine over the surface.
Equilibrium morgenstern_price(const Slices& slices, Interslice shape);
inline Equilibrium spencer(const Slices& slices) { return morgenstern_price(slices, Interslice::constant); }

}  // namespace polder::stability
