// What may be written in a case file but cannot be computed by this version. A feature that arrives deletes its lines.
#include <fmt/format.h>

#include "polder/case/sections.hpp"

namespace polder {

void check_limits(const Sections& sections, const Model& model, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < model.boundaries.size(); ++i) {
    const Boundary& b = model.boundaries[i];
    const Fields& f = sections.boundaries[i];
    if (b.water == WaterCondition::reservoir)
      report(diagnostics, f.place_of("water"), f.path_of("water"), "reservoirs are not available yet",
             "until they are, put a [[free_water]] of finite size in the model");
    if (b.side && b.water == WaterCondition::open)
      report(diagnostics, f.place_of("water"), f.path_of("water"), "open sides of the model are not available yet",
             "until they are, leave room for the water that flows out");
  }
}

}  // namespace polder
