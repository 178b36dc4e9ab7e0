#include "polder/stability/dike_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "polder/seepage/model_flow.hpp"
#include "polder/stability/piping.hpp"

namespace polder::stability {
namespace {

/// Top and base of the aquifer's uppermost stretch at x, m.
std::optional<Range> aquifer_at(const PreparedSection& prepared, double x, const std::string& material) {
  const Column& column = prepared.columns[column_at(prepared, x)];
  const double share = (x - column.left) / (column.right - column.left);
  std::optional<Range> found;
  for (const Piece& piece : column.pieces) {
    const Layer& layer = prepared.section.layers[static_cast<std::size_t>(piece.layer)];
    const bool is = prepared.section.soils[static_cast<std::size_t>(layer.soil)].name == material;
    if (found && !is) break;
    if (!is) continue;
    const double top = piece.top[0] + share * (piece.top[1] - piece.top[0]);
    const double base = piece.base[0] + share * (piece.base[1] - piece.base[0]);
    found = Range{found ? (*found)[0] : top, base};
  }
  return found;
}

}  // namespace

bool DikeCheck::pass() const {
  return problem.empty() &&
         (!expected || std::abs(factor - expected->reference) <= expected->tolerance * expected->reference);
}

std::vector<DikeCheck> dike_checks(const Study& study, const StudySection& on) {
  const PreparedSection& prepared = on.prepared;
  std::vector<DikeCheck> all;
  for (const DikeCheckInput& input : study.input.dike_checks) {
    const auto add = [&](const char* kind, double factor, std::string remark, std::string problem = "") {
      all.push_back({fmt::format("{} ({})", kind, input.name),
                     kind,
                     on.water,
                     factor,
                     std::move(remark),
                     std::move(problem),
                     {}});
    };
    if (input.at <= prepared.left() || input.at >= prepared.right()) {
      add("uplift", 0, "",
          fmt::format("x = {:g} m lies outside the section ({:g} to {:g} m); move dike_check.{}.at", input.at,
                      prepared.left(), prepared.right(), input.name));
      continue;
    }
    const double ground = ground_level(prepared, input.at);
    const auto aquifer = aquifer_at(prepared, input.at, input.aquifer);
    if (!aquifer || (*aquifer)[0] > ground - 1e-3) {
      add("uplift", 0, "",
          fmt::format("{} at x = {:g} m; name the layer under the blanket as dike_check.{}.aquifer, or move it",
                      aquifer ? "nothing lies on '" + input.aquifer + "'" : "there is no '" + input.aquifer + "'",
                      input.at, input.name));
      continue;
    }
    ExitPoint exit;
    exit.water_weight = prepared.section.water.unit_weight;
    exit.blanket_thickness = ground - (*aquifer)[0];
    // Just below the boundary: on it, the layer above is asked.
    const double inside = (*aquifer)[0] - 1e-6 * exit.blanket_thickness;
    exit.blanket_weight = soil_weight(prepared, input.at, inside) / exit.blanket_thickness;
    exit.free_water = free_water_pressure(prepared, input.at) / exit.water_weight;
    exit.exit_head = ground + exit.free_water;
    exit.aquifer_head = inside + pore_pressure(prepared, input.at, inside) / exit.water_weight;
    const std::string state =
        fmt::format("blanket {:.2f} m of {:.1f} kN/m3, head {:.2f} m in the aquifer, {:.2f} m outside",
                    exit.blanket_thickness, exit.blanket_weight / 1e3, exit.aquifer_head, exit.exit_head);
    add("uplift", uplift_factor(exit), state);
    add("heave", heave_factor(exit, input.critical_gradient),
        fmt::format("gradient {:.3f} against {:g}",
                    std::max(0.0, (exit.aquifer_head - exit.exit_head) / exit.blanket_thickness),
                    input.critical_gradient));
    if (input.d70 <= 0) continue;
    PipingInput piping;
    piping.seepage_length = input.seepage_length;
    piping.aquifer_thickness = input.thickness > 0 ? input.thickness : (*aquifer)[0] - (*aquifer)[1];
    piping.d70 = input.d70;
    piping.water_weight = exit.water_weight;
    piping.gravity = study.model.gravity;
    for (const MaterialInput& material : study.model.materials)
      if (material.name == input.aquifer) piping.conductivity = conductivity(study.model, material)[0];
    const PipingResult result = sellmeijer(piping);
    const double difference = input.outside_head - exit.exit_head;
    std::string remark = fmt::format("critical head {:.2f} m against {:.2f} m less 0.3 of the blanket",
                                     result.critical_head, difference);
    for (const std::string& outside : result.outside) remark += "; " + outside;
    add("piping", piping_factor(result, difference, exit.blanket_thickness), remark);
  }
  return all;
}

}  // namespace polder::stability
