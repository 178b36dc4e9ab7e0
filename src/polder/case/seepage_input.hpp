#pragma once
// What seepage needs beyond the model that `polder run` simulates, as plain data: how soils hold water under suction,
// heads along parts of the outline, instants. The case file's [seepage], [[retention]] and [[seepage_boundary]] fill
// it. SI units; heads in m above y = 0.
#include <optional>
#include <string>
#include <vector>

#include "polder/case/pore_water.hpp"

namespace polder {

enum class SeepageStart { water_table, steady };

struct SeepageInput {
  double mesh_size = 0;       ///< m, sides of the triangles; 0: the case's cell
  std::string mesh_file;      ///< of Gmsh, instead of our own mesh; empty: none
  std::vector<double> times;  ///< s, instants of a transient computation, ascending; empty: steady
  SeepageStart start = SeepageStart::water_table;
  bool deformation = false;  ///< the ground deforms with the flow (elastic–plastic, small strains)
  double steady_time = 0;    ///< s, at which a steady computation takes heads that change with time
  std::vector<MaterialRetention> retentions;
  std::vector<SeepageCondition> conditions;
};

}  // namespace polder
