#pragma once
// How soils hold water under suction, and what happens to the pore water along the outline of the soil: read by the
// seepage computation and by the unsaturated formulation. SI units; heads in m above y = 0.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "polder/material/retention.hpp"
#include "polder/math/table.hpp"

namespace polder {

/// Retention and relative conductivity of one of the case's materials.
struct MaterialRetention {
  std::string material;
  Retention retention = VanGenuchtenRetention{};
  ConductivityCurve curve = MualemConductivity{};
};

/// Along the part of the soil's outline that lies on `line`; it takes the place of what the model says there.
struct SeepageCondition {
  enum class Kind { closed, head, seepage, rain };
  std::string name;
  Kind kind = Kind::head;
  std::vector<std::array<double, 2>> line;  ///< m; (x, height)
  Table head;                               ///< m, by time (s)
  std::optional<Table> head_at_end;         ///< m, at the line's last point; absent: the same along the line
  Table rate = Table::constant(0);          ///< m/s, of rain, normal to the outline, by time
};

}  // namespace polder
