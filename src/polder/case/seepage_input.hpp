#pragma once
// What seepage needs beyond the model that `polder run` simulates, as plain data: how soils hold water under suction,
// heads along parts of the outline, instants. The case file's [seepage], [[retention]] and [[seepage_boundary]] fill
// it. SI units; heads in m above y = 0.
#include <optional>
#include <string>
#include <vector>

#include "polder/case/model.hpp"
#include "polder/material/retention.hpp"

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
  std::vector<Point2> line;
  Table head;                        ///< m, by time (s)
  std::optional<Table> head_at_end;  ///< m, at the line's last point; absent: the same along the line
  double rate = 0;                   ///< m/s, of rain, normal to the outline
};

enum class SeepageStart { water_table, steady };

struct SeepageInput {
  double mesh_size = 0;       ///< m, sides of the triangles; 0: the case's cell
  std::vector<double> times;  ///< s, instants of a transient computation, ascending; empty: steady
  SeepageStart start = SeepageStart::water_table;
  double steady_time = 0;  ///< s, at which a steady computation takes heads that change with time
  std::vector<MaterialRetention> retentions;
  std::vector<SeepageCondition> conditions;
};

}  // namespace polder
