#pragma once
// The slip surface with the least factor of safety: trial surfaces laid out evenly, then refined by a global optimiser.
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "polder/stability/equilibrium.hpp"

namespace polder::stability {

/// A method as the searches see it: the factor of a sliced surface.
using Method = std::function<Equilibrium(const Slices&, const SlipSurface&)>;

/// Least factor found with one centre, for contours.
struct CentreFactor {
  Point centre{0, 0};
  double factor = 0;
};

struct SearchResult {
  SlipSurface surface;
  Slices slices;
  Equilibrium equilibrium;
  int trials = 0;                      ///< surfaces tried
  std::map<std::string, int> refused;  ///< how many trials were refused, by reason
  std::vector<CentreFactor> contours;  ///< of a search on a grid of centres
  std::string problem;                 ///< why there is no result; empty: there is one
  explicit operator bool() const { return problem.empty(); }
};

struct SearchOptions {
  int slices = 40;                ///< least number of slices of a trial
  int final_slices = 100;         ///< of the surface that is reported
  bool refine = true;             ///< optimise beyond the first layout
  int entries = 20, depths = 10;  ///< layout of circles where there is no grid: ends along the ground, depths per pair
  unsigned long long seed = 1;
};

/// One given surface, as a search result.
SearchResult evaluate(const PreparedSection& prepared, const SlipSurface& surface, const Method& method,
                      const SearchOptions& options = {});

/// Circles: on the grid of centres and tangent lines where one is given (grown while the least factor lies on its
/// edge), else on pairs of ends along the ground; then optimised over both ends and the depth.
SearchResult critical_circle(const PreparedSection& prepared, const Method& method,
                             const std::optional<CircleGrid>& grid = {}, const SearchOptions& options = {});

/// Uplift-Van surfaces: centres and plane in the area where one is given, else anywhere.
SearchResult critical_uplift_van(const PreparedSection& prepared, const std::optional<UpliftVanArea>& area = {},
                                 const SearchOptions& options = {});

/// Free surfaces that start from the critical circle (or lie in the band where one is given). A surface counts when its
/// line of thrust is inside for 80 % of its sides and no kink is sharper than 120° between its segments.
SearchResult critical_free_surface(const PreparedSection& prepared, const Method& method,
                                   const std::optional<FreeSurfaceBand>& band = {}, const SearchOptions& options = {});

}  // namespace polder::stability
