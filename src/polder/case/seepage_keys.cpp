// Keys of the sections that only seepage reads.
#include "polder/case/seepage_section.hpp"

namespace polder::case_file {

std::vector<Key> seepage_keys() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double any = -infinity;
  return {
      {"seepage", "mesh_size", "", "length", false, "", 1e-4, 1e4, R"("0.1 m")",
       "Length of the triangles' sides. Left out: the largest `model.cell`."},
      {"seepage", "mesh", "", "file", false, "", any, infinity, R"("section.msh")",
       "A Gmsh file (text, version 2.2 or 4.1) whose triangles are taken instead of our own: x and height in m, sides "
       "along the outlines of the soils."},
      {"seepage", "times", "", "list of time", false, "", 0, infinity, R"(["2 s", "6 s"])",
       "Instants of a transient computation. Left out: steady seepage."},
      {"seepage", "start", "", "choice:water-table|steady", false, "water-table", any, infinity, R"("water-table")",
       "What a transient computation starts from at t = 0: heads of `initial.water_table`, or steady seepage."},
      {"seepage", "steady_time", "", "time", false, "0 s", 0, infinity, R"("0 s")",
       "The time at which a steady computation takes heads that change with time."},
      {"seepage", "deformation", "", "flag", false, "false", any, infinity, "true",
       "The ground deforms with the flow from one instant to the next (finite elements with Mohr and Coulomb's "
       "strength, "
       "small strains), and its permeability with its void ratio."},
      // ---- retention
      {"retention", "material", "", "name", false, "", any, infinity, R"("sand")",
       "Name of the `[[material]]` that it belongs to. Needed."},
      {"retention", "model", "", "choice:van-genuchten|linear|gardner|table", false, "van-genuchten", any, infinity,
       R"("van-genuchten")",
       "Degree of saturation S under a suction s: van Genuchten (`g_a`, `g_n`), S = 1 - a_v s (`slope`), "
       "exponential (`rate`), or as measured (`saturation`)."},
      {"retention", "g_a", "g_a", "inverse length", false, "1 1/m", 1e-6, 1e6, R"("2.5 1/m")",
       "van Genuchten: inverse of the suction head at which air enters."},
      {"retention", "g_n", "g_n", "ratio", false, "2", 1.0001, 50, "2",
       "van Genuchten: how fast pores empty beyond it."},
      {"retention", "g_l", "g_l", "ratio", false, "0.5", -20, 50, "0.5", "Exponent of Mualem's relative conductivity."},
      {"retention", "residual", "S_res", "ratio", false, "0", 0, 0.99, "0.05", "Least degree of saturation."},
      {"retention", "maximum", "S_sat", "ratio", false, "1", 0.01, 1, "1", "Degree of saturation without suction."},
      {"retention", "slope", "a_v", "compressibility", false, "0 1/kPa", 0, 1, R"("4e-4 1/kPa")",
       "Linear: loss of saturation per unit of suction."},
      {"retention", "rate", "α", "inverse length", false, "1 1/m", 1e-6, 1e6, R"("0.1 1/cm")",
       "Gardner: saturation and conductivity fall as exp(-α s/γ_w)."},
      {"retention", "conductivity", "", "choice:curve|constant|hillel|gardner|table", false, "curve", any, infinity,
       R"("curve")",
       "Relative conductivity: `curve`, that which belongs to the model (Mualem's for van Genuchten, exponential for "
       "Gardner, S^`hillel_exponent` for linear and for a table), `constant`, `hillel`, `gardner`, or `table`."},
      {"retention", "saturation", "S", "table of ratio by pressure", false, "", 0, 1,
       R"([["0 kPa", 1], ["5 kPa", 0.7], ["50 kPa", 0.2]])",
       "Table: degree of saturation by suction, linear in between: a list [[suction, S], …] that falls, or a CSV file "
       "(Pa, S)."},
      {"retention", "relative_conductivity", "k_r", "table of ratio by ratio", false, "", 0, 1,
       "[[0.2, 0.001], [0.7, 0.2], [1, 1]]",
       "Table: conductivity over that of saturated soil by degree of saturation, linear in between: a list [[S, k_r], "
       "…], or a CSV file."},
      {"retention", "hillel_exponent", "r", "ratio", false, "3", 0, 50, "3", "Hillel: conductivity as S^r."},
      // ---- seepage_boundary
      {"seepage_boundary", "name", "", "name", false, "", any, infinity, R"("river")", "Its name in tables."},
      {"seepage_boundary", "line", "", "polyline", false, "", any, infinity, R"([["0 m", "0 m"], ["4 m", "0 m"]])",
       "Where it holds: the part of the soil's outline that lies on this line. Needed."},
      {"seepage_boundary", "condition", "", "choice:closed|head|seepage|rain", false, "head", any, infinity,
       R"("head")",
       "`head`: total head given, a seepage face above it; `seepage`: water may leave, none enters; `rain`: water "
       "enters at `rate` until it ponds."},
      {"seepage_boundary", "head", "h", "table of length", false, "", any, infinity, R"("0.8 m")",
       "Total head above y = 0, one value or a table by time."},
      {"seepage_boundary", "head_at_end", "", "table of length", false, "", any, infinity, R"("0.5 m")",
       "Head at the line's last point, linear in between. Left out: the same along the line."},
      {"seepage_boundary", "rate", "", "table of velocity", false, "", any, infinity, R"("5e-8 m/s")",
       "Of rain, normal to the outline, one value or a table by time; negative: evaporation. Left out: none."},
  };
}

}  // namespace polder::case_file
