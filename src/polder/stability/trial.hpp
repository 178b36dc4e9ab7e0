#pragma once
// What the searches share: trying surfaces, counting why some were refused, reporting the best.
#include <map>
#include <string>

#include "polder/stability/search.hpp"

namespace polder::stability {

struct Trials {
  const PreparedSection& prepared;
  const Method& method;
  SearchOptions options;
  double least_thrust = 0;  ///< least share of the line of thrust inside
  int count = 0;
  std::map<std::string, int> refused = {};

  /// Factor of the surface; infinity, and the reason counted, where it cannot be used.
  double factor(const SlipSurface& surface);
  double refuse(const std::string& reason);
  /// The result for the best surface (recut finely); nullptr: none could be used.
  SearchResult finish(const SlipSurface* surface) const;
};

}  // namespace polder::stability
