#include "polder/case/seepage_section.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace polder::case_file {
namespace {

/// Saturation by suction as a table must be: from no suction on, never rising.
Table falling(const Fields& f, const Table& table, Diagnostics& diagnostics) {
  const auto fail = [&](std::string message, const char* remedy) {
    report(diagnostics, f.place_of("saturation"), f.path_of("saturation"), std::move(message), remedy);
  };
  if (!table.x.empty() && table.x.front() != 0)
    fail(fmt::format("begins at a suction of {:g} Pa", table.x.front()), "begin with [\"0 kPa\", S without suction]");
  for (std::size_t i = 1; i < table.y.size(); ++i)
    if (table.y[i] > table.y[i - 1]) {
      fail(fmt::format("rises from {:g} to {:g} with the suction", table.y[i - 1], table.y[i]),
           "soil holds less water under more suction");
      break;
    }
  return table;
}

MaterialRetention read_retention(const Fields& f, const Model& model, Diagnostics& diagnostics) {
  MaterialRetention out;
  out.material = material_named(f, model, diagnostics);
  const double unit_weight = model.water.density * model.gravity;
  const double residual = f.number("residual"), maximum = f.number("maximum", 1);
  if (residual >= maximum)
    report(diagnostics, f.place_of("residual"), f.path_of("residual"),
           fmt::format("{:g} is not below the maximum {:g}", residual, maximum), "give a smaller residual saturation");
  const std::string curve = f.text("conductivity"), retention = f.text("model");
  const bool by_head = retention == "gardner" || retention == "van-genuchten" || curve == "gardner";
  if (by_head && !(unit_weight > 0))
    report(diagnostics, f.place_of("model"), f.path_of("model"),
           "is a curve by head of water, which weighs nothing here", "set model.gravity, or give the curves as tables");
  const HillelConductivity hillel{f.number("hillel_exponent", 3)};
  if (retention == "linear") {
    out.retention = LinearRetention{f.number("slope"), residual};
    out.curve = hillel;
  } else if (retention == "gardner") {
    const double rate = f.number("rate", 1) / unit_weight;
    out.retention = GardnerRetention{rate, residual, maximum};
    out.curve = GardnerConductivity{rate};
  } else if (retention == "table") {
    need(f, "saturation", diagnostics);
    if (const Entry* table = f.find("saturation"))
      out.retention = TableRetention{falling(f, table->table, diagnostics)};
    out.curve = hillel;
  } else {
    const VanGenuchtenRetention r =
        van_genuchten(f.number("g_a", 1), f.number("g_n", 2), residual, maximum, unit_weight);
    out.retention = r;
    out.curve = MualemConductivity{f.number("g_l", 0.5), r.lambda};
  }
  if (curve == "constant") out.curve = ConstantConductivity{};
  if (curve == "hillel") out.curve = hillel;
  if (curve == "gardner") out.curve = GardnerConductivity{f.number("rate", 1) / unit_weight};
  if (curve == "table") {
    need(f, "relative_conductivity", diagnostics);
    if (const Entry* table = f.find("relative_conductivity")) out.curve = TableConductivity{table->table};
  }
  return out;
}

SeepageCondition read_condition(const Fields& f, std::size_t number, Diagnostics& diagnostics) {
  using Kind = SeepageCondition::Kind;
  SeepageCondition out;
  need(f, "line", diagnostics);
  out.name = f.text("name").empty() ? fmt::format("seepage boundary {}", number) : f.text("name");
  const std::string kind = f.text("condition");
  out.kind = kind == "closed"    ? Kind::closed
             : kind == "seepage" ? Kind::seepage
             : kind == "rain"    ? Kind::rain
                                 : Kind::head;
  if (const Entry* line = f.find("line"))
    for (const auto& p : line->points) out.line.push_back({p.front(), p.back()});
  if (out.kind == Kind::head) need(f, "head", diagnostics);
  if (const Entry* head = f.find("head")) out.head = head->table;
  if (const Entry* head = f.find("head_at_end")) out.head_at_end = head->table;
  if (const Entry* rate = f.find("rate"); rate && !rate->table.y.empty()) out.rate = rate->table;
  return out;
}

}  // namespace

SeepageInput read_seepage(const Sections& sections, const Model& model, Diagnostics& diagnostics) {
  const Fields& f = sections.seepage;
  SeepageInput input;
  input.mesh_size = f.number("mesh_size");
  input.mesh_file = f.text("mesh");
  if (const Entry* times = f.find("times")) input.times = times->numbers;
  std::sort(input.times.begin(), input.times.end());
  input.start = f.text("start") == "steady" ? SeepageStart::steady : SeepageStart::water_table;
  input.deformation = f.flag("deformation");
  input.steady_time = f.number("steady_time");
  for (const Fields& retention : sections.retentions)
    input.retentions.push_back(read_retention(retention, model, diagnostics));
  for (const Fields& condition : sections.seepage_boundaries)
    input.conditions.push_back(read_condition(condition, input.conditions.size() + 1, diagnostics));
  return input;
}

}  // namespace polder::case_file
